// Whether a system of placed bodies is the same along x, y and z and between them: then R of a large cube has universal
// values at the threshold (threshold.h), else it has not (crossing.h).
#pragma once

#include "engine/sampling/percolation/placements.h"

namespace vex {

/// Isotropic laws, also as `cone:90` and `onsager:0`; balls alone, whatever the law; and aligned bodies any two of
/// which meet alike where the axes are exchanged in turn or two of them reversed, as cubes, octahedra and tetrahedra in
/// their usual places do: second moments are then those of isotropic systems. Bodies are compared by their support
/// functions, along several hundred directions, to within 1e-9 of their size.
bool is_isotropic(const Placements& placements);

}  // namespace vex
