// Casts for who has a guess where a motion first meets a body.
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/pose.h"
#include "engine/query/first_contact.h"

namespace vex {

/// Unit vectors, along which A - B has the three points that the ray passes between; or the one along which it passes
/// A - B by; or none.
struct CastGuess {
  static constexpr std::size_t kMost = 3;

  std::array<Vec3d, kMost> dirs;
  std::size_t n = 0;
};

/// As `linear_cast` without a guess, of bodies that are proven to be apart at the start. A wrong direction costs time
/// and changes the last digits, and never what is proven.
FirstContact linear_cast(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion, double until,
                         const CastGuess& guess);

}  // namespace vex
