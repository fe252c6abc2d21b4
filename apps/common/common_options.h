// Options that every program has, and the head of its JSON document.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/option_parser.h"
#include "engine/numeric/transform.h"

namespace vex {

/// The words of the command line, as they stand.
struct CommonWords {
  std::string seed, threads, max_z, json;
  bool quiet = false;
};

/// --seed and --threads in the group of this name.
void declare_seed_and_threads(OptionParser& options, CommonWords& words, const std::string& group);

/// --json and --quiet; `quiet` is what the latter means.
void declare_json_and_quiet(OptionParser& options, CommonWords& words, const std::string& quiet);

/// The same and --max-z.
void declare_output(OptionParser& options, CommonWords& words);

/// What the words mean.
struct CommonOptions {
  std::uint64_t seed = 1;
  int n_threads = 1;
  double max_z = 6.0;
  std::string json;
  bool quiet = false;
};

/// Throws UsageError where a word means nothing.
CommonOptions interpret_common(const CommonWords& words);

/// version, stream_version, command, seed, threads, complete, seconds.
nlohmann::ordered_json document_head(const std::string& command, const CommonOptions& options, bool complete,
                                     double seconds);

/// As it is written: indented, a line of its own at the end, what is not UTF-8 replaced.
std::string document_text(const nlohmann::ordered_json& document);

/// A number, or null where there is none or it is not finite: JSON has no infinity.
nlohmann::ordered_json number_or_null(const std::optional<double>& value);

/// r11, r12, ... r33, tx, ty, tz.
std::vector<double> twelve_numbers(const Transformd& pose);

}  // namespace vex
