// What an eye far away sees of a convex body, from its support mapping alone.
//
// The surface is walked by its normals: s(n) for n on a great circle is a silhouette, and s(n) for n on a small circle
// about the direction of the light is a line of equal brightness. So nothing below knows what the body is.
#pragma once

#include <vector>

#include "engine/support/convex_body.h"

namespace vex {

/// The points whose normals are perpendicular to `unit_view`, in order. Neighbours are closer than `step` or joined by
/// a straight line of the body's outline.
std::vector<Vec3d> silhouette(const ConvexBody& body, const Vec3d& unit_view, double step);

/// The boundary of what is seen with a brightness n . unit_light of at least `brightness`, -1 < brightness < 1. The
/// light comes from the eye's side: unit_light . unit_view > 0.
std::vector<Vec3d> lit_region(const ConvexBody& body, const Vec3d& unit_view, const Vec3d& unit_light,
                              double brightness, double step);

/// a / |a|.
Vec3d normalised(const Vec3d& a);

}  // namespace vex
