// vex_mesh A [B]: the orientation-averaged excluded volume of two convex bodies, by Monte Carlo and by the formula.
#include <iostream>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/run_program.h"
#include "apps/vex_mesh/report.h"

namespace vex {
namespace {

int run_vex_mesh(const CommandLine& words, const std::string& command) {
  const Options options = interpret(words);

  std::vector<std::string> bodies = {options.a, options.b};
  bodies.insert(bodies.end(), options.control_variate.begin(), options.control_variate.end());
  CommandFiles files(files_of_bodies(bodies, options.bodies));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  if (!options.quiet) files.print_report();

  MeshRun run = prepare_run(options, load_two_bodies(options.a, options.b, options.bodies), command);
  catch_interrupts();
  sample(run);

  if (!options.quiet && !(json && json->is_standard_output())) std::cout << report_text(run);
  if (json) json->write(report_json(run));

  if (run.result.record.stopped_by == StopReason::interrupted) return kSignalBase + interrupting_signal().load();
  return exit_code_of(run);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Average excluded volume <V_ex> of two convex bodies: by Monte Carlo, and by the formula from V, S and M.",
      "vex_mesh");
  vex::CommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv, [&] { return vex::run_vex_mesh(words, vex::command_line(argc, argv)); });
}
