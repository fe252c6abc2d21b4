// What vex_scan says: a table on the screen, and the document of --json.
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_scan/scan_run.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

std::string number_text(double value, int digits) { return std::isfinite(value) ? short_number(value, digits) : "-"; }

bool is_incomplete(const ScanRow& row) { return row.more.contains("complete") && row.more["complete"] == false; }

}  // namespace

std::string report_text(const ScanRun& run) {
  const std::vector<ScanVariable>& variables = run.scan.variables;
  bool has_two_bodies = false;
  for (const ScanRow& row : run.rows) has_two_bodies = has_two_bodies || row.a != row.b;
  std::vector<std::vector<std::string>> lines(1);
  lines[0].push_back("a");
  if (has_two_bodies) lines[0].push_back("b");
  for (const ScanVariable& variable : variables) lines[0].push_back(variable.name);
  for (const char* column : {"<V_ex>", "reference", "z", "reduced", "seconds"}) lines[0].push_back(column);
  for (const ScanRow& row : run.rows) {
    std::vector<std::string> line = {printable(row.a)};
    if (has_two_bodies) line.push_back(printable(row.b));
    line.insert(line.end(), row.values.begin(), row.values.end());
    if (!row.error.empty()) {
      line.push_back("refused");
    } else {
      line.push_back(with_error(row.excluded_volume, row.std_error) + (is_incomplete(row) ? " incomplete" : ""));
      line.push_back(number_text(row.reference, 10));
      line.push_back(number_text(row.z, 3));
      line.push_back(number_text(row.reduced, 8));
      line.push_back(number_text(row.seconds, 3));
    }
    lines.push_back(std::move(line));
  }
  std::string text = table_text(lines, 2);
  text += "\n  " + plural(run.rows.size(), "case", "cases") + " in " + short_number(run.seconds, 3) + " s";
  if (run.n_kept > 0) text += ", " + std::to_string(run.n_kept) + " of them kept from the file";
  if (run.n_refused > 0) text += ", " + std::to_string(run.n_refused) + " refused";
  if (!run.complete) {
    text += " - INTERRUPTED: " + std::to_string(run.scan.n_cases() - run.rows.size()) + " cases are left";
  }
  text += "\n";
  if (run.has_disagreement) {
    text += "  Monte Carlo and reference DISAGREE in a case (more than --max-z " + short_number(run.options.max_z) +
            " standard errors)\n";
  }
  if (run.has_fault) text += "  a verdict could not be proven again: run that case with vex_mesh --verify\n";
  return text;
}

std::string report_json(const ScanRun& run) {
  Json json = document_head(run.command, run.options, run.complete, run.seconds);
  json["variables"] = Json::array();
  for (const ScanVariable& variable : run.scan.variables) {
    Json values = Json::array();
    for (const std::string& value : variable.values) values.push_back(parse_number(value, variable.name));
    json["variables"].push_back({{"name", variable.name}, {"values", std::move(values)}});
  }
  json["cases"] = run.scan.n_cases();
  json["kept"] = run.n_kept;
  json["refused"] = run.n_refused;
  json["rows"] = Json::array();
  for (const ScanRow& row : run.rows) json["rows"].push_back(row_json(run.scan, row));
  return document_text(json);
}

}  // namespace vex
