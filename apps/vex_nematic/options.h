// The command line of vex_nematic.
#pragma once

#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"
#include "shapes/nematic/coexistence.h"

namespace vex {

/// The words of the command line, as they stand.
struct NematicCommandLine : CommonWords, BodyWords {
  std::string body, other, composition, theory, trial_function, plot;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, NematicCommandLine& words);

/// What the words mean.
struct NematicOptions : CommonOptions {
  std::string body, other, plot;          // `other` empty: one kind of bodies
  std::vector<std::string> compositions;  // of a mixture: shares of the other body in the isotropic fluid, decimals
  BodyOptions body_options;
  NematicTheory theory = NematicTheory::onsager;
  bool trial_function = false;
  bool dump_vertices = false;
};

/// Throws UsageError where a word means nothing.
NematicOptions interpret(const NematicCommandLine& words);

/// As --theory names it.
std::string name_of(NematicTheory theory);

}  // namespace vex
