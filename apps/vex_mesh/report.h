// What vex_mesh says of a run: on the screen and in JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/referees/exact_average.h"
#include "apps/vex_mesh/options.h"
#include "engine/sampling/monte_carlo.h"

namespace vex {

/// The formula's side of the comparison; never in contact with the run.
struct FormulaResult {
  double excluded_volume = 0.0;
  double reduced = 0.0;
  double b2 = 0.0;
};

/// All that is reported.
struct MeshRun {
  std::string command;
  Options options;
  LoadedBody a, b;
  Estimator estimator{};
  Sequence sequence{};
  std::vector<Candidate> candidates{};       // of the pilot, where the estimator was its choice
  std::vector<LoadedBody> control_bodies{};  // of a control variate: of both, or one for each
  double control_weight = 0.0;
  Domain domain{};  // of hit or miss
  std::optional<FormulaResult> formula{};
  std::string formula_reason{};  // where there is none; then:
  std::optional<ExactAverage> exact_average{};
  std::vector<std::string> left_out{};  // of a cross-check: why a backend does not take part
  std::string no_run_reason{};          // where the excluded volume is 0 by construction, and nothing was sampled
  RunRecord record{};
  std::optional<VolumeEstimate> estimate{};  // none where not one trial was done
  std::optional<double> z{};
  std::string z_reason{};  // where there is none
};

FormulaResult formula_result(const Measures& a, const Measures& b);

/// Fills `estimate`, `z` and their reasons from the record.
void compare(MeshRun& run);

/// The document of --json.
std::string report_json(const MeshRun& run);
std::string report_text(const MeshRun& run);

}  // namespace vex
