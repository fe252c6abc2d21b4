// How two bodies are turned, on a command line: a law of orientations of both, or of each, and the bodies' own axes.
#pragma once

#include <string>
#include <vector>

#include "apps/common/option_parser.h"
#include "engine/sampling/poses/orientation_law.h"

namespace vex {

/// The words of the command line, as they stand.
struct OrientationWords {
  std::string orientations, orientations_a, orientations_b, axis, axis_a, axis_b;
};

/// --orientations, --orientations-a, --orientations-b, --axis, --axis-a, --axis-b.
void declare_orientations(OptionParser& options, OrientationWords& words, const std::string& group);

/// Isotropic where nothing is said. Throws UsageError, and InputError for a table that is none.
OrientationLaw interpret_orientations(const OrientationWords& words);

/// The files that the laws are read from.
std::vector<std::string> files_of_laws(const OrientationWords& words);

/// --axis.
void declare_axis(OptionParser& options, std::string& word, const std::string& group);

/// The law of each of many bodies, as --orientations and --axis say it; isotropic where nothing is said. `also` is
/// named as a choice where it is none: what the program takes itself. Throws UsageError, and InputError.
OrientationLaw law_of_bodies(const std::string& word, const std::string& axis, const std::string& also = "");

/// What --help says of the laws of one axis.
inline constexpr const char* kAxisLawsHelp =
    "cone:DEG, within this angle of +-z; onsager:ALPHA, by the density cosh(ALPHA cos theta); maier-saupe:A, by "
    "exp(A P2(cos theta)); table:FILE, by the density over cos theta whose points are the file's lines, linear between "
    "them";

}  // namespace vex
