// FCL behind the engine's overlap interface, with FCL's own shapes rather than the engine's support mappings.
#pragma once

#include "engine/query/overlap_backend.h"

namespace vex {

/// FCL's `collide` with its default solver (libccd's GJK; a separating-axis test for two boxes). It takes spheres,
/// boxes, ellipsoids, capsules, cylinders, cones, and polytopes as its `Convex`; a plate is a box without thickness to
/// it.
BackendKind fcl_backend();

}  // namespace vex
