// A direction in 32 bits: fine where it is near a middle direction, coarse where it is far from it, as the directions
// are that a search asked for around its answer.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>

#include "engine/numeric/directions.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// Directions about a middle one in its stereographic projection, by coordinates along two axes across it, each a float
/// cut to 16 bits: each is kept to 2^-8 of itself. The axes need not be at right angles: what is exactly across an edge
/// of a body stays so if one axis is.
class DirectionCode {
 public:
  /// About the z axis, along x and y.
  DirectionCode() : middle_{0.0, 0.0, 1.0}, x_{1.0, 0.0, 0.0}, y_{0.0, 1.0, 0.0} {}
  /// `middle`: unit, to a few u. The axes: of any length, any direction; others are taken for those that are of no use.
  DirectionCode(const Vec3d& middle, const Vec3d& x, const Vec3d& y)
      : middle_(middle), x_(across_or_any(x, least_axis(middle))), y_(across_or_any(y, cross(middle, x_))) {
    cosine_ = dot(x_, y_);
    if (!(cosine_ * cosine_ < 0.99)) {
      y_ = across_or_any(cross(middle_, x_), y_);
      cosine_ = 0.0;
    }
  }

  const Vec3d& middle() const { return middle_; }
  /// Unit vectors across the middle.
  const Vec3d& x() const { return x_; }
  const Vec3d& y() const { return y_; }

  /// Of a unit vector.
  std::uint32_t code(const Vec3d& unit_dir) const {
    constexpr double kBehind = 0x1p-10;  // no direction is farther behind than that
    const double scale = 1.0 / ((1.0 - cosine_ * cosine_) * larger(1.0 + dot(unit_dir, middle_), kBehind));
    const double along_x = dot(unit_dir, x_), along_y = dot(unit_dir, y_);
    return cut(scale * (along_x - cosine_ * along_y)) << 16 | cut(scale * (along_y - cosine_ * along_x));
  }
  /// A unit vector to 4 u, whatever the code is; the middle itself where the code is none that `code` gives.
  Vec3d unit_dir(std::uint32_t code) const {
    const double u = whole(code >> 16), v = whole(code & 0xffffu);
    const double square = u * u + v * v + 2.0 * (u * v * cosine_);
    if (!(square < 0x1p40)) return middle_;
    const double scale = 1.0 / (1.0 + square);
    const Vec3d dir = ((2.0 * u * scale) * x_ + (2.0 * v * scale) * y_) + ((1.0 - square) * scale) * middle_;
    return (1.5 - 0.5 * dot(dir, dir)) * dir;  // Newton's step to 1 / |dir|, which is 1 to some u
  }

 private:
  // The part of v across the middle, of length one; where there is none, that of `other`.
  Vec3d across_or_any(const Vec3d& v, const Vec3d& other) const {
    for (const Vec3d& one : {v, other}) {
      const double size = norm_1(one);
      if (!(size > 0x1p-100 && size < 0x1p100)) continue;
      const Vec3d across = one - dot(one, middle_) * middle_;
      if (!(norm_1(across) > 0x1p-20 * size)) continue;
      const Vec3d unit = unit_along(across);
      return unit_along(unit - dot(unit, middle_) * middle_);
    }
    return unit_along(cross(middle_, least_axis(middle_)));
  }
  // To the nearest.
  static std::uint32_t cut(double x) {
    return ((std::bit_cast<std::uint32_t>(static_cast<float>(x)) + 0x8000u) >> 16) & 0xffffu;
  }
  static double whole(std::uint32_t cut) { return static_cast<double>(std::bit_cast<float>(cut << 16)); }

  Vec3d middle_, x_, y_;
  double cosine_ = 0.0;
};

}  // namespace vex
