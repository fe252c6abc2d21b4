// vex_mesh A [B]: the orientation-averaged excluded volume of two convex bodies, by Monte Carlo and by the formula.
#include <iostream>
#include <memory>
#include <optional>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/ranks/program_ranks.h"
#include "apps/vex_mesh/announcement.h"
#include "apps/vex_mesh/history.h"
#include "apps/vex_mesh/html_report.h"
#include "apps/vex_mesh/mesh_run.h"
#include "apps/vex_mesh/report.h"
#include "apps/vex_mesh/run_identity.h"

namespace vex {
namespace {

constexpr const char* kProgram = "vex_mesh";

int run_vex_mesh(const CommandLine& words, const std::string& command, ProgramRanks* ranks) {
  const Options options = interpret(words);
  const bool leads = ranks == nullptr || ranks->leads();

  std::vector<std::string> bodies = {options.a, options.b};
  bodies.insert(bodies.end(), options.control_variate.begin(), options.control_variate.end());
  std::vector<std::string> inputs = files_of_bodies(bodies, options.bodies);
  const std::vector<std::string> tables = files_of_laws(words);
  inputs.insert(inputs.end(), tables.begin(), tables.end());
  if (!options.checkpoint.resume.empty() && !options.checkpoint.is_own_file()) {
    inputs.push_back(options.checkpoint.resume);
  }
  CommandFiles files(std::move(inputs));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  const std::optional<OutputFile> page = files.output("--report", options.report);
  std::optional<Checkpoint> checkpoint;
  if (const std::optional<OutputFile> file = files.output("--checkpoint", options.checkpoint.checkpoint)) {
    // Ranks that do not lead save nothing.
    if (leads) checkpoint.emplace(*file, kProgram, options.checkpoint);
  }
  if (!options.quiet) files.print_report();

  MeshRun run = prepare_run(options, load_two_bodies(options.a, options.b, options.bodies), command);
  ExcludedVolumeSettings& settings = run.options.settings;
  if (ranks != nullptr) {
    settings.ranks = ranks;
    std::string identity;
    for (const std::string& line : run_identity(run)) identity += line + "\n";
    ranks->introduce(identity);
  }
  std::optional<RunState> resumed;
  if (leads && has_run_to_resume(options.checkpoint, kProgram, options.quiet)) {
    resumed = read_checkpoint(options.checkpoint.resume, run);
    settings.resume = &*resumed;
  }
  if (!options.quiet) {
    settings.on_start = [&run](const Outlook& outlook) {
      const std::string text = announcement(outlook, run.options);
      if (!text.empty()) std::cerr << kProgram << ": " << text;
    };
  }
  catch_interrupts();
  History history;
  sample(run, "", checkpoint ? &*checkpoint : nullptr, [&history](const Progress& progress) { history.add(progress); });
  if (!leads) return kSuccess;

  Results results(kProgram);
  if (!options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  if (checkpoint) checkpoint->hand_over_unsaved(results);
  results.write(page, Results::Kind::picture, [&] {
    const std::vector<HistoryPoint> way = history_of(run.result, history, run.a.shape, run.b.shape, settings);
    return html_report(run, way, report_json(run));
  });
  const bool was_interrupted = run.result.record.stopped_by == StopReason::interrupted;
  return results.exit_code(was_interrupted ? kSignalBase + interrupting_signal().load() : exit_code_of(run));
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const std::unique_ptr<vex::ProgramRanks> ranks = vex::join_ranks();
  vex::OptionParser options(
      "Average excluded volume <V_ex> of two convex bodies: by Monte Carlo, and by the formula from V, S and M.",
      "vex_mesh");
  vex::CommandLine words;
  vex::declare_options(options, words);
  return vex::run_on_ranks(ranks.get(), options, argc, argv,
                           [&] { return vex::run_vex_mesh(words, vex::command_line(argc, argv), ranks.get()); });
}
