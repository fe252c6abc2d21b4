// libccd behind the engine's overlap interface, driven through the very same support mappings.
#pragma once

#include "engine/query/overlap_backend.h"

namespace vex {

/// libccd's GJK (ccdGJKIntersect), which decides by its own fixed tolerance.
BackendKind ccd_gjk_backend();

/// libccd's portal refinement (ccdMPRIntersect) at a boundary tolerance of 1e-12; its default of 1e-4 misses overlaps.
BackendKind ccd_mpr_backend();

}  // namespace vex
