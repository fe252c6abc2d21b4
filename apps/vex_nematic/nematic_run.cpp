#include "apps/vex_nematic/nematic_run.h"

#include <chrono>

namespace vex {

NematicRun run_nematic(const NematicOptions& options, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  NematicRun run{command, options, load_body(options.body, options.body_options)};
  if (options.dump_vertices) require_vertices_to_list({&run.body, 1});
  run.found = nematic_transition(run.body.shape, options.theory, options.trial_function);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace vex
