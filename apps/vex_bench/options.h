// The command line of vex_bench.
#pragma once

#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"

namespace vex {

/// The words of the command line, as they stand.
struct BenchCommandLine : CommonWords, BodyWords {
  std::vector<std::string> bodies;
  std::string seconds, csv, plot, plot_others;
  bool standard = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, BenchCommandLine& words);

/// What the words mean.
struct BenchOptions : CommonOptions {
  std::vector<std::string> bodies;
  bool standard = false;  // the standard bodies, before those that are named
  double seconds = 1.0;   // for each curve
  std::string csv, plot, plot_others;
  BodyOptions body_options;
};

/// Throws UsageError where a word means nothing.
BenchOptions interpret(const BenchCommandLine& words);

}  // namespace vex
