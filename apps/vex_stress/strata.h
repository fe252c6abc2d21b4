// The strata of vex_stress: kinds of placement on which overlap tests fail.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/vex_stress/placement.h"

namespace vex {

struct Stratum {
  std::string name;    // "contact/curved/d=1e-6"
  std::string bodies;  // in words
  std::function<std::vector<StressPair>()> make_pairs;
  std::function<StressPose(const StressPair&, Draw&)> place;
  std::optional<double> distance = {};  // relative to the pair's size, where all poses have the same
  /// Aspect ratios up to 1e6: there undecided verdicts of curved bodies have a band to stay in.
  bool has_band = true;
  std::size_t most_poses = SIZE_MAX;  // where bodies are so large that a pose takes long
};

/// All of them, in the order of the report.
std::vector<Stratum> all_strata();

std::vector<Stratum> contact_strata();     // contact_strata.cpp: random poses, contact +- d, features, parallel faces
std::vector<Stratum> symmetric_strata();   // symmetric_strata.cpp: exact touch, common axes and planes of symmetry
std::vector<Stratum> extreme_strata();     // extreme_strata.cpp: aspect and size ratios, far coordinates
std::vector<Stratum> degenerate_strata();  // degenerate_strata.cpp: flat and coplanar bodies, large hulls, known cases

}  // namespace vex
