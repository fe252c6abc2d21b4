// The command line of vex_stress.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/common/common_options.h"
#include "apps/vex_stress/strata.h"
#include "engine/query/overlap_backend.h"

namespace vex {

/// The words of the command line, as they stand.
struct StressCommandLine : CommonWords {
  std::string pairs, plot;
  std::vector<std::string> strata, backends;
  bool list = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, StressCommandLine& words);

/// What the words mean.
struct StressOptions : CommonOptions {
  std::uint64_t pairs = 0;  // a stratum
  std::string plot;
  std::vector<Stratum> strata;
  std::vector<BackendKind> backends;  // the engine's own first
  bool list = false;
};

/// Throws UsageError where a word means nothing. Without a stratum or a backend named: all of them.
StressOptions interpret(const StressCommandLine& words);

}  // namespace vex
