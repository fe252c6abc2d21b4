// Legendre series of bodies about their z axes: of their measures on normals, and of the excluded volume as a function
// of the angle between two axes.
//
// S_l = integral of P_l(n_z) over S_K, H_l over H_K (shapes/normal_measure.h), and h_K's own coefficient follows from
// H_K = (Laplacian + 2) h_K / 2: h_l = (2 l + 1) H_l / (2 pi (2 - l (l + 1))).
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

#include "shapes/any_shape.h"

namespace vex {

using LegendreSeries = std::vector<double>;  // by degree, from 0 up

/// sum[l] += weight P_l(x), by the three-term recursion, which is stable for |x| <= 1.
void add_polynomials(double weight, double x, LegendreSeries* sum);

/// The integrals of P_l(n . unit_axis) over the measure, to some 1e-11 of its mass. The axis is z, or one that
/// `have_series_about` has nothing against. Nothing where a superellipsoid's would take too long.
std::optional<LegendreSeries> legendre_series(const NormalMeasure& measure, std::size_t max_degree,
                                              const Vec3d& unit_axis = {0.0, 0.0, 1.0});

struct AxialMeasures {
  NormalMeasure area, mean_curvature;
};

/// Nothing where their series would take more than some tenths of a second, as for meshes of more than 20 000 vertices
/// and for ellipsoids more than a hundred times as long as thin (of superellipsoids it shows in the series). UsageError
/// where a body has no measures on normals.
std::optional<AxialMeasures> axial_measures(const Body& body);
/// All axes will do but those askew in a body that has a part of an ellipsoid of three different semi-axes.
bool have_series_about(const AxialMeasures& body, const Vec3d& unit_axis);
/// Whether the series of all of them up to this degree take less than that.
bool are_affordable(std::initializer_list<const AxialMeasures*> bodies, std::size_t max_degree);

/// S_l and H_l of two bodies, each about an axis of its own.
struct PairSeries {
  LegendreSeries area_a, area_b, curvature_a, curvature_b;

  double of_degree(std::size_t l) const { return area_a[l] * curvature_b[l] + area_b[l] * curvature_a[l]; }
};
std::optional<PairSeries> series_of_pair(const AxialMeasures& a, const AxialMeasures& b, std::size_t max_degree,
                                         const Vec3d& unit_axis_a, const Vec3d& unit_axis_b);

/// h_l / H_l.
double coefficient_of_degree(std::size_t degree);

/// V_ex(gamma) = sum of c_l P_l(cos gamma), gamma the angle between the two z axes, averaged over the spin of each body
/// about its own: c_l = (-1)^l (S_l^A h_l^B + S_l^B h_l^A), to which l = 0 adds V_A + V_B; c_0 is the average over
/// random orientations. In length^3, each to some 1e-11 of c_0. Nothing where it would take too long. The series
/// converges as 1 / l where bodies have edges, because V_ex then grows like |sin gamma|; means over smooth densities
/// need few terms.
std::optional<LegendreSeries> excluded_volume_series(const Body& a, const Body& b, std::size_t max_degree);

}  // namespace vex
