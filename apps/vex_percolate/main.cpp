// vex_percolate BODY...: the percolation threshold of overlapping convex bodies.
#include <chrono>
#include <iostream>
#include <string_view>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "apps/common/status_line.h"
#include "apps/vex_percolate/realisations_file.h"
#include "apps/vex_percolate/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

struct Outputs {
  std::optional<OutputFile> json, plot, csv, gltf, report, checkpoint;

  bool own_standard_output() const {
    for (const std::optional<OutputFile>* const file : {&json, &plot, &csv, &gltf, &report}) {
      if (*file && (*file)->is_standard_output()) return true;
    }
    return false;
  }
};

Outputs output_files(const PercolateOptions& options) {
  std::vector<std::string> bodies;
  for (const BodyFraction& body : options.bodies) bodies.push_back(body.text);
  std::vector<std::string> inputs = files_of_bodies(bodies, options.body_options);
  // A run may go on in its own file: that is read before it is written.
  if (!options.resume.empty() && options.resume != options.checkpoint) inputs.push_back(options.resume);
  CommandFiles files(std::move(inputs));
  Outputs outputs;
  outputs.json = files.output("--json", options.json);
  outputs.plot = files.output("--plot", options.plot);
  outputs.csv = files.output("--csv", options.csv);
  outputs.gltf = files.output("--gltf", options.gltf, ".glb");
  outputs.report = files.output("--report", options.report);
  outputs.checkpoint = files.output("--checkpoint", options.checkpoint);
  if (!options.quiet) files.print_report();
  return outputs;
}

std::string status_of(const PercolateRun& run) {
  std::uint64_t fewest = ~std::uint64_t{0};
  for (const SizeRun& size : run.sizes) fewest = std::min<std::uint64_t>(fewest, size.found.size());
  std::string text = "vex_percolate: " + std::to_string(fewest) + " realisations of each size";
  const std::optional<CriticalValues> values = critical_values(run);
  if (values && values->eta) text += ", eta_c " + with_error(values->eta->value, values->eta->std_error);
  return text;
}

int run_vex_percolate(const PercolateCommandLine& words, const std::string& command) {
  const PercolateOptions options = interpret(words);
  const Outputs outputs = output_files(options);
  PercolateRun run = prepare(options, command);
  if (!options.resume.empty()) resume_from(options.resume, run);
  catch_interrupts();

  using Clock = std::chrono::steady_clock;
  Clock::time_point saved = Clock::now();
  constexpr std::chrono::seconds kBetween{30};
  StatusLine status(!options.quiet);
  percolate(
      run, [&] { status.show(status_of(run)); },
      [&] {
        if (!outputs.checkpoint || Clock::now() - saved < kBetween) return;
        outputs.checkpoint->write_catching_interrupts(realisations_text(run));
        saved = Clock::now();
      });
  status.erase();

  const int signal = interrupting_signal().load();
  run.complete = signal == 0;
  if (outputs.checkpoint) outputs.checkpoint->write_catching_interrupts(realisations_text(run));
  if (!options.quiet && !outputs.own_standard_output()) std::cout << report_text(run);
  if (outputs.csv) outputs.csv->write_catching_interrupts(realisations_text(run));
  if (outputs.plot) outputs.plot->write_catching_interrupts(picture_of(run));
  const bool has_sample = !run.sizes.front().found.empty();
  if (outputs.gltf && has_sample) outputs.gltf->write_catching_interrupts(sample_gltf(run));
  if (outputs.json || outputs.report) {
    const std::string document = report_json(run);
    const std::string html = outputs.report ? html_report(run, document) : std::string();
    if (outputs.json) outputs.json->write(document);
    if (outputs.report) outputs.report->write(html);
  }
  return signal == 0 ? kSuccess : kSignalBase + signal;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  // The parser would take it for an option.
  for (int k = 1; k < argc; ++k) {
    if (std::string_view(argv[k]).starts_with("-:")) {
      std::cerr << "vex_percolate: standard input has no fraction as - (" << argv[k]
                << ") - write /dev/stdin:FRACTION, and its --format\n";
      return vex::kWrongUsage;
    }
  }
  vex::OptionParser options(
      "Percolation threshold of overlapping convex bodies, placed at random in a periodic cube: with which density a "
      "cluster first spans it, extrapolated to infinite space, with errors.",
      "vex_percolate");
  vex::PercolateCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_percolate(words, vex::command_line(argc, argv)); });
}
