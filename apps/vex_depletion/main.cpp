// vex_depletion A [B]: the attraction of two hard bodies among balls that they exclude.
#include <cmath>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_depletion/depletion_run.h"

namespace vex {
namespace {

int run_vex_depletion(const DepletionCommandLine& words, const std::string& command) {
  const DepletionOptions options = interpret(words);
  const std::vector<std::string> bodies = {options.a, options.b};
  std::vector<std::string> inputs = files_of_bodies(bodies, options.body_options);
  const std::vector<std::string> tables = files_of_laws(words);
  inputs.insert(inputs.end(), tables.begin(), tables.end());
  CommandFiles files(std::move(inputs));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  const std::optional<OutputFile> csv = files.output("--csv", options.csv);
  const std::optional<OutputFile> plot = files.output("--plot", options.plot);
  if (!options.quiet) files.print_report();

  auto [a, b] = load_two_bodies(options.a, options.b, options.body_options);
  if (options.dump_vertices) require_vertices_to_list(a, b);
  DepletionRun run{command, options, std::move(a), std::move(b)};
  catch_interrupts();
  run_cases(run);

  Results results("vex_depletion", files.own_standard_output());
  if (!options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(csv, Results::Kind::numbers, [&] { return csv_text(run); });
  results.write(plot, Results::Kind::picture, [&] { return picture_of(run); });
  if (const int signal = interrupting_signal().load(); signal != 0) return results.exit_code(kSignalBase + signal);
  bool agrees = true;
  for (const DepletionCase& one : run.cases) agrees = agrees && !(std::fabs(one.z) > options.max_z);
  return results.exit_code(agrees ? kSuccess : kDisagreement);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Depletion of two hard convex bodies among ideal balls (Asakura and Oosawa): the overlap volume of their "
      "depletion "
      "shells, at poses or on average, with its standard error, and the potential.",
      "vex_depletion");
  vex::DepletionCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_depletion(words, vex::command_line(argc, argv)); });
}
