// What a trial costs, counted and not measured: the same every time and on every machine, so that what is chosen by it
// hangs on the bodies and the seed alone, and never on what else the machine was doing.
#pragma once

#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/radial/radial_map.h"

namespace vex {

/// The price of a support call in a packet, about, in nanoseconds of one thread of the machine that prices were found
/// on (docs/estimators.md, "The choice"): by the kind of the core, and by how many vertices are scanned. Of a body that
/// kernels do not take it is that of a call of its own.
double support_price(const ConvexBody& body);

/// Of a trial of hit or miss: the poses of some trials of the settings, those that the quick verdicts leave open being
/// searched one by one; their support calls at the bodies' prices, and what drawing such a pose costs. A peer's at a
/// price for all of them.
double pose_cost(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings);

/// Of a value of the radial estimator: some of its rays are cast one by one.
double ray_cost(const ConvexBody& a, const ConvexBody& b, const RadialMap& map);

}  // namespace vex
