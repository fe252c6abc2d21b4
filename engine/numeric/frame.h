// Right-handed frames, over lanes.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

/// Right-handed: across_1, across_2, axis.
template <class L>
struct Frame {
  Vec3<L> across_1, across_2, axis;
};

/// With a unit vector for its axis (T. Duff et al., "Building an orthonormal basis, revisited", J. Comput. Graph.
/// Tech. 6, 1, 2017).
template <class L>
Frame<L> frame_about(const Vec3<L>& n) {
  const L sign = select(n.z < L(0.0), L(-1.0), L(1.0));
  const L p = L(-1.0) / (sign + n.z), xy = (n.x * n.y) * p;
  return {{L(1.0) + sign * ((n.x * n.x) * p), sign * xy, -(sign * n.x)}, {xy, sign + (n.y * n.y) * p, -n.y}, n};
}

}  // namespace vex
