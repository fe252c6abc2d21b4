// Distances for who has a guess where the nearest points are, and what queries of many poses check before they ask.
#pragma once

#include <array>
#include <cstddef>

#include "engine/query/separation.h"

namespace vex {

/// Throws UsageError of settings that no query takes.
[[noreturn]] void refuse(const SeparationSettings& settings);
inline void require_usable(const SeparationSettings& settings) {
  if (settings.relative_gap >= 0.0 && settings.max_distance >= 0.0 && settings.max_support_calls >= 1) return;
  refuse(settings);
}

/// The corners, three at most, of the simplex of A - B that may be nearest to the origin. Of cores, without balls.
struct NearestGuess {
  struct Corner {
    Vec3d of_a;  // or the unit vector along which A - B has it
    Vec3d of_b;  // in B's frame
  };
  static constexpr std::size_t kMost = 3;

  std::array<Corner, kMost> corners;
  std::size_t n = 0;
  bool are_points = false;  // they are the bodies' own points then, exactly, and these have no rolling balls
};

/// As the functions without `guess`, but that the search of bodies that are apart begins there. A wrong direction costs
/// time and changes the last digits, and never what is proven; points are believed.
Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings, const NearestGuess& guess);
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    const NearestGuess& guess);

}  // namespace vex
