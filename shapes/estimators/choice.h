// Which estimator is the fastest for a pair: found by a pilot, from the seed and the bodies alone.
#pragma once

#include <optional>
#include <vector>

#include "engine/sampling/pilot.h"
#include "shapes/estimators/estimator.h"

namespace vex {

/// One way to the answer, and what it costs.
struct Candidate {
  const Estimator* estimator = nullptr;
  Sequence sequence{};
  PilotCost cost;
};

/// Measures the estimators for this pair: those among which `chosen_of` chooses, then, but for large meshes, the ones
/// that share the formula's geometry. What is not for the pair is left out, and what an interrupt came before.
std::vector<Candidate> measure_candidates(const Body& a, const Body& b, const MonteCarloSettings& settings);

/// Of those that run GJK the one that takes the least time to the error, each by its handicap: not the radial one where
/// another takes less than a quarter of its time. Nothing where none is among them.
std::optional<Candidate> chosen_of(const std::vector<Candidate>& candidates, double relative_error);

}  // namespace vex
