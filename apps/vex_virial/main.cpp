// vex_virial BODY: virial coefficients of hard convex bodies.
#include <memory>
#include <optional>
#include <utility>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/long_run.h"
#include "apps/common/progress_bar.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/ranks/program_ranks.h"
#include "apps/vex_virial/report.h"
#include "apps/vex_virial/run_identity.h"

namespace vex {
namespace {

constexpr const char* kProgram = "vex_virial";

void measure(VirialRun& run, Checkpoint* checkpoint) {
  VirialSettings& settings = run.options.settings;
  settings.interrupt = &interrupting_signal();
  const VirialOptions& options = run.options;
  std::optional<ProgressBar> bar;
  std::optional<LongRun> outlook;
  int n_shown = 0;
  settings.on_progress = [&](int n, const Progress& progress) {
    if (n != n_shown) {
      bar.reset();
      const std::string name = "B" + std::to_string(n);
      bar.emplace(!options.quiet, name);
      outlook.emplace(std::string(kProgram) + ": " + name, !options.quiet, options.n_threads, options.checkpoint);
      n_shown = n;
    }
    outlook->look(
        progress.seconds, [&progress] { return fraction_done(progress); }, [&bar] { bar->erase(); });
    bar->show(progress);
  };
  if (checkpoint != nullptr) {
    settings.on_state = [&run, checkpoint, &bar](const std::vector<RunState>& states) {
      checkpoint->save(checkpoint_text(run, states), [&bar] {
        if (bar) bar->erase();
      });
    };
  }
  if (!run.options.is_mixture()) {
    run.found = virial_coefficients(run.bodies[0].shape, settings);
    run.complete = run.found.complete;
    run.seconds = run.found.seconds;
    return;
  }
  run.mixed = third_virials_of_mixture(run.bodies[0].shape, run.bodies[1].shape, settings);
  for (const MixedVirial& mixed : run.mixed) {
    run.complete = run.complete && mixed.record.complete;
    run.seconds += mixed.record.seconds;
  }
}

int run_vex_virial(const VirialCommandLine& words, const std::string& command, ProgramRanks* ranks) {
  const bool leads = ranks == nullptr || ranks->leads();
  VirialRun run;
  run.command = command;
  run.options = interpret(words);
  const VirialOptions& options = run.options;
  std::vector<std::string> texts = {options.a};
  if (options.is_mixture()) texts.push_back(options.b);
  std::vector<std::string> inputs = files_of_bodies(texts, options.body_options);
  if (!options.law_file.empty()) inputs.push_back(options.law_file);
  const CheckpointOptions& parts = options.checkpoint;
  if (!parts.resume.empty() && !parts.is_own_file()) inputs.push_back(parts.resume);
  CommandFiles files(std::move(inputs));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  const std::optional<OutputFile> plot = files.output("--plot", options.plot);
  std::optional<Checkpoint> checkpoint;
  if (const std::optional<OutputFile> file = files.output("--checkpoint", parts.checkpoint)) {
    // Ranks that do not lead save nothing.
    if (leads) checkpoint.emplace(*file, kProgram, parts);
  }
  const std::optional<OutputFile> page = files.output("--report", options.report);
  if (!options.quiet) files.print_report();

  for (const std::string& text : texts) run.bodies.push_back(load_body(text, options.body_options));
  require_one_unit(run.bodies, options.body_options);
  if (options.dump_vertices) require_vertices_to_list(run.bodies);
  if (ranks != nullptr) {
    run.options.settings.ranks = ranks;
    std::string identity;
    for (const std::string& line : run_identity(run)) identity += line + "\n";
    ranks->introduce(identity);
  }
  if (leads && has_run_to_resume(parts, kProgram, options.quiet)) {
    run.options.settings.resume = read_checkpoint(parts.resume, run);
  }
  catch_interrupts();
  measure(run, checkpoint ? &*checkpoint : nullptr);
  if (!leads) return kSuccess;

  Results results(kProgram, files.own_standard_output());
  if (!options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  if (checkpoint) checkpoint->hand_over_unsaved(results);
  results.write(plot, Results::Kind::picture, [&] { return picture_of(run); });
  results.write(page, Results::Kind::picture, [&] { return html_report(run, report_json(run)); });
  const int signal = interrupting_signal().load();
  return results.exit_code(signal == 0 ? kSuccess : kSignalBase + signal);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const std::unique_ptr<vex::ProgramRanks> ranks = vex::join_ranks();
  vex::OptionParser options(
      "Virial coefficients B3 to B8 of hard convex bodies, by Monte Carlo over clusters of overlapping bodies (B3 of "
      "most bodies over triangles), with errors; and the compressibility factor of the series.",
      "vex_virial");
  vex::VirialCommandLine words;
  vex::declare_options(options, words);
  return vex::run_on_ranks(ranks.get(), options, argc, argv,
                           [&] { return vex::run_vex_virial(words, vex::command_line(argc, argv), ranks.get()); });
}
