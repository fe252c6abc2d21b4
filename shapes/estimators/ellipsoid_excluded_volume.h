// The excluded volume of two ellipsoids at a fixed orientation, in closed form.
#pragma once

#include "engine/numeric/transform.h"

namespace vex {

/// |A + (-R B)| for A = D_A(unit ball), B = D_B(unit ball), D = diag(semi-axes), in length^3.
///
/// 3 V(A, A, RB) is det D_A times 3 V(ball, ball, D_A^-1 R D_B(ball)), which is the M of an ellipsoid whose semi-axes
/// are the singular values of D_A^-1 R D_B: 4 pi R_G of their squares, Carlson's symmetric integral (DLMF 19.33); and
/// the same with A and B exchanged. Within a few hundred roundings, relative: R_G hangs on the largest of its
/// arguments, an eigenvalue that is found to rounding. Throws InputError where an axis is no size, or the volume no
/// double.
double ellipsoid_excluded_volume(const Vec3d& semi_axes_a, const Vec3d& semi_axes_b, const Transformd& rotation);

}  // namespace vex
