// A capped cylinder (spherocylinder) about the origin, axis z: all points within R of a needle of length L.
#pragma once

#include <numbers>

#include "shapes/needle.h"
#include "shapes/rounded.h"
#include "shapes/solid_moments.h"

namespace vex {

class Capsule : public Rounded<Needle> {
 public:
  /// `length`: of the straight part, without the caps.
  Capsule(double length, double radius) : Rounded<Needle>(Needle(length), Needle(length).measures(), radius) {}

  /// The cylinder's, and of two half balls, whose centres are half a length away from the origin.
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double l = 2.0 * body().support(Vec3d{0.0, 0.0, 1.0}).z, r = radius(), square = r * r;
    const double cylinder = pi * square * l, ball = 4.0 / 3.0 * pi * square * r;
    const double across = cylinder * (0.25 * square) + ball * (0.2 * square);
    return SolidMoments::diagonal(
        cylinder + ball, {},
        {across, across, cylinder * (l * l / 12.0) + ball * (0.25 * l * l + 0.375 * l * r + 0.2 * square)});
  }
};

}  // namespace vex
