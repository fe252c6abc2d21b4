#include "engine/scene/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/scene/aabb.h"
#include "engine/scene/scene.h"

namespace vex {
namespace {

// Of lengths: rotations that are ones to within 2e-7 change no length by more than 1e-6, and neither do they where one
// is undone by its transpose.
constexpr double kStretch = 0x1p-19;

double part(const Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// How far the body reaches from the line through its centre along a coordinate axis.
double reach_across(const ConvexBody& body, const Aabb& own, int axis) {
  const Vec3d centre = body.centre();
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto extent = [&](int k) {
    return std::fmax(part(own.upper, k) - part(centre, k), part(centre, k) - part(own.lower, k));
  };
  const double corner = std::hypot(extent(i), extent(j));
  double least = std::fmin(corner, body.circumradius());
  if (const std::optional<ExactForm> form = body.exact_form()) {
    double farthest = 0.0;
    const auto take = [&](const Vec3d& p, double more) {
      farthest = std::fmax(farthest, std::hypot(part(p, i) - part(centre, i), part(p, j) - part(centre, j)) + more);
    };
    for (const Vec3d& p : form->points) take(p, 0.0);
    for (const ExactForm::Piece& piece : form->pieces) {
      take(piece.centre, std::fmax(part(piece.semi_axes, i), part(piece.semi_axes, j)));
    }
    least = std::fmin(least, farthest + form->ball_radius);
  }
  return least;
}

}  // namespace

ShapeBounds shape_bounds(const ConvexBody& body) {
  ShapeBounds bounds;
  bounds.centre = body.centre();
  bounds.has_exact_form = body.exact_form().has_value();
  const double off_centre = kStretch * norm_1(body.centre());
  const auto widened = [&](double length) { return length * (1.0 + kStretch) + off_centre; };
  bounds.radius = widened(body.circumradius());
  bounds.inner_radius = body.inradius() * (1.0 - kStretch) - off_centre;
  const Aabb own = bounding_box(body, Pose());
  double least = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) {
    const double half =
        std::fmax(part(own.upper, axis) - part(body.centre(), axis), part(body.centre(), axis) - part(own.lower, axis));
    const double across = reach_across(body, own, axis);
    const double size = half * across * across;  // the cylinder's volume, but for a factor
    if (size < least || axis == 0) {
      least = size;
      bounds.axis = axis;
      bounds.half_length = widened(half);
      bounds.axis_radius = widened(across);
    }
  }
  return bounds;
}

CylinderPair cylinder_pair(const ShapeBounds& a, const ShapeBounds& b, double margin) {
  CylinderPair pair;
  pair.axis_a = a.axis;
  pair.axis_b = b.axis;
  pair.half_a = a.half_length + margin;  // the cylinder with a ball about each point is in this one
  pair.radius_a = a.axis_radius + margin;
  pair.half_b = b.half_length;
  pair.radius_b = b.axis_radius;
  pair.are_long = a.is_long() && b.is_long();
  pair.is_flat_a = a.is_flat();
  pair.is_flat_b = b.is_flat();
  return pair;
}

void SceneBodies::check_size(const ConvexBody& body) {
  if (!(body.circumradius() >= 1e-100 || body.circumradius() == 0.0) || !(body.reach() <= 1e100)) {
    throw InputError("a body of a scene has the circumradius " + shortest_number(body.circumradius()) +
                     " and reaches " + shortest_number(body.reach()) +
                     " from its origin - give sizes between 1e-100 and 1e100");
  }
}

ShapeId SceneBodies::add_shape(const ConvexBody& body) {
  const auto known = shape_by_identity_.find(body.identity().get());
  if (known != shape_by_identity_.end()) return known->second;
  check_size(body);
  const ShapeBounds bounds = shape_bounds(body);
  if (box_) {
    const Vec3d faces = box_->face_distances();
    const double least = std::fmin(faces.x, std::fmin(faces.y, faces.z));
    if (!(2.0 * bounds.radius <= Scene::kMostImages * least)) {
      throw InputError("a body of the circumradius " + shortest_number(body.circumradius()) +
                       " reaches over more than " + std::to_string(Scene::kMostImages) +
                       " copies of the periodic box, whose faces are " + shortest_number(least) +
                       " apart - give a larger box");
    }
  }
  shape_by_identity_.emplace(body.identity().get(), static_cast<ShapeId>(shapes_.size()));
  shapes_.push_back(body);
  bounds_.push_back(bounds);
  n_of_shape_.push_back(0);
  return static_cast<ShapeId>(shapes_.size() - 1);
}

// The centre is moved step by step, and the translation by as much: both are rounded.
Transformd SceneBodies::wrapped(const Transformd& pose, const Vec3d& own_centre, ImageOffset* image) const {
  Transformd moved = pose;
  *image = {};
  for (int step = 0; step < 2; ++step) {
    ImageOffset by;
    box_->wrapped(moved(own_centre), &by);
    if (by == ImageOffset{}) break;
    moved.translation = moved.translation + box_->shift(by);
    *image = image_sum(*image, by);
  }
  return moved;
}

void SceneBodies::check_rotation(const Transformd& pose) {
  const double off = distance_from_rotation(pose);
  if (!(off <= Scene::kRotationTolerance)) {
    throw InputError("not a rotation to within what a scene needs (max|R^T R - 1| = " + shortest_number(off) +
                     ", and " + shortest_number(Scene::kRotationTolerance) +
                     " is allowed) - give more digits, or a quaternion");
  }
}

Transformd SceneBodies::checked(ShapeId shape, const Pose& pose, ImageOffset* image) const {
  Transformd kept = pose.a_from_b();
  check_rotation(kept);
  *image = {};
  if (!box_) {
    const Vec3d centre = kept(bounds_[shape].centre);
    if (!(norm_1(centre) <= 1e100)) throw InputError("a body of a scene is more than 1e100 away - move it nearer");
    return kept;
  }
  return wrapped(kept, bounds_[shape].centre, image);
}

BodyId SceneBodies::add(ShapeId shape, const Pose& pose) {
  if (shape >= shapes_.size()) throw UsageError("a scene has no shape " + std::to_string(shape) + " - add it first");
  ImageOffset image;
  const Transformd kept = checked(shape, pose, &image);
  BodyId body = end();
  if (free_.empty()) {
    if (body == kNoBody - 1) throw UsageError("a scene holds fewer than 2^32 - 1 bodies - make several");
    shape_of_.back() = shape;
    shape_of_.push_back(kNoShape);
    image_.push_back(image);
    poses_.resize(poses_.size() + kNumbersABody);
    centres_.emplace_back();
    if (tracks_) {
      travel_.push_back(0.0);
      crossed_.emplace_back();
    }
  } else {
    std::pop_heap(free_.begin(), free_.end(), std::greater<>());
    body = free_.back();
    free_.pop_back();
    shape_of_[body] = shape;
    image_[body] = image;
  }
  place(body, kept);
  ++n_of_shape_[shape];
  ++n_;
  return body;
}

void SceneBodies::place(BodyId body, const Transformd& pose) {
  write_pose(poses_.data(), body, pose);
  centres_[body] = centre_at(poses_.data(), body, bounds_[shape_of_[body]].centre);
}

void SceneBodies::set_visitor(ShapeId shape, const Transformd& pose) {
  shape_of_.back() = shape;
  write_pose(poses_.data(), end(), pose);
}

void SceneBodies::track() {
  tracks_ = true;
  travel_.assign(end(), 0.0);
  crossed_.assign(end(), {});
}

double SceneBodies::largest_travel() const {
  double largest = 0.0;
  for (const double t : travel_) largest = std::fmax(largest, t);
  return largest;
}

// A point c + R x with |x| <= r moves by |c' - c| + |R' - R| r or less; of the matrix the Frobenius norm.
void SceneBodies::add_travel(BodyId body, const Transformd& from, const Vec3d& centre_from) {
  const Transformd to = pose(body);
  Vec3d step = centres_[body] - centre_from;
  if (box_) {
    // A body that has left through one face and come back through the opposite one has moved a little.
    const Vec3d f = box_->fractional(step);
    const ImageOffset image{-static_cast<int>(std::nearbyint(f.x)), -static_cast<int>(std::nearbyint(f.y)),
                            -static_cast<int>(std::nearbyint(f.z))};
    if (image != ImageOffset{}) {
      step = step + box_->shift(image);
      for (std::size_t k = 0; k < 3; ++k) crossed_[body][k] += image[k];
    }
  }
  const auto square = [](const Vec3d& v) { return dot(v, v); };
  const double turn =
      std::sqrt(square(to.row_x - from.row_x) + square(to.row_y - from.row_y) + square(to.row_z - from.row_z));
  const double moved = norm(step) + turn * bounds_[shape_of_[body]].radius;
  if (moved == 0.0) return;
  const double rounding = 0x1p-46 * (norm_1(centres_[body]) + norm_1(centre_from) + norm_1(step));
  travel_[body] += moved * (1.0 + 0x1p-18) + rounding;
}

double SceneBodies::largest_offset() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    if (n_of_shape_[k] > 0) largest = std::fmax(largest, norm_1(bounds_[k].centre));
  }
  return largest;
}

double SceneBodies::largest_radius() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    if (n_of_shape_[k] > 0) largest = std::fmax(largest, bounds_[k].radius);
  }
  return largest;
}

void SceneBodies::remove(BodyId body) {
  --n_of_shape_[shape_of_[body]];
  shape_of_[body] = kNoShape;
  free_.push_back(body);
  std::push_heap(free_.begin(), free_.end(), std::greater<>());
  --n_;
}

void SceneBodies::set_pose(BodyId body, const Pose& pose) {
  ImageOffset image;
  const Transformd kept = checked(shape_of_[body], pose, &image);
  const Transformd from = tracks_ ? this->pose(body) : Transformd{};
  const Vec3d centre_from = centres_[body];
  place(body, kept);
  if (tracks_) add_travel(body, from, centre_from);
  image_[body] = image;
}

Transformd SceneBodies::pose_at(const double* poses, std::size_t place) {
  const double* p = poses + kNumbersABody * place;
  return {{p[0], p[1], p[2]}, {p[4], p[5], p[6]}, {p[8], p[9], p[10]}, {p[3], p[7], p[11]}};
}

Vec3d SceneBodies::centre_at(const double* poses, std::size_t place, const Vec3d& own) {
  const double* p = poses + kNumbersABody * place;
  if (own.x == 0.0 && own.y == 0.0 && own.z == 0.0) return {p[3], p[7], p[11]};
  return pose_at(poses, place)(own);
}

void SceneBodies::write_pose(double* poses, std::size_t place, const Transformd& pose) {
  double* p = poses + kNumbersABody * place;
  const Vec3d* const rows[] = {&pose.row_x, &pose.row_y, &pose.row_z};
  const double t[] = {pose.translation.x, pose.translation.y, pose.translation.z};
  for (int k = 0; k < 3; ++k) {
    p[4 * k] = rows[k]->x;
    p[4 * k + 1] = rows[k]->y;
    p[4 * k + 2] = rows[k]->z;
    p[4 * k + 3] = t[k];
  }
}

}  // namespace vex
