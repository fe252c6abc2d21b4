// The command line of vex_merge.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/common_options.h"

namespace vex {

/// The words of the command line, as they stand.
struct MergeCommandLine : CommonWords {
  std::vector<std::string> files;
  std::string trials;
  bool part = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, MergeCommandLine& words);

/// What the words mean.
struct MergeOptions {
  std::vector<std::string> files;
  std::optional<std::uint64_t> trials;  // that there must be in all
  bool is_part = false;                 // whether they may begin behind trial 0
  double max_z = 6.0;
  std::string json;
  bool quiet = false;
};

/// Throws UsageError where a word means nothing.
MergeOptions interpret(const MergeCommandLine& words);

}  // namespace vex
