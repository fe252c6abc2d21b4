// The bodies of the tests of equal hits: from headers alone, so that each way of compiling has its own.
#pragma once

#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/plate.h"
#include "tests/regression/fused_filter.h"

namespace vex {

inline ConvexBody same_hits_body(SameHitsBody which) {
  switch (which) {
    case SameHitsBody::cube: return Box(1.0, 1.0, 1.0);
    case SameHitsBody::slab: return Box(0.1, 0.7, 1.9);
    case SameHitsBody::ellipsoid: return Ellipsoid(1.0, 0.4, 0.7);
    case SameHitsBody::cylinder: return Cylinder(1.3, 0.45);
    case SameHitsBody::capsule: return Capsule(1.1, 0.3);
    case SameHitsBody::plate: break;
  }
  return Plate(1.0, 1.3);
}

}  // namespace vex
