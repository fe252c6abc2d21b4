// What vex_bench says: a table on the screen, JSON, CSV, and a picture.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_bench/bench.h"
#include "apps/vex_bench/options.h"

namespace vex {

/// All that is reported.
struct BenchRun {
  std::string command;
  BenchOptions options;
  std::vector<BodyCurves> bodies{};
  bool complete = true;
  double seconds = 0.0;
};

/// The relative errors to which the times are told.
inline constexpr double kErrorsAskedFor[] = {1e-3, 1e-4, 1e-5};

std::string report_text(const BenchRun& run);
/// The document of --json.
std::string report_json(const BenchRun& run);
/// A row for every point of every curve.
std::string report_csv(const BenchRun& run);
enum class Curves { main, others };  // five at most; and all the rest
/// The text of an SVG file: error over run time, a panel for each body.
std::string picture_of(const BenchRun& run, Curves which);

}  // namespace vex
