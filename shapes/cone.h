// A right circular cone, axis z: its base at z = -H/2, its apex at z = H/2.
#pragma once

#include "shapes/frustum.h"

namespace vex {

class Cone : public Frustum {
 public:
  Cone(double height, double radius) : Frustum(height, radius, 0.0) {}
};

}  // namespace vex
