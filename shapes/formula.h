// The average excluded volume of two convex bodies in random relative orientation, from their measures.
#pragma once

#include <cmath>
#include <numbers>

#include "shapes/measures.h"

namespace vex {

/// <V_ex> = V_A + V_B + (M_A S_B + M_B S_A) / 4 pi, in length^3: the isotropic average of the volume that A forbids to
/// B's centre. Isihara (J. Chem. Phys. 18, 1446, 1950), Hadwiger (1951), Kihara (1953). Eight volumes for two equal
/// spheres.
inline double average_excluded_volume(const Measures& a, const Measures& b) {
  return a.volume + b.volume + a.mean_radius() * b.surface_area + b.mean_radius() * a.surface_area;
}

/// B_2 = <V_ex> / 2, the second virial coefficient of hard bodies.
inline double second_virial_coefficient(double excluded_volume) { return 0.5 * excluded_volume; }

/// <V_ex> / sqrt(V_A V_B), or a NaN where a body is flat.
inline double reduced_excluded_volume(double excluded_volume, const Measures& a, const Measures& b) {
  // Root by root: the product of two volumes may overflow where neither they nor the result do.
  const double mean_volume = std::sqrt(a.volume) * std::sqrt(b.volume);
  return mean_volume > 0.0 ? excluded_volume / mean_volume : std::nan("");
}

}  // namespace vex
