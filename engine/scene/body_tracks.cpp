// How the bodies of a scene move.
#include <bit>
#include <cmath>

#include "engine/scene/scene_bodies.h"

namespace vex {
namespace {

bool differ(const Vec3d& a, const Vec3d& b) { return (a.x != b.x) | (a.y != b.y) | (a.z != b.z); }

// Bit for bit, which takes no branches; `kept` is of the table of poses.
bool is_turned(const double* kept, const Transformd& pose) {
  std::uint64_t off = 0;
  for (const Vec3d* const row : {&pose.row_x, &pose.row_y, &pose.row_z}) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    off |= (bits(kept[0]) ^ bits(row->x)) | (bits(kept[1]) ^ bits(row->y)) | (bits(kept[2]) ^ bits(row->z));
    kept += 4;
  }
  return off != 0;
}

// Seen from the centre the body reaches no more farther, nor less far, along any direction (E26): by the Frobenius norm
// of the matrices' difference, that of their chord times the square root of 2.
double most_turned(const Transformd& from, const Transformd& to, const ShapeBounds& bounds) {
  const auto square = [](const Vec3d& v) { return dot(v, v); };
  const double norm =
      std::sqrt(square(to.row_x - from.row_x) + square(to.row_y - from.row_y) + square(to.row_z - from.row_z));
  const double by_points = norm * bounds.radius, chord = 0.70710679 * norm;
  const double angle = (chord + 0x1p-19) * (1.0 + chord * chord / 6.0);
  const double by_angle = angle * bounds.turning + 0x1p-20 * bounds.radius;
  return (by_angle < by_points ? by_angle : by_points) * (1.0 + 0x1p-18);
}

// Rounded up: what was added between two times is at most the difference, however small the terms are.
double more_than_sum(double sum, double by) { return (sum + by) * (1.0 + 0x1p-51); }

// A body's travel and one step more, from one centre to another: larger than it was, so that it tells whether the body
// has moved.
double farther(double travel, const Vec3d& step, const Vec3d& from, const Vec3d& to, double turned) {
  const double rounding = 0x1p-46 * (norm_1(to) + norm_1(from) + norm_1(step));
  const double by = norm(step) * (1.0 + 0x1p-18) + turned + rounding + kTrifle;
  return more_than_sum(travel, by);
}

}  // namespace

void SceneBodies::track() {
  is_tracked_ = false;  // also where memory gives out
  travel_.assign(end(), 0.0);
  travel_before_.assign(end(), 0.0);
  tracks_.resize(end());
  for (BodyId body = 0; body < end(); ++body) tracks_[body] = {centres_[body], 0.0};
  starts_.assign(centres_.begin(), centres_.begin() + end());
  has_crossed_.assign(end(), 0);
  crossed_.resize(end());
  is_tracked_ = true;
}

// The body is where it goes to, and what it has crossed is known.
inline void SceneBodies::add_to_track(BodyId body, const Vec3d& centre_from, const Vec3d& step, double turned) {
  Track& track = tracks_[body];
  track.centre = has_crossed(body) ? centres_[body] + box_->shift(crossed_[body]) : centres_[body];
  if (turned > 0.0) track.turned = more_than_sum(track.turned, turned);
  travel_[body] = farther(travel_[body], step, centre_from, centres_[body], turned);
}

double SceneBodies::largest_step() {
  double largest = 0.0;
  for (std::size_t k = 0; k < travel_.size(); ++k) {
    const double step = travel_[k] - travel_before_[k];
    travel_before_[k] = travel_[k];
    largest = step > largest ? step : largest;
  }
  return largest * (1.0 + 0x1p-50);
}

double SceneBodies::largest_displacement(bool with_turns) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const double by = norm(tracks_[k].centre - starts_[k]) + (with_turns ? tracks_[k].turned : 0.0);
    largest = by > largest ? by : largest;
  }
  return largest;
}

// Of a move that may cross a face, or has a rotation to be looked at twice.
void SceneBodies::set_any_pose(BodyId body, const Transformd& given) {
  const ShapeId shape = shape_of_[body];
  const Transformd from = pose(body);
  const Vec3d centre_from = centres_[body];
  ImageOffset image;
  // A rotation that is there already has been checked.
  const bool turns = is_turned(poses_.data() + kNumbersABody * std::size_t{body}, given);
  const Transformd kept = turns ? checked(shape, given, &image) : placed(shape, given, &image);
  place(body, kept);
  if (image_[body] != image) image_[body] = image;
  if (!is_tracked_ || !(turns || differ(kept.translation, from.translation))) return;
  const double turned = turns ? most_turned(from, kept, bounds_[shape]) : 0.0;
  Vec3d step = centres_[body] - centre_from;
  // A body that has left through one face and come back through the opposite one has moved a little.
  if (box_ && !box_->surely_holds(step, kInside)) {
    const ImageOffset by = box_->towards_origin(step);
    step = step + box_->shift(by);
    crossed_[body] = has_crossed(body) ? image_sum(crossed_[body], by) : by;
    has_crossed_[body] = crossed_[body] != ImageOffset{} ? 1 : 0;
  }
  add_to_track(body, centre_from, step, turned);
}

// What most moves need, side by side; the others go one by one.
void SceneBodies::set_poses(BodyId first, std::span<const Pose> poses) {
  const bool is_tracked = is_tracked_;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const BodyId body = first + static_cast<BodyId>(k);
    const Transformd& given = poses[k].a_from_b();
    const ShapeBounds& bounds = bounds_of(body);
    double* const kept = poses_.data() + kNumbersABody * std::size_t{body};
    const Vec3d centre_from = centres_[body], centre = centre_of(given, bounds.centre), step = centre - centre_from;
    const bool stays = box_ ? box_->surely_holds(centre, kInside) && (!is_tracked || box_->surely_holds(step, kInside))
                            : norm_1(centre) <= kFarthest;
    const bool turns = is_turned(kept, given);
    if (!stays || (turns && !is_turned_well(given))) {
      set_any_pose(body, given);
      continue;
    }
    centres_[body] = centre;
    if (is_tracked && (turns || differ(given.translation, {kept[3], kept[7], kept[11]}))) {
      add_to_track(body, centre_from, step, turns ? most_turned(pose(body), given, bounds) : 0.0);
    }
    if (turns) {
      write_pose(poses_.data(), body, given);
    } else {
      kept[3] = given.translation.x;
      kept[7] = given.translation.y;
      kept[11] = given.translation.z;
    }
    ImageOffset& image = image_[body];
    if ((image[0] | image[1] | image[2]) != 0) image = {};
  }
}

}  // namespace vex
