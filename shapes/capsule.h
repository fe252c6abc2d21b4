// A capped cylinder (spherocylinder) about the origin, axis z: all points within R of a segment of length L.
#pragma once

#include <numbers>

#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/segment.h"

namespace vex {

class Capsule : public Inflated<Segment> {
 public:
  /// `length`: of the straight part, without the caps.
  Capsule(double length, double radius) : Inflated<Segment>(Segment(length), radius) { VEX_EXPECT(radius > 0.0); }

  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double l = body().length(), r = radius();
    return {pi * r * r * (l + 4.0 / 3.0 * r), 2.0 * pi * r * (l + 2.0 * r), pi * (l + 4.0 * r)};
  }
};

}  // namespace vex
