// The step that all searches by portals share, over lanes: which part of a portal a ray passes.
//
// A ray comes from a point v0 and passes the origin and the triangle (v1, v2, v3), whose corners turn about it as
// det(v1, v2, -v0) > 0 says. A support point w in front of the triangle splits it in three, by the planes through the
// ray and w. The ray passes the part of w and two of the corners; w takes the place of the third.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

template <class L>
struct PortalSplit {
  L past_1, past_2, past_3;  // on which side of its plane each corner is
  MaskOf<L> beside_12;       // the ray passes w, v1 and v2
  MaskOf<L> beside_31;       // or w, v3 and v1; never both; if neither, w, v2 and v3
};

/// `w_v0`: w x v0. Where the ray has a direction d and no beginning, as of casts, v0 is -d.
template <class L>
PortalSplit<L> split_portal(const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& v3, const Vec3<L>& w_v0) {
  const L past_1 = dot(v1, w_v0), past_2 = dot(v2, w_v0), past_3 = dot(v3, w_v0);
  const L zero(0.0);
  return {past_1, past_2, past_3, but_not(past_1 > zero, past_2 > zero), but_not(past_3 > zero, past_1 > zero)};
}

/// The corners beside w, in their order round the portal, and on which side each is.
template <class L>
struct PortalPart {
  Vec3<L> left, right;
  L past_left, past_right;
};
template <class L>
PortalPart<L> part_passed(const PortalSplit<L>& split, const Vec3<L>& v1, const Vec3<L>& v2, const Vec3<L>& v3) {
  return {select<L>(split.beside_12, v1, select<L>(split.beside_31, v3, v2)),
          select<L>(split.beside_12, v2, select<L>(split.beside_31, v1, v3)),
          select(split.beside_12, split.past_1, select(split.beside_31, split.past_3, split.past_2)),
          select(split.beside_12, split.past_2, select(split.beside_31, split.past_1, split.past_3))};
}

}  // namespace vex
