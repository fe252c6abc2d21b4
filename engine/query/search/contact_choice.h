// Four of a manifold's contacts that keep what it supports: its area, and its depth.
#pragma once

#include <vector>

#include "engine/query/contact_manifold.h"
#include "engine/query/search/planar_polygon.h"

namespace vex {

/// Which of many corners of a convex polygon keep its area but for .3 % (a regular polygon of 63 corners has .9983 of
/// its circle's, and an ellipse is the worst of shapes): those that are farthest in one of 63 directions, and the one
/// that is nearest to the origin, in their order.
inline constexpr std::size_t kMostOutermost = 64;
void find_outermost(const std::vector<PlanarPoint>& places, std::vector<std::size_t>& outermost);

/// Of more than four contacts, corners of a convex polygon at these places, four that span the largest area but for 3
/// %; at least 2/pi of the polygon's, less as much (E. Sas, Compositio Mathematica 6, 1939): of those that do the ones
/// of the least features, so that the same ones are kept from step to step. Where the deepest is deeper than these by
/// more than `slope` times the smaller side of the places' box, it takes the place of the one that loses least; at
/// least half of the area is then left. Order stays.
void keep_four(std::vector<ContactManifold::Contact>& contacts, const std::vector<PlanarPoint>& places, double slope);

}  // namespace vex
