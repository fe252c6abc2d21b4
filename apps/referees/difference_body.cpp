#include "apps/referees/difference_body.h"

#include <algorithm>
#include <cmath>

namespace vex::exact {
namespace {

using Piece = ExactForm::Piece;

Vec3dd widened(const Vec3d& p) { return {p.x, p.y, p.z}; }
Vec3d narrowed(const Vec3dd& p) { return {p.x.value(), p.y.value(), p.z.value()}; }
Vec3dd stretched(const Vec3dd& p, const Vec3d& by) { return {p.x * by.x, p.y * by.y, p.z * by.z}; }

// D d, the part of it that counts: a dome has no lower half.
Vec3dd stretched_direction(const Piece& piece, const Vec3dd& dir) {
  Vec3dd result = stretched(dir, piece.semi_axes);
  if (piece.is_dome && result.z.value() < 0.0) result.z = 0.0;
  return result;
}

Vec3dd unit(const Vec3dd& dir) {
  // By a power of two first: a direction may be as short as the gap between the bodies.
  const double largest = std::max({std::fabs(dir.x.high), std::fabs(dir.y.high), std::fabs(dir.z.high)});
  if (largest == 0.0) return {};
  const DoubleDouble to_one = std::ldexp(1.0, -std::ilogb(largest));
  const Vec3dd d = to_one * dir;
  const DoubleDouble length = square_root(dot(d, d));
  return {d.x / length, d.y / length, d.z / length};
}

DoubleDouble length_of(const Vec3dd& d) { return dot(unit(d), d); }

double largest_coordinate(const ExactForm& form) {
  double largest = form.ball_radius;
  const auto take = [&largest](const Vec3d& p) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  };
  for (const Vec3d& p : form.points) take(p);
  for (const Piece& piece : form.pieces) {
    take(piece.centre);
    take(piece.semi_axes);
  }
  return largest;
}

// 1 - 2^-96: the unit vector of the search is longer than 1 by less than what this takes off.
const DoubleDouble kShrunk{1.0, -0x1p-96};

// Of a unit vector to rounding: itself where it is no longer than 1, shrunk where it is.
DyadicPoint within_unit_ball(const Vec3dd& x) {
  DyadicPoint result = dyadic(x);
  if (Dyadic(1.0) < inner(result, result)) result = dyadic(kShrunk * x);
  if (Dyadic(1.0) < inner(result, result)) result = {};  // the middle is a point of the ball, whatever went wrong
  return result;
}

}  // namespace

DifferenceBody::DifferenceBody(const ExactForm& a, const ExactForm& b, const Transformd& a_from_b)
    : a_(a), b_(b), pose_(a_from_b) {
  if (b.is_polytope()) {
    for (const Vec3d& p : b.points) rounded_b_.push_back(a_from_b(p));
  }
  const Vec3d t = a_from_b.translation;
  const double largest =
      std::max({largest_coordinate(a), largest_coordinate(b), std::fabs(t.x), std::fabs(t.y), std::fabs(t.z)});
  if (largest > 0.0) scale_ = std::ldexp(1.0, std::min(-std::ilogb(largest), 1000));
  for (const Vec3d& p : a.points) scaled_a_.push_back(scale_ * p);
  for (const Vec3d& p : b.is_polytope() ? rounded_b_ : b.points) scaled_b_.push_back(scale_ * p);
}

CorePoint DifferenceBody::core_support(const ExactForm& form, const std::vector<Vec3d>& points,
                                       const Vec3dd& dir) const {
  CorePoint best;
  DoubleDouble best_value;
  bool found = false;
  if (!points.empty()) {
    const Vec3d d = narrowed(dir);
    double most = -HUGE_VAL;
    for (const Vec3d& p : points) most = std::max(most, dot(p, d));
    // Coordinates are 2 at most: products in double are within 1e-14 |d| of the true ones.
    const double near = most - 1e-13 * norm_1(d);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dot(points[i], d) < near) continue;
      const DoubleDouble value = dot(widened(points[i]), dir);
      if (found && (value - best_value).value() <= 0.0) continue;
      best = {true, i, {}};
      best_value = value;
      found = true;
    }
  }
  for (std::size_t i = 0; i < form.pieces.size(); ++i) {
    const Piece& piece = form.pieces[i];
    const Vec3dd along = stretched_direction(piece, dir);
    const DoubleDouble value = (dot(widened(piece.centre), dir) + length_of(along)) * scale_;
    if (found && (value - best_value).value() <= 0.0) continue;
    best = {false, i, unit(along)};
    best_value = value;
    found = true;
  }
  return best;
}

Vec3dd DifferenceBody::approximate(const ExactForm& form, const std::vector<Vec3d>& points, const CorePoint& at) const {
  if (at.is_vertex) return widened(points[at.index]);
  const Piece& piece = form.pieces[at.index];
  return DoubleDouble(scale_) * (widened(piece.centre) + stretched(at.x, piece.semi_axes));
}

DifferencePoint DifferenceBody::support_of_cores(const Vec3dd& dir) const {
  DifferencePoint result;
  result.a = core_support(a_, scaled_a_, dir);
  const Vec3dd back = -dir;
  const Vec3dd p = approximate(a_, scaled_a_, result.a);
  Vec3dd q;
  if (b_.is_polytope()) {
    result.b = core_support(b_, scaled_b_, back);
    q = approximate(b_, scaled_b_, result.b);
  } else {
    const Vec3dd rx = widened(pose_.row_x), ry = widened(pose_.row_y), rz = widened(pose_.row_z);
    result.b = core_support(b_, scaled_b_, back.x * rx + back.y * ry + back.z * rz);
    const Vec3dd in_b = approximate(b_, scaled_b_, result.b);
    q = Vec3dd{dot(rx, in_b), dot(ry, in_b), dot(rz, in_b)} + widened(scale_ * pose_.translation);
  }
  result.approximately = p - q;
  return result;
}

DifferencePoint DifferenceBody::support(const Vec3dd& dir) const {
  DifferencePoint result = support_of_cores(dir);
  const DoubleDouble radius = (DoubleDouble(a_.ball_radius) + b_.ball_radius) * scale_;
  if (radius.high > 0.0) {
    result.ball_part = unit(dir);
    result.approximately = result.approximately + radius * result.ball_part;
  }
  return result;
}

DyadicPoint DifferenceBody::placed_exactly(const DyadicPoint& in_b) const {
  return DyadicPoint{inner(dyadic(pose_.row_x), in_b), inner(dyadic(pose_.row_y), in_b),
                     inner(dyadic(pose_.row_z), in_b)} +
         dyadic(pose_.translation);
}

DyadicPoint DifferenceBody::exactly_of(const ExactForm& form, const CorePoint& at) const {
  if (at.is_vertex) return dyadic(form.points[at.index]);
  const Piece& piece = form.pieces[at.index];
  DyadicPoint x = within_unit_ball(at.x);
  if (piece.is_dome && x[2].sign() < 0) x[2] = {};
  return dyadic(piece.centre) + DyadicPoint{Dyadic(piece.semi_axes.x) * x[0], Dyadic(piece.semi_axes.y) * x[1],
                                            Dyadic(piece.semi_axes.z) * x[2]};
}

DyadicPoint DifferenceBody::exactly(const DifferencePoint& point) const {
  const DyadicPoint b = b_.is_polytope() ? dyadic(rounded_b_[point.b.index]) : placed_exactly(exactly_of(b_, point.b));
  return (exactly_of(a_, point.a) - b) + ball_radius() * within_unit_ball(point.ball_part);
}

std::vector<DyadicPoint> DifferenceBody::placed_points() const {
  std::vector<DyadicPoint> result;
  for (const Vec3d& p : b_.is_polytope() ? rounded_b_ : b_.points) {
    result.push_back(b_.is_polytope() ? dyadic(p) : placed_exactly(dyadic(p)));
  }
  return result;
}

namespace {

// From above.
Dyadic support_function(const ExactForm& form, const std::vector<Vec3d>& points, const DyadicPoint& dir) {
  Dyadic most;
  bool found = false;
  const auto take = [&](const Dyadic& value) {
    if (!found || most < value) most = value;
    found = true;
  };
  for (const Vec3d& p : points) take(inner(dyadic(p), dir));
  for (const Piece& piece : form.pieces) {
    DyadicPoint along = {Dyadic(piece.semi_axes.x) * dir[0], Dyadic(piece.semi_axes.y) * dir[1],
                         Dyadic(piece.semi_axes.z) * dir[2]};
    if (piece.is_dome && along[2].sign() < 0) along[2] = {};
    take(inner(dyadic(piece.centre), dir) + square_root_from_above(inner(along, along)));
  }
  return most;
}

}  // namespace

bool DifferenceBody::lies_behind(const Vec3dd& dir) const {
  const DyadicPoint d = dyadic(dir);
  if (inner(d, d).sign() == 0) return false;
  const DyadicPoint back = Dyadic(-1.0) * d;
  Dyadic most = support_function(a_, a_.points, d);
  if (b_.is_polytope()) {
    most = most + support_function(b_, rounded_b_, back);
  } else {
    const DyadicPoint in_b =
        back[0] * dyadic(pose_.row_x) + back[1] * dyadic(pose_.row_y) + back[2] * dyadic(pose_.row_z);
    most = most + support_function(b_, b_.points, in_b) + inner(dyadic(pose_.translation), back);
  }
  if (a_.ball_radius > 0.0 || b_.ball_radius > 0.0) {
    most = most + ball_radius() * square_root_from_above(inner(d, d));
  }
  return most.sign() < 0;
}

double DifferenceBody::support_value(const Vec3d& dir) const {
  const Vec3dd d = unit(widened(dir));
  return dot(d, support(d).approximately).value() / scale_;
}

}  // namespace vex::exact
