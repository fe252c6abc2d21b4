// The mean excluded volume over laws that spin each body about an axis, as a series of Legendre polynomials.
//
// Over independent directions of the two axes, each alike about a common axis, and uniform angles about the bodies'
// own, only the parts of the measures on normals that are alike about it count, and the polynomial of degree l comes
// through as <P_l(cos theta)> of each axis. With S_l = integral of P_l(n . axis) over S_K, H_l over H_K, and h_K's own
// coefficient from H_K = (Laplacian + 2) h_K / 2, that is h_l = (2 l + 1) H_l / (2 pi (2 - l (l + 1))):
//   <V_ex> = V_A + V_B + sum over l of (-1)^l <P_l>_A <P_l>_B (S_l^A h_l^B + S_l^B h_l^A),
// odd l only where a law tells up from down. Its first term is the formula for uniform rotations. No support mapping,
// no rotation and no random number is involved.
#pragma once

#include <optional>

#include "engine/sampling/poses/orientation_law.h"
#include "shapes/any_shape.h"

namespace vex {

struct SeriesAverage {
  double excluded_volume = 0.0;
  double error = 0.0;  // a bound: on the terms left out, and 1e-11 relative, for rounding and quadrature
};

/// Of laws that are about two axes: cone, onsager, maier_saupe, table and each. Nothing where an axis is askew in an
/// ellipsoid of three different semi-axes, where axis_moments has none (narrow laws among them); where the error would
/// be above some 10^-6, as for narrow cones; or where it would take more than some tenths of a second, as for meshes of
/// many edges and for ellipsoids more than a hundred times as long as thin. UsageError where a body has no measures on
/// normals. Takes milliseconds for smooth laws.
std::optional<SeriesAverage> legendre_average(const Body& a, const Body& b, const OrientationLaw& law);

}  // namespace vex
