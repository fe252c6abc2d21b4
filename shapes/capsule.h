// A capped cylinder (spherocylinder) about the origin, axis z: all points within R of a needle of length L.
#pragma once

#include "shapes/needle.h"
#include "shapes/rounded.h"

namespace vex {

class Capsule : public Rounded<Needle> {
 public:
  /// `length`: of the straight part, without the caps.
  Capsule(double length, double radius) : Rounded<Needle>(Needle(length), Needle(length).measures(), radius) {}
};

}  // namespace vex
