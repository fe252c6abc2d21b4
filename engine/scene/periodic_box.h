// The cell that a periodic scene repeats in all three directions.
#pragma once

#include <array>
#include <cmath>

#include "engine/numeric/vec3.h"

namespace vex {

/// By how many lattice vectors a copy of a body is moved.
using ImageOffset = std::array<int, 3>;

inline ImageOffset image_sum(const ImageOffset& a, const ImageOffset& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline ImageOffset image_difference(const ImageOffset& a, const ImageOffset& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// A cell with the lattice vectors a = (Lx, 0, 0), b = (xy Ly, Ly, 0), c = (xz Lz, yz Lz, Lz): HOOMD-blue's convention.
/// It holds the points whose coordinates along a, b, c are in [-1/2, 1/2).
class PeriodicBox {
 public:
  /// Edges between 1e-100 and 1e100, tilts between -100 and 100, faces no nearer than 1e-9 of its extent; throws
  /// InputError.
  PeriodicBox(double edge_x, double edge_y, double edge_z, double xy = 0.0, double xz = 0.0, double yz = 0.0);
  static PeriodicBox cube(double edge) { return {edge, edge, edge}; }

  const Vec3d& edges() const { return edges_; }
  double xy() const { return xy_; }
  double xz() const { return xz_; }
  double yz() const { return yz_; }
  double volume() const { return edges_.x * edges_.y * edges_.z; }

  /// (i a + j b) + k c, each operation rounded: what is added to a body's translation is exactly this.
  Vec3d shift(const ImageOffset& image) const;
  /// Coordinates along a, b, c.
  Vec3d fractional(const Vec3d& point) const;
  /// By which image a point is moved nearest to the origin, along a, b and c each.
  ImageOffset towards_origin(const Vec3d& point) const;
  /// Whether the coordinates along a, b, c are surely within -part/2 ... part/2, without a division; `part` at most
  /// .999.
  bool surely_holds(const Vec3d& point, double part) const {
    const double half = 0.5 * part, y = point.y - point.z * yz_, x = (point.x - y * xy_) - point.z * xz_;
    return std::fabs(x) < half * edges_.x && std::fabs(y) < half * edges_.y && std::fabs(point.z) < half * edges_.z;
  }
  /// The point moved into the cell, and by which image: by shift(image), rounded, once or, from far away, step by step.
  Vec3d wrapped(const Vec3d& point, ImageOffset* image) const;
  /// The distances between opposite faces.
  Vec3d face_distances() const;
  /// Of a point of the cell |x| + |y| + |z| is no more than half of this, and of a lattice vector no more.
  double largest_coordinate() const;

 private:
  Vec3d edges_;
  double xy_, xz_, yz_;
};

}  // namespace vex
