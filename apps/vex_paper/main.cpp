// vex_paper: the tables and the text of Sreenivasan, Baker, Paul and Stanley (2002), computed again, and their faulty
// values with the overlap test that gives them.
#include <chrono>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_paper/options.h"
#include "apps/vex_paper/report.h"
#include "apps/vex_paper/rows.h"

namespace vex {
namespace {

// Runs one case after the other until one is interrupted.
class Runner {
 public:
  explicit Runner(PaperRun& run) : run_(run) {
    sampling_.seed = run.options.seed;
    sampling_.n_trials = run.options.trials;
    sampling_.n_threads = run.options.n_threads;
    sampling_.interrupt = &interrupting_signal();
  }

  void expect(std::size_t n_cases) { n_cases_ += n_cases; }

  /// `measure_one(case, sampling)`: false where the case was interrupted.
  template <class MeasureOne>
  void all(const std::vector<Case>& cases, const MeasureOne& measure_one) {
    for (const Case& what : cases) {
      if (!run_.complete) return;
      ++n_begun_;
      ProgressBar bar(!run_.options.quiet,
                      "row " + std::to_string(n_begun_) + " of " + std::to_string(n_cases_) + "  ");
      sampling_.on_progress = [&bar](const Progress& progress) { bar.show(progress); };
      run_.complete = measure_one(what, sampling_) && interrupting_signal().load() == 0;
    }
  }

 private:
  PaperRun& run_;
  Sampling sampling_;
  std::size_t n_cases_ = 0, n_begun_ = 0;
};

int run_vex_paper(const PaperCommandLine& words, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  PaperRun run{command, interpret(words)};
  CommandFiles files({});
  const std::optional<OutputFile> json = files.output("--json", run.options.json);
  if (!run.options.quiet) files.print_report();

  struct Part {
    std::vector<Case> cases;  // none where the part is not wanted
    std::function<bool(const Case&, const Sampling&)> measure_one;
  };
  // Where a measured row goes; `measure_row` gives none for a case that was interrupted before its first trial.
  const auto into = [](auto& rows, const auto& measure_row) {
    return [&rows, measure_row](const Case& what, const Sampling& sampling) {
      const auto row = measure_row(what, sampling);
      if (row) rows.push_back(*row);
      return row && row->record.complete;
    };
  };
  const auto if_wanted = [](bool wanted, std::vector<Case> (*cases)()) {
    return wanted ? cases() : std::vector<Case>{};
  };
  const std::vector<Part> parts = {
      {if_wanted(run.options.table_1, table_one), into(run.table_1, measure)},
      {if_wanted(run.options.table_2, table_two), into(run.table_2, measure)},
      {if_wanted(run.options.text, cases_of_the_text), into(run.text, measure)},
      {if_wanted(run.options.erratum, erratum_cases), into(run.erratum, measure_erratum)},
      {if_wanted(run.options.erratum, erratum_orientations), into(run.erratum_orientations, measure_erratum)},
      {if_wanted(run.options.curve, curve_cases), into(run.curve, measure_erratum)},
      {if_wanted(run.options.referees, referee_cases), [&run](const Case& what, const Sampling& sampling) {
         const std::vector<RefereeRow> rows = measure_referees(what, sampling);
         run.referees.insert(run.referees.end(), rows.begin(), rows.end());
         return rows.front().complete;
       }}};

  catch_interrupts();
  Runner runner(run);
  for (const Part& part : parts) runner.expect(part.cases.size());
  for (const Part& part : parts) runner.all(part.cases, part.measure_one);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  Results results("vex_paper");
  if (!run.options.quiet && !(json && json->is_standard_output())) results.print(report_text(run));
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  if (!run.complete) return results.exit_code(kSignalBase + interrupting_signal().load());
  return results.exit_code(run.has_disagreement() ? kDisagreement : kSuccess);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options("The excluded volumes of cond-mat/0207739 computed again, and its faulty ones explained.",
                            "vex_paper");
  vex::PaperCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_paper(words, vex::command_line(argc, argv)); });
}
