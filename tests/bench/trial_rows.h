// Whole trials beside the peers' queries alone, on the same poses, in one run.
#pragma once

#include "tests/bench/bench_report.h"

namespace vex {

/// The engine's whole trial, its query, and every instruction set of this machine, beside the peers as apps/peers asks
/// them.
BenchReport compare_trials(const BenchSettings& settings);

/// The engine's whole trial and query of every kind of body that has a name, beside libccd on its support mappings.
BenchReport trials_of_kinds(const BenchSettings& settings);

/// Random numbers, poses and support points by themselves beside whole trials: what no faster proof would spare.
BenchReport trial_parts(const BenchSettings& settings);

/// The engine's whole trial beside the peers at their own best (best_peers.h).
BenchReport compare_best_peers(const BenchSettings& settings);

}  // namespace vex
