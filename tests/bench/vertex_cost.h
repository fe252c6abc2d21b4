// Cost of a trial against the number of vertices: hulls of random points on an ellipsoid 3:2:1.
#pragma once

#include "tests/bench/bench_report.h"

namespace vex {

/// With a picture. The peers' curves end where their time or the settings say so; what is made once for a body (hull,
/// table of directions) is timed apart.
BenchReport vertex_costs(const BenchSettings& settings);

}  // namespace vex
