// What came out of each case, and the files that hold it.
#pragma once

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/vex_mesh/mesh_run.h"
#include "apps/vex_scan/scan.h"

namespace vex {

/// Volumes in length^3, NaN where there is no such number.
struct ScanRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::vector<std::string> values;  // of the variables
  std::string a, b;
  double excluded_volume = kNone, std_error = kNone, reference = kNone, z = kNone, b2 = kNone, reduced = kNone;
  double seconds = kNone;
  std::string error;  // why the case was refused
  std::string input;  // the fingerprint of all that the row follows from; empty of a refused one
  nlohmann::ordered_json more = nlohmann::ordered_json::object();  // further keys of JSON lines
};

ScanRow row_of(const ScanCase& one, const MeshRun& run);
ScanRow refused_row(const ScanCase& one, const std::string& error);

/// Of all that a row follows from: program, words, seed, and the bodies as they were loaded.
std::string input_of(const ScanCase& one, const MeshRun& prepared);

std::string csv_text(const Scan& scan, const std::vector<ScanRow>& rows);
std::string jsonl_text(const Scan& scan, const std::vector<ScanRow>& rows);
nlohmann::ordered_json row_json(const Scan& scan, const ScanRow& row);

/// A scan's rows take the place of what its --csv and --jsonl hold: throws UsageError where that is anything but rows
/// of a scan over the same variables. Devices, pipes and empty files hold nothing.
void require_rows_or_nothing(const Scan& scan);

/// Rows by their input. Lines that are no rows of these variables, or have no input, are passed over: their cases are
/// run again. Nothing where there is no such file, or where it is no regular one.
std::map<std::string, ScanRow> rows_of_csv(const std::string& path, const Scan& scan);
std::map<std::string, ScanRow> rows_of_jsonl(const std::string& path, const Scan& scan);

}  // namespace vex
