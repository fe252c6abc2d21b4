// A parallelepiped about the origin, and the map from the unit square to its surface that the radial estimator's rays
// are drawn by where bodies are long.
#pragma once

#include "engine/numeric/lane.h"
#include "engine/numeric/vec3.h"

namespace vex {

template <class L>
struct Block {
  Vec3<L> x, y, z;  // half edges
  L volume;         // of the whole, or of what a linear map makes of it

  /// A point of the surface: parts of this are hit as often as they have a share of the volume, between them and the
  /// origin (E19). Continuous: the lower sixth of u is for the face at -z, the upper one for that at z; v goes round.
  Vec3<L> surface_point(const L& u, const L& v) const {
    const L one(1.0), two(2.0), four(4.0), zero(0.0), half(0.5);
    const auto clamped = [&](const L& t) { return larger(-one, zero - larger(-one, zero - t)); };
    // From the middle of a side, on a perimeter of four.
    const auto distance = [&](const L& t) {
      const L there = absolute(t);
      return select(there > two, four - there, there);
    };
    const L along = four * v;
    const L at_x = clamped(two - two * distance(along - half)), at_y = clamped(two - two * distance(along - L(1.5)));
    const L from_end = select(u < half, u, one - u);
    const L scale = square_root(clamped(L(6.0) * from_end));
    return ((scale * at_x) * x + (scale * at_y) * y) + clamped(L(3.0) * (u - half)) * z;
  }
};

}  // namespace vex
