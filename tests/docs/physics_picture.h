// README's picture: two bodies with the surface that B's centre may not enter, and V_ex of two rods against the angle
// between them.
#pragma once

#include <string>
#include <vector>

namespace vex {

/// A rod beside a copy of itself, each spun about its own axis, at one angle: V_ex over the rod's volume.
struct RodValue {
  double degrees, value;
  double std_error = 0.0;
};

struct Rod {
  std::string text, label, colour;
  std::vector<RodValue> exact;        // mixed volumes, to about 1e-5 (shapes/estimators/exact_average.h)
  std::vector<RodValue> monte_carlo;  // ray casts
};

/// The three of the picture, 5 long and 1 thick.
std::vector<Rod> rods();

/// The text of an SVG file.
std::string physics_picture();

}  // namespace vex
