#include "apps/vex_mesh/run_identity.h"

#include "apps/common/body_identity.h"
#include "apps/common/checkpoint.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/run_state_text.h"

namespace vex {
namespace {

constexpr std::string_view kTitle = "vex_mesh checkpoint";

std::string word_or(const std::string& word, const char* otherwise) { return word.empty() ? otherwise : word; }

}  // namespace

std::vector<std::string> trials_identity(const MeshRun& run) {
  const ExcludedVolumeSettings& settings = run.options.settings;
  std::vector<std::string> lines = {"vex: " + version() + ", stream " + std::to_string(kStreamVersion),
                                    "A: " + body_identity(run.a.shape), "B: " + body_identity(run.b.shape)};
  for (const LoadedBody& simpler : run.control_bodies) {
    lines.push_back("control variate: " + body_identity(simpler.shape));
  }
  lines.push_back("orientations: " + settings.law.name());
  lines.push_back("seed: " + std::to_string(settings.seed));
  lines.push_back("estimator: " + word_or(settings.estimator, "chosen") + ", sequence " +
                  (settings.sequence ? std::string(name_of(*settings.sequence)) : "usual") + ", domain " +
                  word_or(settings.domain, "best"));
  std::string backends = "backend: " + settings.backend.name + ", quick verdicts " +
                         (settings.quick_verdicts ? "yes" : "no") + ", verified " + (settings.verify ? "yes" : "no");
  for (const BackendKind& kind : settings.cross_check) backends += ", checked by " + kind.name;
  lines.push_back(backends);
  return lines;
}

std::vector<std::string> run_identity(const MeshRun& run) {
  const ExcludedVolumeSettings& settings = run.options.settings;
  std::vector<std::string> lines = trials_identity(run);
  std::string stop = "stop: first trial " + std::to_string(settings.first_trial) + ", rel. error " +
                     (settings.rel_error ? shortest_number(*settings.rel_error) : "none") + ", at most " +
                     std::to_string(settings.max_trials);
  // Where nothing else ends it, a run is given up when the error cannot be reached.
  if (settings.rel_error) stop += settings.trials || settings.seconds ? ", or before" : ", alone";
  lines.push_back(stop);
  return lines;
}

std::string checkpoint_text(const MeshRun& run, const RunState& state) {
  return sealed_text(kTitle, run_identity(run), run_state_text(state));
}

RunState read_checkpoint(const std::string& path, const MeshRun& run) {
  return read_run_state(read_sealed_text(path, kTitle, run_identity(run)));
}

}  // namespace vex
