#include "engine/query/search/low_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/numeric/directions.h"
#include "engine/query/search/direction_code.h"

namespace vex {
namespace {

constexpr int kMostSteps = 6;
constexpr double kLongestStep = 0.25, kShortestStep = 0x1p-19;
// How far a direction is turned to see both ends of an edge: more than the normal is off, and little, for where it is
// turned to the height is that of another place.
constexpr double kAside = 0x1p-11, kWideAside = 0x1p-6;

using Point = CoreDifference::Point;

Vec3d gradient_of(const Point& point) { return point.w - CoreDifference::height_of(point) * point.dir; }

// Coordinates across a normal.
struct Across {
  double x = 0.0, y = 0.0;
};
Across operator-(const Across& a, const Across& b) { return {a.x - b.x, a.y - b.y}; }
double length_of(const Across& a) { return std::sqrt(a.x * a.x + a.y * a.y); }
Across along_axes(const DirectionCode& frame, const Vec3d& v) { return {dot(v, frame.x()), dot(v, frame.y())}; }
Vec3d in_space(const DirectionCode& frame, const Across& v) { return v.x * frame.x() + v.y * frame.y(); }

// Row by row, along axes at right angles.
using Matrix = std::array<double, 4>;
Across operator*(const Matrix& m, const Across& v) { return {m[0] * v.x + m[1] * v.y, m[2] * v.x + m[3] * v.y}; }

// The principal axes and turns of a matrix that is symmetric but for what is not known of it; none where a minimum has
// no such.
void set_turns(LowPlace& place, const DirectionCode& frame, const Matrix& m) {
  place.x = frame.x();
  place.y = frame.y();
  place.turn_x = place.turn_y = 0.0;
  const double b = 0.5 * (m[1] + m[2]), half = 0.5 * (m[0] - m[3]), middle = 0.5 * (m[0] + m[3]);
  const double root = std::sqrt(half * half + b * b);
  if (!(middle + root > 0.0) || !std::isfinite(middle + root)) return;
  place.turn_x = middle + root;
  place.turn_y = std::max(middle - root, 0.0);
  const Across v = half > 0.0 ? Across{half + root, b} : Across{b, root - half};
  const double length = length_of(v);
  if (!(length > 0.0)) return;
  const Across axis{v.x / length, v.y / length};
  place.x = in_space(frame, axis);
  place.y = in_space(frame, {-axis.y, axis.x});
}

}  // namespace

LowPlace LowPlaceSearch::lower(const LowPlace& start) {
  return is_flat(start.turn_x) || is_flat(start.turn_y) ? lower_flat(start) : lower_smooth(start);
}

LowPlace LowPlaceSearch::lower_smooth(const LowPlace& start) {
  LowPlace place = start;
  DirectionCode frame(place.point.dir, place.x, {});
  Matrix turns = {start.turn_x, 0.0, 0.0, start.turn_y};
  Across gradient = along_axes(frame, gradient_of(place.point));
  for (int step = 0; step < kMostSteps; ++step) {
    const Across turn = turns * gradient;
    ++n_smooth_steps_;
    const double length = length_of(turn);
    if (!(length < kLongestStep) || !(length > kShortestStep)) break;
    const Point next = ask(unit_along(place.point.dir - in_space(frame, turn)));
    const double less = CoreDifference::height_of(place.point) - CoreDifference::height_of(next);
    if (!(less > 0.0)) break;
    place.point = next;
    frame = DirectionCode(next.dir, frame.x(), {});
    const Across before = gradient;
    gradient = along_axes(frame, gradient_of(next));
    // The symmetric update of rank one (R. Fletcher, Practical Methods of Optimization, section 3.2).
    const Across changed = gradient - before, missing = Across{-turn.x, -turn.y} - turns * changed;
    const double divisor = missing.x * changed.x + missing.y * changed.y;
    if (std::fabs(divisor) > 0x1p-10 * length_of(missing) * length_of(changed)) {
      const double xy = missing.x * missing.y / divisor;
      turns = {turns[0] + missing.x * missing.x / divisor, turns[1] + xy, turns[2] + xy,
               turns[3] + missing.y * missing.y / divisor};
    }
    if (less < 0x1p-40 * size_) break;
  }
  LowPlace updated = place;
  set_turns(updated, frame, turns);
  return is_flat(updated.turn_x) || is_flat(updated.turn_y) ? place : updated;
}

LowPlace LowPlaceSearch::lower_flat(const LowPlace& start) {
  LowPlace place = is_flat(start.turn_x) ? on_face(start) : at_edge(start);
  place.point = ask(place.point.dir);
  return CoreDifference::height_of(place.point) < CoreDifference::height_of(start.point) + 0x1p-36 * size_ ? place
                                                                                                           : start;
}

LowPlace LowPlaceSearch::on_face(const LowPlace& start) {
  LowPlace place = start;
  place.turn_x = place.turn_y = 0.0;
  Vec3d& normal = place.point.dir;
  DirectionCode frame(normal, start.x, start.y);
  double aside = kAside;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3d one = aside * (frame.x() + frame.y()), other = aside * (frame.x() - frame.y());
    const Vec3d first = ask(unit_along(normal + one)).w, opposite = ask(unit_along(normal - one)).w;
    const Vec3d next = ask(unit_along(normal + other)).w, last = ask(unit_along(normal - other)).w;
    const Vec3d face_normal = cross(first - opposite, next - last);
    if (!(dot(face_normal, face_normal) > 0x1p-40 * (size_ * size_) * (size_ * size_))) {
      // All on one side of an edge that the face has, or both diagonals the same: once more, farther and turned.
      if (step > 1) break;
      if (step == 1) aside = kWideAside;
      frame = DirectionCode(normal, frame.x() + frame.y(), frame.y() - frame.x());
      continue;
    }
    const Vec3d found = unit_along(dot(face_normal, normal) < 0.0 ? -face_normal : face_normal);
    const double change = norm(found - normal);
    if (!(change < kLongestStep)) break;
    normal = found;
    // Turned along x it is one pair of sides that the farthest point goes from and to, and along y the other.
    frame = DirectionCode(normal, cross(first - next, normal), cross(normal, first - last));
    if (change < kShortestStep) break;
    aside = kAside * kAside;
  }
  place.x = frame.x();
  place.y = frame.y();
  return place;
}

LowPlace LowPlaceSearch::at_edge(const LowPlace& start) {
  LowPlace place = start;
  place.turn_y = 0.0;
  Vec3d& normal = place.point.dir;
  DirectionCode frame(normal, start.x, start.y);
  double aside = kAside, last_gradient = 0.0, last_turn = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3d ahead = ask(unit_along(normal + aside * frame.y())).w;
    const Vec3d behind = ask(unit_along(normal - aside * frame.y())).w;
    const Vec3d edge = ahead - behind;
    const double square = dot(edge, edge);
    if (!(square > 0x1p-20 * (size_ * size_))) {
      if (step > 0) break;
      aside = kWideAside;
      continue;
    }
    // Where the edge is nearest, and how the height goes from there across it.
    const Vec3d level = unit_along(normal - (dot(normal, edge) / square) * edge);
    const Vec3d across = unit_along(cross(edge, level));
    const double part = std::clamp(-dot(behind, edge) / square, 0.0, 1.0);
    const double gradient = dot(across, behind + part * edge);
    if (last_turn != 0.0 && aside < 0.5 * kAside && std::fabs(gradient - last_gradient) > 0x1p-30 * size_) {
      const double secant = last_turn / (gradient - last_gradient);
      if (secant > 0.0 && !is_flat(secant)) place.turn_x = secant;
    }
    last_gradient = gradient;
    last_turn = -place.turn_x * gradient;
    const double change = std::fabs(last_turn);
    if (!(change < kLongestStep)) break;
    normal = unit_along(level + last_turn * across);
    frame = DirectionCode(normal, cross(edge, normal), edge);
    if (change < kShortestStep && aside < kAside) break;
    // The edge is known to some part of this, and with it how the normal is turned along it.
    aside *= std::clamp(8.0 * change, kAside, 0.25);
  }
  place.x = frame.x();
  place.y = frame.y();
  return place;
}

LowPlace LowPlaceSearch::around(const Vec3d& unit_dir) {
  constexpr double kBeside = 0x1p-13;
  const DirectionCode frame(unit_dir, {}, {});
  LowPlace place{ask(unit_dir), {}, {}, 0.0, 0.0};
  const auto change = [&](const Vec3d& axis) {
    return along_axes(frame, gradient_of(ask(unit_along(unit_dir + kBeside * axis))) - gradient_of(place.point));
  };
  const Across by_x = change(frame.x()), by_y = change(frame.y());
  const double factor = kBeside / (by_x.x * by_y.y - by_x.y * by_y.x);
  set_turns(place, frame, {factor * by_y.y, -factor * by_y.x, -factor * by_x.y, factor * by_x.x});
  return place;
}

LowPlace LowPlaceSearch::of_triangle(const Point& found, const std::array<Point, 3>& corners, double gap) {
  const double height = CoreDifference::height_of(found);
  const DirectionCode frame(found.dir, {}, {});
  std::array<Across, 3> dirs, gradients;
  for (std::size_t k = 0; k < 3; ++k) {
    dirs[k] = along_axes(frame, corners[k].dir);
    const Across w = along_axes(frame, corners[k].w);
    gradients[k] = {w.x - height * dirs[k].x, w.y - height * dirs[k].y};
  }
  const Across d1 = dirs[1] - dirs[0], d2 = dirs[2] - dirs[0];
  const Across g1 = gradients[1] - gradients[0], g2 = gradients[2] - gradients[0];
  const double inverse = 1.0 / (g1.x * g2.y - g1.y * g2.x);
  const Matrix turns = {(d1.x * g2.y - d2.x * g1.y) * inverse, (d2.x * g1.x - d1.x * g2.x) * inverse,
                        (d1.y * g2.y - d2.y * g1.y) * inverse, (d2.y * g1.x - d1.y * g2.x) * inverse};
  LowPlace place{found, {}, {}, 0.0, 0.0};
  set_turns(place, frame, turns);
  if (is_flat(place.turn_x) || is_flat(place.turn_y)) return lower_flat(place);
  const Across gradient = along_axes(frame, gradient_of(found)), turn = turns * gradient;
  // No height is lower by more.
  const double less = 0.5 * (turn.x * gradient.x + turn.y * gradient.y);
  if (less > 0.0 && less < gap) place.point.dir = unit_along(found.dir - in_space(frame, turn));
  return place;
}

}  // namespace vex
