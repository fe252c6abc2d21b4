// Bodies and poses as FCL has them.
#pragma once

#include <fcl/common/types.h>
#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

using FclGeometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// Whether FCL has a shape for the body: spheres, boxes, plates, ellipsoids, capsules, cylinders, cones, and polytopes
/// as its Convex.
bool fcl_takes(const ConvexBody& body);

/// Null where FCL has none. Throws InputError for a polytope without volume. `is_validated`: FCL checks a Convex, which
/// takes longer, and then climbs along its edges from 33 vertices on instead of scanning.
FclGeometry fcl_geometry(const ConvexBody& body, bool is_validated = false);

fcl::Transform3d fcl_pose(const Transformd& a_from_b);

}  // namespace vex
