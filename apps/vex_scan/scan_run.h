// A scan as it is run: its rows, and what is said of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/vex_scan/rows.h"

namespace vex {

struct ScanRun {
  std::string command;
  Scan scan;
  CommonOptions options{};
  std::vector<ScanRow> rows{};  // of the cases that were run or kept, in their order
  std::size_t n_kept = 0, n_refused = 0;
  bool complete = true;
  bool has_fault = false, has_disagreement = false;
  double seconds = 0.0;
};

/// Throws UsageError, that of the first case, where every case is wrong usage: then it is the command that is.
void require_a_case_that_means_something(const Scan& scan);

/// Runs all cases, but for those of which `earlier` has the row, until the end or an interrupt. `on_row` is called
/// before each case and at the end.
void run_scan(ScanRun& run, const std::map<std::string, ScanRow>& earlier, const std::function<void()>& on_row);

std::string report_text(const ScanRun& run);
std::string report_json(const ScanRun& run);
/// --plot
std::string picture_of(const ScanRun& run);

}  // namespace vex
