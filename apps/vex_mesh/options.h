// The command line of vex_mesh.
#pragma once

#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/checkpoint.h"
#include "apps/common/common_options.h"
#include "apps/common/orientation_options.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {

/// The words of the command line, as they stand.
struct CommandLine : CommonWords, BodyWords, CheckpointWords, OrientationWords {
  std::string a, b;
  std::string trials, first_trial, relative_error, seconds, max_trials;
  std::string estimator, sequence, domain, backend, isa;
  std::vector<std::string> control_variate;
  std::string report;
  bool no_quick_verdicts = false, cross_check = false;
  bool verify = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, CommandLine& words);

/// Of these all that say how a pair is run and what comes out, without A and B: for a program that runs many.
void declare_run_options(OptionParser& options, CommandLine& words);
/// Their words, all but those of flags, --seed, --threads and --json.
std::vector<std::string*> words_of_run(CommandLine& words);
/// Of these the words of a law that is not one of both bodies' z axes.
std::vector<std::string*> words_of_bodies_laws(CommandLine& words);

/// What the words mean.
struct Options : CommonOptions {
  std::string a, b;
  ExcludedVolumeSettings settings;           // without the bodies of a control variate, which are
  std::vector<std::string> control_variate;  // none, one for both, or one for each
  bool is_cross_check = false;
  BodyOptions bodies;
  bool dump_vertices = false;
  std::string report;
  CheckpointOptions checkpoint;
};

/// Throws UsageError where a word means nothing.
Options interpret(const CommandLine& words);

}  // namespace vex
