// How the bodies of a scene move.
#include <cmath>

#include "engine/scene/scene_bodies.h"

namespace vex {
namespace {

bool differ(const Vec3d& a, const Vec3d& b) { return (a.x != b.x) | (a.y != b.y) | (a.z != b.z); }
bool is_turned(const Transformd& a, const Transformd& b) {
  return differ(a.row_x, b.row_x) | differ(a.row_y, b.row_y) | differ(a.row_z, b.row_z);
}

}  // namespace

void SceneBodies::track() {
  travel_.assign(end(), 0.0);
  travel_before_.assign(end(), 0.0);
  has_crossed_.assign(end(), 0);
  tracks_.resize(end());  // at last: where there are tracks the others are as long, also where memory gives out
  for (BodyId body = 0; body < end(); ++body) {
    Track& track = tracks_[body];
    track.centre = centres_[body];
    track.crossed = {};
    track.shape = shape_of_[body];
    track.turned = 0.0;
  }
}

SceneBodies::Travel SceneBodies::largest_travel() {
  Travel largest;
  for (std::size_t k = 0; k < travel_.size(); ++k) {
    const double travel = travel_[k], step = travel - travel_before_[k];
    travel_before_[k] = travel;
    largest.since_track = travel > largest.since_track ? travel : largest.since_track;
    largest.since_asked = step > largest.since_asked ? step : largest.since_asked;
  }
  largest.since_asked *= 1.0 + 0x1p-50;
  return largest;
}

// A point c + R x with |x| <= r moves by |c' - c| + |R' - R| r or less; of the matrix the Frobenius norm.
void SceneBodies::add_to_track(BodyId body, double turned, const Vec3d& centre_from) {
  Track& track = tracks_[body];
  const Vec3d centre = centres_[body];
  ++track.n_moves;
  Vec3d step = centre - centre_from;
  // A body that has left through one face and come back through the opposite one has moved a little.
  if (box_ && !box_->surely_holds(step, kInside)) {
    const ImageOffset image = box_->towards_origin(step);
    step = step + box_->shift(image);
    track.crossed = image_sum(track.crossed, image);
  }
  const bool has_crossed = (track.crossed[0] | track.crossed[1] | track.crossed[2]) != 0;
  if (has_crossed_[body] != static_cast<std::uint8_t>(has_crossed)) has_crossed_[body] = has_crossed ? 1 : 0;
  track.centre = has_crossed ? centre + box_->shift(track.crossed) : centre;
  const double rounding = 0x1p-46 * (norm_1(centre) + norm_1(centre_from) + norm_1(step));
  track.turned += turned;
  // Rounded up, so that what was added between two times is at most the difference, however small the steps are.
  const double by = norm(step) * (1.0 + 0x1p-18) + turned + rounding + kTrifle;
  travel_[body] = (travel_[body] + by) * (1.0 + 0x1p-51);
}

void SceneBodies::set_pose(BodyId body, const Pose& pose) {
  const ShapeId shape = shape_of_[body];
  ImageOffset image;
  if (tracks_.empty()) {
    place(body, checked(shape, pose, &image));
  } else {
    const Transformd& given = pose.a_from_b();
    const Transformd from = this->pose(body);
    const Vec3d centre_from = centres_[body];
    // A rotation that is there already has been checked.
    const bool turns = is_turned(given, from);
    const Transformd kept = turns ? checked(shape, pose, &image) : placed(shape, given, &image);
    place(body, kept);
    const auto square = [](const Vec3d& v) { return dot(v, v); };
    double turned = 0.0;
    if (turns) {
      turned = std::sqrt(square(kept.row_x - from.row_x) + square(kept.row_y - from.row_y) +
                         square(kept.row_z - from.row_z)) *
               bounds_[shape].radius * (1.0 + 0x1p-18);
    }
    if (turns || differ(kept.translation, from.translation)) add_to_track(body, turned, centre_from);
  }
  if (image_[body] != image) image_[body] = image;
}

}  // namespace vex
