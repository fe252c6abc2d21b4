// What threads cost: one process with several beside as many processes with one.
#pragma once

#include "tests/bench/bench_report.h"

namespace vex {

/// Cubes, the same number of trials on both sides, by the wall clock.
BenchReport thread_scaling(const BenchSettings& settings);

}  // namespace vex
