// vex_nematic BODY: the isotropic and the nematic fluid of a hard body that are in equilibrium.
#include "apps/common/command_files.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_nematic/mixture_run.h"
#include "apps/vex_nematic/nematic_run.h"

namespace vex {
namespace {

int run_vex_nematic(const NematicCommandLine& words, const std::string& command) {
  const NematicOptions options = interpret(words);
  std::vector<std::string> bodies = {options.body};
  if (!options.other.empty()) bodies.push_back(options.other);
  CommandFiles files(files_of_bodies(bodies, options.body_options));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  const std::optional<OutputFile> plot = files.output("--plot", options.plot);
  if (!options.quiet) files.print_report();
  Results results("vex_nematic", files.own_standard_output());
  if (!options.other.empty()) {
    const NematicMixtureRun run = run_mixture(options, command);
    if (!options.quiet && !files.own_standard_output()) results.print(report_text(run));
    results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
    return results.exit_code(kSuccess);
  }
  const NematicRun run = run_nematic(options, command);
  if (!options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(plot, Results::Kind::picture, [&] { return picture_of(run); });
  return results.exit_code(kSuccess);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Isotropic-nematic coexistence of a hard convex body: densities, order parameter, pressure and chemical "
      "potential, "
      "from its excluded volume as a function of the angle between two axes.",
      "vex_nematic");
  vex::NematicCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_nematic(words, vex::command_line(argc, argv)); });
}
