// vex_percolate BODY...: the percolation threshold of overlapping convex bodies.
#include <iostream>
#include <memory>
#include <string_view>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/long_run.h"
#include "apps/common/numbers.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/common/status_line.h"
#include "apps/ranks/program_ranks.h"
#include "apps/vex_percolate/realisations_file.h"
#include "apps/vex_percolate/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr const char* kProgram = "vex_percolate";

struct Outputs {
  std::optional<OutputFile> json, plot, csv, gltf, report;
  std::optional<Checkpoint> checkpoint;
  bool own_standard_output = false;  // one of them
};

Outputs output_files(const PercolateOptions& options, bool leads) {
  std::vector<std::string> bodies;
  for (const BodyFraction& body : options.bodies) bodies.push_back(body.text);
  std::vector<std::string> inputs = files_of_bodies(bodies, options.body_options);
  inputs.insert(inputs.end(), options.law_files.begin(), options.law_files.end());
  // A run may go on in its own file: that is read before it is written.
  const CheckpointOptions& parts = options.checkpoint;
  if (!parts.resume.empty() && !parts.is_own_file()) inputs.push_back(parts.resume);
  CommandFiles files(std::move(inputs));
  Outputs outputs;
  outputs.json = files.output("--json", options.json);
  outputs.plot = files.output("--plot", options.plot);
  outputs.csv = files.output("--csv", options.csv);
  outputs.gltf = files.output("--gltf", options.gltf, ".glb");
  outputs.report = files.output("--report", options.report);
  if (const std::optional<OutputFile> file = files.output("--checkpoint", parts.checkpoint)) {
    // Ranks that do not lead save nothing.
    if (leads) outputs.checkpoint.emplace(*file, kProgram, parts);
  }
  if (!options.quiet) files.print_report();
  outputs.own_standard_output = files.own_standard_output();
  return outputs;
}

std::string status_of(const PercolateRun& run) {
  std::uint64_t fewest = ~std::uint64_t{0};
  for (const SizeRun& size : run.sizes) fewest = std::min<std::uint64_t>(fewest, size.found.size());
  std::string text = std::to_string(fewest) + " realisations of each size";
  const std::optional<CriticalValues> values = critical_values(run);
  if (values && values->eta) text += ", eta_c " + with_error(values->eta->value, values->eta->std_error);
  return text;
}

int run_vex_percolate(const PercolateCommandLine& words, const std::string& command, ProgramRanks* ranks) {
  const bool leads = ranks == nullptr || ranks->leads();
  const PercolateOptions options = interpret(words);
  Outputs outputs = output_files(options, leads);
  PercolateRun run = prepare(options, command);
  if (ranks != nullptr) {
    std::string identity;
    for (const std::string& line : system_lines(run)) identity += line + "\n";
    ranks->introduce(identity);
  }
  if (leads && has_run_to_resume(options.checkpoint, kProgram, options.quiet))
    resume_from(options.checkpoint.resume, run);
  catch_interrupts();

  StatusLine status(!options.quiet);
  LongRun outlook(std::string(kProgram) + ": the run", !options.quiet, options.n_threads, options.checkpoint);
  percolate(
      run, [&] { status.show(kProgram, [&] { return status_of(run); }); },
      [&] {
        outlook.look(
            run.seconds_before + run.seconds, [&run] { return share_done(run); }, [&status] { status.erase(); });
        if (!outputs.checkpoint || !outputs.checkpoint->is_due()) return;
        outputs.checkpoint->save(realisations_text(run), [&status] { status.erase(); });
      },
      ranks);
  status.erase();
  if (!leads) return kSuccess;

  const int signal = interrupting_signal().load();
  run.complete = signal == 0;
  if (outputs.checkpoint) outputs.checkpoint->save(realisations_text(run));
  Results results(kProgram, outputs.own_standard_output);
  const auto realisations = [&] { return realisations_text(run); };
  if (!options.quiet && !outputs.own_standard_output) results.print(report_text(run));
  results.write(outputs.json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(outputs.csv, Results::Kind::numbers, realisations);
  if (outputs.checkpoint) outputs.checkpoint->hand_over_unsaved(results);
  results.write(outputs.plot, Results::Kind::picture, [&] { return picture_of(run); });
  const bool has_sample = !run.sizes.front().found.empty();
  results.write(outputs.report, Results::Kind::picture, [&] { return html_report(run, report_json(run)); });
  if (has_sample) results.write(outputs.gltf, Results::Kind::model, [&] { return sample_gltf(run); });
  return results.exit_code(signal == 0 ? kSuccess : kSignalBase + signal);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const std::unique_ptr<vex::ProgramRanks> ranks = vex::join_ranks();
  // The parser would take it for an option.
  for (int k = 1; k < argc; ++k) {
    if (std::string_view(argv[k]).starts_with("-:")) {
      std::cerr << "vex_percolate: standard input has no fraction as - (" << argv[k]
                << ") - write /dev/stdin:FRACTION, and its --format\n";
      return ranks == nullptr ? vex::kWrongUsage : ranks->leave(vex::kWrongUsage);
    }
  }
  vex::OptionParser options(
      "Percolation threshold of overlapping convex bodies, placed at random in a periodic cube: with which density a "
      "cluster first spans it, extrapolated to infinite space, with errors.",
      "vex_percolate");
  vex::PercolateCommandLine words;
  vex::declare_options(options, words);
  return vex::run_on_ranks(ranks.get(), options, argc, argv,
                           [&] { return vex::run_vex_percolate(words, vex::command_line(argc, argv), ranks.get()); });
}
