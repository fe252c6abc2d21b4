// Legendre series of what a superellipsoid's surface or mean curvature faces.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/numeric/vec3.h"
#include "shapes/normal_measure.h"

namespace vex {

/// The integrals of P_l(n . unit_axis) over the part, by degree from 0 to `max_degree`, by the double exponential rule
/// (H. Takahasi and M. Mori, 1974) in both coordinates, refined until half of the nodes would do nearly as well: to
/// some 1e-11 of the mass. Nothing where that takes more than about half a second, as for bodies a hundred times as
/// wide as thick.
std::optional<std::vector<double>> superellipsoid_series(const SuperellipsoidNormals& part, std::size_t max_degree,
                                                         const Vec3d& unit_axis);

}  // namespace vex
