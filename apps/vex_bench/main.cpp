// vex_bench [BODY ...]: run time against error of every estimator and backend, in one run.
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_bench/options.h"
#include "apps/vex_bench/report.h"
#include "engine/numeric/errors.h"
#include "shapes/formula.h"

namespace vex {
namespace {

std::vector<BenchBody> bodies_of(const BenchOptions& options) {
  std::vector<BenchBody> bodies;
  if (options.standard) bodies = standard_bodies();
  for (const std::string& word : options.bodies) {
    LoadedBody loaded = load_body(word, options.body_options);
    bodies.push_back({word, word, std::move(loaded.shape)});
    const BenchBody& body = bodies.back();
    if (average_excluded_volume(body.shape.measures, body.shape.measures) == 0.0) {
      throw InputError("nothing to measure (" + word + "): two of it exclude no volume - leave it out");
    }
  }
  return bodies;
}

void measure_all(BenchRun& run, const std::vector<BenchBody>& bodies) {
  const auto start = std::chrono::steady_clock::now();
  BenchSettings settings;
  settings.seed = run.options.seed;
  settings.n_threads = run.options.n_threads;
  settings.seconds = run.options.seconds;
  settings.interrupt = &interrupting_signal();
  const bool shows = !run.options.quiet && isatty(STDERR_FILENO) != 0;
  std::string curve;
  settings.on_curve = [shows, &curve](const std::string& what) {
    curve = what;
    if (shows) std::fprintf(stderr, "\r\033[K%s", what.c_str());
  };
  settings.on_progress = [&curve](const Progress& progress) {
    answer_if_asked([&] { return curve + "  " + progress_text(progress); });
  };
  for (const BenchBody& body : bodies) {
    run.bodies.push_back(measure(body, settings));
    run.complete = interrupting_signal().load() == 0;
    if (!run.complete) break;
  }
  if (shows) std::fputs("\r\033[K", stderr);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int run_vex_bench(const BenchCommandLine& words, const std::string& command) {
  BenchRun run{command, interpret(words)};
  CommandFiles files(files_of_bodies(run.options.bodies, run.options.body_options));
  const std::optional<OutputFile> json = files.output("--json", run.options.json);
  const std::optional<OutputFile> csv = files.output("--csv", run.options.csv);
  const std::optional<OutputFile> plot = files.output("--plot", run.options.plot);
  const std::optional<OutputFile> others = files.output("--plot-others", run.options.plot_others);
  if (!run.options.quiet) files.print_report();
  const std::vector<BenchBody> bodies = bodies_of(run.options);

  catch_interrupts();
  measure_all(run, bodies);
  Results results("vex_bench", files.own_standard_output());
  if (!run.options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(csv, Results::Kind::numbers, [&] { return report_csv(run); });
  results.write(plot, Results::Kind::picture, [&] { return picture_of(run, Curves::main); });
  results.write(others, Results::Kind::picture, [&] { return picture_of(run, Curves::others); });
  return results.exit_code(run.complete ? kSuccess : kSignalBase + interrupting_signal().load());
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options("Run time against error of every estimator and backend of the excluded volume.",
                            "vex_bench");
  vex::BenchCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_bench(words, vex::command_line(argc, argv)); });
}
