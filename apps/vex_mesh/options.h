// The command line of vex_mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"
#include "apps/common/estimators.h"
#include "engine/sampling/monte_carlo.h"

namespace vex {

/// The words of the command line, as they stand.
struct CommandLine : CommonWords, BodyWords {
  std::string a, b;
  std::string trials, relative_error, seconds, max_trials;
  std::string estimator, sequence, domain, backend, orientations, isa;
  std::vector<std::string> control_variate;
  std::string checkpoint, resume;
  bool no_quick_verdicts = false, cross_check = false;
  bool verify = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, CommandLine& words);

/// What the words mean.
struct Options : CommonOptions {
  std::string a, b;
  StopRule stop;                             // empty where none was given: usual_relative_error
  std::optional<Estimator> estimator;        // none: chosen by a pilot
  std::optional<Sequence> sequence;          // none: usual_sequence
  std::optional<Domain::Kind> domain;        // the best of ball and box where none was asked for
  std::vector<std::string> control_variate;  // none, one body for both, or one for each
  OrientationLaw law;
  BackendKind backend;
  bool is_cross_check = false;
  std::vector<BackendKind> cross_check;  // the backends beside `backend`
  bool quick_verdicts = true;
  InstructionSet instruction_set = best_instruction_set();
  bool verify = false;
  BodyOptions bodies;
  bool dump_vertices = false;
};

/// Throws UsageError where a word means nothing, or something that is not built yet.
Options interpret(const CommandLine& words);

}  // namespace vex
