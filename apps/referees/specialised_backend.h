// Tests made for one kind of pair, behind the engine's overlap interface: another way to the same answers.
#pragma once

#include "engine/query/overlap_backend.h"

namespace vex {

/// Box and box, ellipsoid and ellipsoid, capsule and capsule, and a sphere with each of sphere, box, ellipsoid and
/// capsule. Never wrong; undecided within rounding of contact.
BackendKind specialised_backend();

/// Boxes, by edges of one that meet the other (box_box.h).
BackendKind box_edges_backend();

}  // namespace vex
