#include "apps/vex_virial/run_identity.h"

#include <algorithm>

#include "apps/common/body_identity.h"
#include "apps/common/checkpoint.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/run_state_text.h"

namespace vex {
namespace {

constexpr std::string_view kTitle = "vex_virial checkpoint";

std::string heading(std::size_t k) { return "coefficient " + std::to_string(k + 1) + "\n"; }

}  // namespace

std::vector<std::string> trials_identity(const VirialRun& run) {
  const VirialSettings& settings = run.options.settings;
  std::vector<std::string> lines = {"vex: " + version() + ", stream " + std::to_string(kStreamVersion)};
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    lines.push_back((k == 0 ? "A: " : "B: ") + body_identity(run.bodies[k].shape));
  }
  lines.push_back(std::string("coefficients: ") +
                  (run.options.is_mixture() ? "third ones of a mixture" : "of one body, B3 by triangles"));
  if (settings.first_order > 3) lines.push_back("first coefficient: B" + std::to_string(settings.first_order));
  lines.push_back("orientations: " + settings.law.name());
  lines.push_back("seed: " + std::to_string(settings.seed));
  return lines;
}

std::vector<std::string> run_identity(const VirialRun& run) {
  const VirialSettings& settings = run.options.settings;
  std::vector<std::string> lines = trials_identity(run);
  const bool has_none = !settings.rel_error && !settings.seconds && !settings.samples && !settings.trials;
  std::string stop = "stop: first trial " + std::to_string(settings.first_trial) + ", rel. error " +
                     (settings.rel_error ? shortest_number(*settings.rel_error)
                      : has_none         ? "usual"
                                         : "none");
  if (settings.rel_error) {
    stop += settings.samples || settings.trials || settings.seconds ? ", or before" : ", alone";
  }
  lines.push_back(stop);
  return lines;
}

std::string checkpoint_text(const VirialRun& run, const std::vector<RunState>& states) {
  std::string text;
  for (std::size_t k = 0; k < states.size(); ++k) text += heading(k) + run_state_text(states[k]);
  return sealed_text(kTitle, run_identity(run), text);
}

std::vector<RunState> read_checkpoint(const std::string& path, const VirialRun& run) {
  const std::string text = read_sealed_text(path, kTitle, run_identity(run));
  std::vector<RunState> states;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string mine = heading(states.size()), next = heading(states.size() + 1);
    if (!rest.starts_with(mine)) {
      throw InputError("a state lacks a coefficient (" + path + ") - it is damaged, or of another version of vex");
    }
    rest.remove_prefix(mine.size());
    const std::size_t end = std::min(rest.find("\n" + next), rest.size() - 1) + 1;
    states.push_back(read_run_state(rest.substr(0, end)));
    rest.remove_prefix(end);
  }
  return states;
}

}  // namespace vex
