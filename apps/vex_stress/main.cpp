// vex_stress: bodies placed where overlap tests fail, every backend's answers, and exact arithmetic to judge them.
#include <chrono>
#include <iostream>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_stress/options.h"
#include "apps/vex_stress/plot.h"
#include "apps/vex_stress/report.h"

namespace vex {
namespace {

void measure_all(StressRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  StressSettings settings;
  settings.seed = run.options.seed;
  settings.n_pairs = run.options.pairs;
  settings.n_threads = run.options.n_threads;
  settings.backends = run.options.backends;
  settings.interrupt = &interrupting_signal();
  std::uint64_t n_done = 0;
  StopRule stop;
  stop.trials = 0;
  for (const Stratum& stratum : run.options.strata)
    *stop.trials += std::min<std::uint64_t>(run.options.pairs, stratum.most_poses);
  for (const Stratum& stratum : run.options.strata) {
    ProgressBar bar(!run.options.quiet, stratum.name + "  ");
    settings.on_progress = [&](std::uint64_t n_of_stratum) {
      Progress progress;
      progress.tally.n_trials = n_done + n_of_stratum;
      progress.seconds = seconds();
      progress.stop = stop;
      bar.show(progress);
    };
    run.rows.push_back(measure(stratum, settings));
    n_done += run.rows.back().n_pairs;
    run.complete = run.rows.back().complete && interrupting_signal().load() == 0;
    if (!run.complete) break;
  }
  run.seconds = seconds();
}

int run_vex_stress(const StressCommandLine& words, const std::string& command) {
  StressRun run{command, interpret(words)};
  if (run.options.list) {
    std::cout << list_text(run.options);
    return kSuccess;
  }
  CommandFiles files({});
  const std::optional<OutputFile> json = files.output("--json", run.options.json);
  const std::optional<OutputFile> plot = files.output("--plot", run.options.plot);
  if (!run.options.quiet) files.print_report();

  catch_interrupts();
  measure_all(run);
  Results results("vex_stress", files.own_standard_output());
  if (!run.options.quiet && !files.own_standard_output()) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(plot, Results::Kind::picture, [&] { return picture_of(run); });
  if (!run.complete) return results.exit_code(kSignalBase + interrupting_signal().load());
  return results.exit_code(run.total(0).n_faults() == 0 ? kSuccess : kFault);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Where overlap tests fail: near contact, extreme and degenerate, judged by exact arithmetic.", "vex_stress");
  vex::StressCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_stress(words, vex::command_line(argc, argv)); });
}
