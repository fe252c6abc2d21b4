#include "shapes/estimators/choice.h"

#include "engine/numeric/errors.h"

namespace vex {

std::vector<Candidate> measure_candidates(const Body& a, const Body& b, const MonteCarloSettings& settings) {
  std::vector<Candidate> candidates;
  // Of meshes with more faces than this the others' set-up would take as long as the run.
  constexpr std::size_t kMostFaces = 20000;
  const auto measure = [&](const Estimator& estimator) {
    if (settings.interrupt != nullptr && settings.interrupt->load() != 0 && !candidates.empty()) return;
    if (!estimator.runs_gjk && a.n_faces + b.n_faces > kMostFaces) return;
    MonteCarloSettings with = settings;
    with.sequence = estimator.pilot_sequence;
    try {
      set_estimator(with, estimator, a, b);
      if (!with.integrand && hits_by_construction(a, b, with.law, with.domain)) return;
      candidates.push_back({&estimator, estimator.pilot_sequence, pilot(a, b, with)});
    } catch (const UsageError&) {  // it is not for the pair, or its values are lost to rounding
    }
  };
  for (const Estimator* const estimator : estimators()) measure(*estimator);
  return candidates;
}

std::optional<Candidate> chosen_of(const std::vector<Candidate>& candidates, double relative_error) {
  std::optional<Candidate> chosen;
  double least = 0.0;
  for (const Candidate& candidate : candidates) {
    if (!candidate.estimator->runs_gjk) continue;
    const double seconds = candidate.estimator->handicap * candidate.cost.seconds_to(relative_error);
    if (chosen && !(seconds < least)) continue;
    least = seconds;
    chosen = candidate;
  }
  return chosen;
}

}  // namespace vex
