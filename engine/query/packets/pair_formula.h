// Which formula decides a pair's overlap, and its constants: worked out once for a pair, and not in a kernel.
#pragma once

#include <cstdint>

#include "engine/numeric/vec3.h"
#include "engine/query/packets/core_form.h"

namespace vex {

struct PairFormula {
  enum class Kind : std::uint8_t {
    none,
    boxes,       // by separating axes
    segments,    // or points, with balls about them: by their nearest points
    ellipsoids,  // by the direction between their nearest level sets
  };
  Kind kind = Kind::none;

  // Boxes and segments: from the centre to the largest corner.
  Vec3d centre_a, half_a, centre_b, half_b;
  // Segments: of the halves' squares; 0 of a point.
  double inverse_a = 0.0, inverse_b = 0.0;

  // Ellipsoids, all lengths times `unit`, a power of two.
  double unit = 1.0;
  Vec3d squares_a, axes_b;
  double share_a = 0.5, share_b = 0.5;  // which level set of each body touches the other's
  static constexpr double kMargin = 0x1p-20;
  double least_determinant = 0.0;  // above it a point is wrong by less than kMargin of the shortest semi-axis (E33)
};

/// ball_radius: of both bodies together. reach: farther than that B is not placed.
PairFormula pair_formula(const CoreForm& a, const CoreForm& b, double ball_radius, double reach);

}  // namespace vex
