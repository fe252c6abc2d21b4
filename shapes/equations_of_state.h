// Equations of state of hard convex bodies in random orientation, beside which a virial series is shown: the
// compressibility factor Z = p / (n k T) by the volume fraction phi = n V.
//
// All of them are N. F. Carnahan and K. E. Starling's (J. Chem. Phys. 51, 635, 1969) for spheres. They are
// approximations, each exact to B2 alone.
#pragma once

#include "shapes/measures.h"

namespace vex {

/// alpha = R S / 3 V, R = M / 4 pi: 1 for spheres, more for all others, not a number or infinite for flat bodies. B2 /
/// V is 1 + 3 alpha.
inline double non_sphericity(const Measures& body) {
  return body.mean_radius() * body.surface_area / (3.0 * body.volume);
}

/// The spheres' equation with its part beyond an ideal gas times B2 / 4 V (J. D. Parsons, Phys. Rev. A 19, 1225, 1979;
/// S.-D. Lee, J. Chem. Phys. 87, 4972, 1987).
inline double parsons_lee(double b2_by_volume, double phi) {
  const double empty = 1.0 - phi;
  return 1.0 + b2_by_volume * phi * (1.0 - 0.5 * phi) / (empty * empty * empty);
}

/// I. Nezbeda (Chem. Phys. Lett. 41, 55, 1976).
inline double nezbeda(double alpha, double phi) {
  const double empty = 1.0 - phi;
  const double top =
      1.0 + phi * ((3.0 * alpha - 2.0) + phi * ((alpha * alpha + alpha - 1.0) - phi * alpha * (5.0 * alpha - 4.0)));
  return top / (empty * empty * empty);
}

/// T. Boublik (J. Chem. Phys. 63, 4084, 1975).
inline double boublik(double alpha, double phi) {
  const double empty = 1.0 - phi;
  const double top =
      1.0 + phi * ((3.0 * alpha - 2.0) + phi * ((3.0 * alpha * alpha - 3.0 * alpha + 1.0) - phi * alpha * alpha));
  return top / (empty * empty * empty);
}

}  // namespace vex
