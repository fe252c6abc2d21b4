#include "apps/vex_mesh/run_facts.h"

#include "shapes/formula.h"

namespace vex {

std::vector<std::string> backend_names(const MeshRun& run) {
  std::vector<std::string> names = {run.options.settings.backend.name};
  for (const BackendKind& kind : run.options.settings.cross_check) names.push_back(kind.name);
  return names;
}

bool samples_poses(const MeshRun& run) {
  return run.result.estimator != nullptr && run.result.estimator->samples_poses;
}
bool runs_gjk(const MeshRun& run) { return run.result.estimator == nullptr || run.result.estimator->runs_gjk; }
bool has_trials(const MeshRun& run) { return run.result.record.tally.n_trials > 0; }
double relative_error_of(const MeshRun& run) { return run.result.std_error / run.result.value; }

double pace_of(const MeshRun& run) {
  for (const Candidate& candidate : run.result.candidates) {
    if (candidate.estimator != run.result.estimator || run.result.record.tally.n_trials == 0) continue;
    const double counted = candidate.cost.seconds_per_trial * static_cast<double>(run.result.record.tally.n_trials);
    return run.result.record.seconds * run.options.n_threads / counted;
  }
  return 1.0;
}

double seconds_of(const Candidate& candidate, const MeshRun& run) {
  return pace_of(run) * candidate.cost.seconds_to(relative_error_of(run)) / run.options.n_threads;
}

double control_mean(const MeshRun& run) {
  return average_excluded_volume(run.control_bodies.front().shape.measures, run.control_bodies.back().shape.measures);
}

}  // namespace vex
