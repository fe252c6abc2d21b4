// A body that two powers tell.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

/// (|x/a|^p + |y/b|^p)^(q/p) + |z/c|^q <= 1 about the origin: a superellipsoid (A. H. Barr, 1981). It has no exact
/// form: powers are what double precision makes of them.
struct PowerForm {
  Vec3d semi_axes;
  double across, along;  // p and q, 1 or more
};

}  // namespace vex
