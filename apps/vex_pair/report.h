// What vex_pair says of one pose, and of all of them together.
#pragma once

#include <optional>
#include <string>

#include "apps/common/bodies.h"
#include "apps/vex_pair/answer_stream.h"
#include "apps/vex_pair/options.h"

namespace vex {

/// All that is reported.
struct PairRun {
  std::string command;
  PairOptions options;
  LoadedBody a, b;
  std::optional<Answer> one{};  // the answer to the one pose
  StreamResult found{};         // where there is a file of poses; of one pose, its counts and its row
  double seconds = 0.0;
};

/// One pose's answer in words.
std::string report_text(const PairRun& run);

/// The line that ends a stream of answers.
std::string summary_text(const PairRun& run);

/// The document of --json.
std::string report_json(const PairRun& run);

}  // namespace vex
