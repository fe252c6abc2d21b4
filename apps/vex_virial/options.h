// The command line of vex_virial.
#pragma once

#include <string>

#include "apps/common/body_options.h"
#include "apps/common/checkpoint.h"
#include "apps/common/common_options.h"
#include "shapes/estimators/virial_coefficients.h"

namespace vex {

/// The words of the command line, as they stand.
struct VirialCommandLine : CommonWords, BodyWords, CheckpointWords {
  std::string a, b;
  std::string order, only, rel_error, seconds, samples, trials, first_trial, orientations, axis, isa, plot, report;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, VirialCommandLine& words);

/// What the words mean.
struct VirialOptions : CommonOptions {
  std::string a, b;  // b is empty where there is one body
  BodyOptions body_options;
  VirialSettings settings;
  std::string law_file;  // that the law is a table of, or empty
  bool dump_vertices = false;
  std::string plot, report;
  CheckpointOptions checkpoint;

  bool is_mixture() const { return !b.empty(); }
};

/// Throws UsageError where a word means nothing.
VirialOptions interpret(const VirialCommandLine& words);

}  // namespace vex
