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

// So that what is added next needs no memory: where it gives out nothing has changed.
template <class Vector>
void make_room(Vector& vector, std::size_t more) {
  const std::size_t needed = vector.size() + more;
  if (needed > vector.capacity()) vector.reserve(std::max(needed, 2 * vector.capacity()));
}

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
  // The centre is a point of the body up to the support error alone.
  bounds.inner_radius = body.inradius() * (1.0 - kStretch) - off_centre - body.support_error();
  const double held = std::fmax(bounds.inner_radius, 0.0);
  bounds.turning = std::sqrt((bounds.radius - held) * (bounds.radius + held)) * (1.0 + 0x1p-50);
  const Aabb own = bounding_box(body, Pose());
  bounds.extents = (1.0 + kStretch) * (own.upper - own.lower);
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
  make_room(shapes_, 1);
  make_room(bounds_, 1);
  make_room(n_of_shape_, 1);
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

bool SceneBodies::is_turned_well(const Transformd& pose) {
  const Vec3d x{pose.row_x.x, pose.row_y.x, pose.row_z.x}, y{pose.row_x.y, pose.row_y.y, pose.row_z.y},
      z{pose.row_x.z, pose.row_y.z, pose.row_z.z};
  const auto is_small = [](double off) { return std::fabs(off) <= 0.5 * Scene::kRotationTolerance; };
  const bool are_units = is_small(dot(x, x) - 1.0) & is_small(dot(y, y) - 1.0) & is_small(dot(z, z) - 1.0);
  return are_units & is_small(dot(x, y)) & is_small(dot(y, z)) & is_small(dot(z, x));
}

Transformd SceneBodies::checked(ShapeId shape, const Transformd& given, ImageOffset* image) const {
  if (!is_turned_well(given)) check_rotation(given);
  return placed(shape, given, image);
}

// Of a rotation that is checked.
Transformd SceneBodies::placed(ShapeId shape, const Transformd& given, ImageOffset* image) const {
  *image = {};
  const Vec3d centre = centre_of(given, bounds_[shape].centre);
  if (!box_) {
    if (!(norm_1(centre) <= kFarthest)) throw InputError("a body of a scene is more than 1e100 away - move it nearer");
    return given;
  }
  return box_->surely_holds(centre, kInside) ? given : wrapped(given, bounds_[shape].centre, image);
}

void SceneBodies::require_shape(ShapeId shape) const {
  if (shape >= shapes_.size()) throw UsageError("a scene has no shape " + std::to_string(shape) + " - add it first");
}

void SceneBodies::prepare_for(ShapeId shape, std::span<const Pose> poses) {
  require_shape(shape);
  make_room(shape_of_, poses.size());
  make_room(poses_, kNumbersABody * poses.size());
  make_room(centres_, poses.size());
  make_room(image_, poses.size());
  ImageOffset image;
  for (const Pose& pose : poses) checked(shape, pose.a_from_b(), &image);
}

// Columns are made longer first, and `shape_of_`, which tells how many bodies there are, last: what is behind its end
// in the others when an exception ends it is overwritten by the next one. What most poses need stands side by side.
void SceneBodies::append(ShapeId shape, std::span<const Pose> poses, const ImageOffset& moved) {
  require_shape(shape);
  const std::size_t first = end(), n = first + poses.size();
  if (n > kNoBody - 1) throw UsageError("a scene holds fewer than 2^32 - 1 bodies - make several");
  make_room(shape_of_, poses.size());
  poses_.resize(kNumbersABody * (n + 1));
  centres_.resize(n);
  image_.resize(n);
  const Vec3d own_centre = bounds_[shape].centre;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Transformd& given = poses[k].a_from_b();
    const Vec3d centre = centre_of(given, own_centre);
    const bool is_turned = !is_upright(given);
    if (is_turned) may_be_turned_ = true;
    const bool stays = box_ ? box_->surely_holds(centre, kInside) : norm_1(centre) <= kFarthest;
    if (!stays || (is_turned && !is_turned_well(given))) {
      ImageOffset image;
      const Transformd kept = checked(shape, given, &image);
      write_pose(poses_.data(), first + k, kept);
      centres_[first + k] = centre_of(kept, own_centre);
      image_[first + k] = image_sum(image, moved);
      continue;
    }
    write_pose(poses_.data(), first + k, given);
    centres_[first + k] = centre;
    image_[first + k] = moved;
  }
  shape_of_.back() = shape;
  shape_of_.resize(n, shape);
  shape_of_.push_back(kNoShape);
  is_tracked_ = false;
  n_of_shape_[shape] += poses.size();
  n_ += poses.size();
}

BodyId SceneBodies::add(ShapeId shape, const Pose& pose, const ImageOffset& moved) {
  require_shape(shape);
  constexpr int kMostMoved = 1 << 30;  // with what it is moved by now no overflow
  for (const int by : moved) {
    if (by < -kMostMoved || by > kMostMoved || (!box_ && by != 0)) {
      throw UsageError("a body was moved by no such image (" + std::to_string(by) +
                       ") - give one from -2^30 to 2^30, and 0 in open space");
    }
  }
  if (free_.empty()) {
    append(shape, {&pose, 1}, moved);
    return end() - 1;
  }
  ImageOffset image;
  const Transformd kept = checked(shape, pose.a_from_b(), &image);
  std::pop_heap(free_.begin(), free_.end(), std::greater<>());
  const BodyId body = free_.back();
  free_.pop_back();
  shape_of_[body] = shape;
  image_[body] = image_sum(image, moved);
  may_be_turned_ = true;
  place(body, kept);
  ++n_of_shape_[shape];
  ++n_;
  return body;
}

bool SceneBodies::are_told_by_boxes() const {
  if (box_ && (box_->xy() != 0.0 || box_->xz() != 0.0 || box_->yz() != 0.0)) return false;
  if (shapes_.size() != 1 || size() == 0) return false;
  constexpr double kBallOfCube = 0.5235;  // a ball's share of the cube about it
  const Vec3d& e = bounds_.front().extents;
  const double width = 2.0 * bounds_.front().radius;
  if (!((e.x / width) * (e.y / width) * (e.z / width) < kBallOfCube)) return false;
  if (!may_be_turned_) return true;
  for (BodyId body = 0; body < end(); ++body) {
    if (has(body) && !is_upright(pose(body))) return false;
  }
  return true;
}

void SceneBodies::place(BodyId body, const Transformd& pose) {
  write_pose(poses_.data(), body, pose);
  centres_[body] = centre_of(pose, bounds_[shape_of_[body]].centre);
}

void SceneBodies::set_visitor(ShapeId shape, const Transformd& pose) {
  shape_of_.back() = shape;
  write_pose(poses_.data(), end(), pose);
}

double SceneBodies::largest_offset() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    if (n_of_shape_[k] > 0) largest = std::fmax(largest, norm_1(bounds_[k].centre));
  }
  return largest;
}

double SceneBodies::largest_ball() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (n_of_shape_[k] > 0) largest = std::fmax(largest, shapes_[k].ball_radius());
  }
  return largest;
}

double SceneBodies::largest_distance() const {
  double largest = 0.0;
  for (BodyId body = 0; body < end(); ++body) {
    if (has(body)) largest = std::fmax(largest, norm_1(centres_[body]));
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

double SceneBodies::largest_radius_of_shapes() const {
  double largest = 0.0;
  for (const ShapeBounds& bounds : bounds_) largest = std::fmax(largest, bounds.radius);
  return largest;
}

double SceneBodies::largest_offset_of_shapes() const {
  double largest = 0.0;
  for (const ShapeBounds& bounds : bounds_) largest = std::fmax(largest, norm_1(bounds.centre));
  return largest;
}

void SceneBodies::remove(BodyId body) {
  make_room(free_, 1);
  --n_of_shape_[shape_of_[body]];
  shape_of_[body] = kNoShape;
  free_.push_back(body);
  std::push_heap(free_.begin(), free_.end(), std::greater<>());
  --n_;
}

void SceneBodies::clear() {
  n_of_shape_.assign(n_of_shape_.size(), 0);
  shape_of_.assign(1, kNoShape);
  poses_.resize(kNumbersABody);
  centres_.clear();
  image_.clear();
  is_tracked_ = may_be_turned_ = false;
  free_.clear();
  n_ = 0;
}

}  // namespace vex
