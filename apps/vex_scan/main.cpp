// vex_scan BODIES...: excluded volumes of many bodies, or of one that changes, a row a case.
#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/locked_file.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "apps/vex_scan/html_report.h"
#include "apps/vex_scan/scan_run.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr const char* kProgram = "vex_scan";

struct ScanOutputs {
  std::optional<OutputFile> json, csv, jsonl, plot, report;
  bool own_standard_output = false;  // one of them
};

/// All files that any case reads. What a case's words are worth is not looked at here.
std::vector<std::string> inputs_of(const Scan& scan) {
  std::set<std::string> texts, tables;
  for (std::size_t index = 0; index < scan.n_cases(); ++index) {
    const ScanCase one = case_of(scan, index);
    texts.insert(one.a());
    texts.insert(one.b());
    texts.insert(one.words.control_variate.begin(), one.words.control_variate.end());
    for (const std::string& file : files_of_laws(one.words)) tables.insert(file);
  }
  std::vector<std::string> inputs(tables.begin(), tables.end());
  BodyOptions options;
  options.format = scan.words.format;
  for (const std::string& text : texts) {
    try {
      const std::vector<std::string> files = files_of_bodies({&text, 1}, options);
      inputs.insert(inputs.end(), files.begin(), files.end());
    } catch (const Error&) {  // its case will say why
    }
  }
  return inputs;
}

ScanOutputs output_files(const Scan& scan, bool is_quiet) {
  CommandFiles files(inputs_of(scan));
  ScanOutputs outputs;
  outputs.json = files.output("--json", scan.words.json);
  outputs.csv = files.output("--csv", scan.words.csv);
  outputs.jsonl = files.output("--jsonl", scan.words.jsonl);
  outputs.plot = files.output("--plot", scan.words.plot);
  outputs.report = files.output("--report", scan.words.report);
  if (!is_quiet) files.print_report();
  outputs.own_standard_output = files.own_standard_output();
  return outputs;
}

/// A file of rows, which one scan alone goes on with at a time: of two each would put its rows in the place of the
/// other's. None where there is no file, or one that cannot be replaced.
std::unique_ptr<LockedFile> locked(const std::optional<OutputFile>& file, const std::string& option) {
  if (!file || file->may_wait_for_a_reader()) return nullptr;
  return std::make_unique<LockedFile>(*file, option);
}

/// Writes the rows while the scan runs, but no more often than this: a machine that goes down takes little with it.
class RowsSaver {
 public:
  RowsSaver(const ScanRun& run, const std::map<std::string, ScanRow>& earlier, LockedFile* jsonl, LockedFile* csv)
      : run_(run), earlier_(earlier), jsonl_(jsonl), csv_(csv) {}

  /// What a file holds now. As long as the scan is not at its end, rows of an earlier one stay behind the new ones:
  /// whoever stops it, or kills it, loses none.
  std::vector<ScanRow> rows(bool is_at_end) const {
    std::vector<ScanRow> all = run_.rows;
    if (!is_at_end) std::ranges::copy(rows_of_no_case(), std::back_inserter(all));
    return all;
  }

  /// Rows of an earlier scan that this one has not, so far.
  std::vector<ScanRow> rows_of_no_case() const {
    std::set<std::string> done;
    for (const ScanRow& row : run_.rows) done.insert(row.input);
    std::vector<ScanRow> left;
    for (const auto& [input, row] : earlier_) {
      if (!done.contains(input)) left.push_back(row);
    }
    return left;
  }

  void save_if_due() {
    constexpr std::chrono::milliseconds kBetween{500};
    const bool is_new = run_.rows.size() > n_saved_;
    if (!is_new || Clock::now() - saved_ < kBetween) return;
    // Lines of JSON first: they know more, and a scan that goes on takes from the table what they lack.
    save(jsonl_, [this] { return jsonl_text(run_.scan, rows(false)); });
    save(csv_, [this] { return csv_text(run_.scan, rows(false)); });
    n_saved_ = run_.rows.size();
    saved_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;

  // The scan goes on where the disk refuses: the rows are written once more at its end.
  void save(LockedFile* file, const std::function<std::string()>& rows) {
    if (file == nullptr) return;
    try {
      file->replace(rows());
    } catch (const std::exception& error) {
      if (!has_said_) std::cerr << kProgram << ": " << printable(error.what()) << "; the scan goes on\n";
      has_said_ = true;
    }
  }

  const ScanRun& run_;
  const std::map<std::string, ScanRow>& earlier_;
  LockedFile *jsonl_, *csv_;  // null where there is none
  std::size_t n_saved_ = 0;
  bool has_said_ = false;
  Clock::time_point saved_ = Clock::now();
};

/// Of both files; JSON lines know more.
std::map<std::string, ScanRow> earlier_rows(const Scan& scan) {
  std::map<std::string, ScanRow> rows = rows_of_jsonl(scan.words.jsonl, scan);
  rows.merge(rows_of_csv(scan.words.csv, scan));
  return rows;
}

int exit_code_of(const ScanRun& run) {
  if (!run.complete) return kSignalBase + interrupting_signal().load();
  if (run.has_fault) return kFault;
  if (run.n_refused > 0) return kInputRefused;
  return run.has_disagreement ? kDisagreement : kSuccess;
}

int run_vex_scan(const ScanCommandLine& words, const std::string& command) {
  ScanRun run{command, interpret(words)};
  run.options = interpret_common(words);
  require_a_case_that_means_something(run.scan);
  const ScanOutputs outputs = output_files(run.scan, run.options.quiet);
  require_rows_or_nothing(run.scan);
  const std::unique_ptr<LockedFile> jsonl = locked(outputs.jsonl, "--jsonl"), csv = locked(outputs.csv, "--csv");
  const std::map<std::string, ScanRow> earlier = earlier_rows(run.scan);
  catch_interrupts();
  RowsSaver saver(run, earlier, jsonl.get(), csv.get());
  run_scan(run, earlier, [&saver] { saver.save_if_due(); });

  if (const std::size_t n_left = saver.rows_of_no_case().size(); run.complete && n_left > 0) {
    std::cerr << kProgram << ": " << plural(n_left, "row", "rows") << " of an earlier scan in the same file "
              << (n_left == 1 ? "is" : "are") << " of no case of this one, and not kept\n";
  }
  Results results(kProgram, outputs.own_standard_output);
  results.write(outputs.jsonl, Results::Kind::numbers, [&] { return jsonl_text(run.scan, saver.rows(run.complete)); });
  results.write(outputs.csv, Results::Kind::numbers, [&] { return csv_text(run.scan, saver.rows(run.complete)); });
  if (!run.options.quiet && !outputs.own_standard_output) results.print(report_text(run));
  results.write(outputs.json, Results::Kind::numbers, [&] { return report_json(run); });
  results.write(outputs.plot, Results::Kind::picture, [&] { return picture_of(run); });
  results.write(outputs.report, Results::Kind::picture, [&] { return html_report(run, report_json(run)); });
  return results.exit_code(exit_code_of(run));
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Average excluded volumes of many bodies, of one whose sizes change, or at many angles: vex_mesh once a case, a "
      "row "
      "each.",
      "vex_scan");
  vex::ScanCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv, [&] { return vex::run_vex_scan(words, vex::command_line(argc, argv)); });
}
