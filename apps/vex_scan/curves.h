// The rows of a scan as curves, for its pictures.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "apps/vex_scan/scan_run.h"

namespace vex {

inline constexpr std::size_t kNoVariable = ~std::size_t{0};

struct ScanPoint {
  double x = 0.0, y = 0.0, std_error = 0.0, reference = 0.0;
};

/// What differs between bodies, and between the values of all variables but the one that is drawn along x.
using Curves = std::vector<std::pair<std::string, std::vector<ScanPoint>>>;

/// The one of most values, of several the last: neighbours on its curve are neighbours in the table. kNoVariable where
/// none has more than one: then cases are drawn one beside the other.
std::size_t variable_along_x(const Scan& scan);

/// Of all cases that have a volume.
Curves curves_of(const ScanRun& run, std::size_t along_x);

}  // namespace vex
