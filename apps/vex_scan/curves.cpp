#include "apps/vex_scan/curves.h"

#include <cmath>
#include <map>

#include "apps/common/numbers.h"

namespace vex {
namespace {

/// A template of bodies is one curve, whatever the variable along x puts in.
std::string name_of_curve(const ScanRun& run, std::size_t index, std::size_t along_x, const ScanRow& row) {
  const Scan& scan = run.scan;
  std::size_t n_combinations = 1;
  for (const ScanVariable& variable : scan.variables) n_combinations *= variable.values.size();
  const auto& [a, b] = scan.pairs[index / n_combinations];
  std::string name = b.empty() ? a : a + ", " + b;
  for (std::size_t k = 0; k < scan.variables.size(); ++k) {
    if (k != along_x && scan.variables[k].values.size() > 1)
      name += ", " + scan.variables[k].name + " = " + row.values[k];
  }
  return name;
}

}  // namespace

std::size_t variable_along_x(const Scan& scan) {
  std::size_t best = kNoVariable, most = 1;
  for (std::size_t k = 0; k < scan.variables.size(); ++k) {
    if (scan.variables[k].values.size() < most) continue;
    most = scan.variables[k].values.size();
    best = k;
  }
  return most > 1 ? best : kNoVariable;
}

Curves curves_of(const ScanRun& run, std::size_t along_x) {
  Curves curves;
  std::map<std::string, std::size_t> places;
  for (std::size_t index = 0; index < run.rows.size(); ++index) {
    const ScanRow& row = run.rows[index];
    if (!std::isfinite(row.excluded_volume)) continue;
    const bool has_x = along_x != kNoVariable;
    const std::string name = has_x ? name_of_curve(run, index, along_x, row) : "";
    const auto [place, is_new] = places.emplace(name, curves.size());
    if (is_new) curves.emplace_back(name, std::vector<ScanPoint>());
    const double x = has_x ? parse_number(row.values[along_x], "x") : static_cast<double>(index);
    curves[place->second].second.push_back({x, row.excluded_volume, row.std_error, row.reference});
  }
  return curves;
}

}  // namespace vex
