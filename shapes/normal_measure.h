// Measures on the unit normals of a convex body: where its surface, and where its mean curvature, faces.
//
// S_K, the surface area measure: S_K(w) is the area of the part of K's surface whose outward normals lie in w. H_K, the
// mean-curvature measure: the same with the area weighted by the mean curvature, which for edges, rims and flat bodies
// is the limit of K's parallel bodies: S_(K + rB) = S_K + 2 r H_K + r^2 S_B (Steiner's formula, normal by normal). With
// H. Minkowski (Math. Ann. 57, 447, 1903) they give mixed volumes: 3 V(K, K, L) is the integral of h_L over S_K, and
// 3 V(K, B, L) that of h_L over H_K. R. Schneider, Convex Bodies: The Brunn-Minkowski Theory, 2nd ed.,
// sections 4.2, 5.1.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "engine/numeric/vec3.h"
#include "shapes/measures.h"

namespace vex {

/// A flat face: all of the mass at one normal.
struct NormalAtom {
  Vec3d unit_normal;
  double mass = 0.0;
};

/// A straight edge: normals from `unit_from` by `angle_rad`, at most pi, towards `unit_across`, which is at a right
/// angle to it. Uniform in the angle.
struct NormalArc {
  Vec3d unit_from, unit_across;
  double angle_rad = 0.0;
  double mass = 0.0;
};

/// A mantle about the z axis: normals at one polar angle, uniform about the axis.
struct NormalRing {
  double cos_polar = 0.0, sin_polar = 1.0;
  double mass = 0.0;
};

/// A part of a sphere: normals between two cosines of the polar angle, uniform in solid angle. A whole sphere unless
/// told.
struct NormalZone {
  double cos_from = -1.0, cos_to = 1.0;
  double mass = 0.0;
};

/// A circular edge about the z axis: normals between two polar angles, uniform in the angle and about the axis.
struct NormalRim {
  double polar_from_rad = 0.0, polar_to_rad = 0.0;
  double mass = 0.0;
};

/// An ellipsoid's surface, u on the unit sphere being the point D u of it, D = diag(semi_axes): the normal is along
/// D^-1 u, and an area of the sphere counts det D |D^-1 u| times.
struct EllipsoidNormals {
  Vec3d semi_axes;
  double mass = 0.0;    // factor times S
  double factor = 1.0;  // how often it counts: not 1 in a sum of measures
};

/// The sum of an ellipsoid's two radii of curvature where its normal is n, the Laplacian of h(n) = |D n|:
/// (a^2 b^2 (n_x^2 + n_y^2) + a^2 c^2 (n_x^2 + n_z^2) + b^2 c^2 (n_y^2 + n_z^2)) / h^3. No term cancels another.
double sum_of_radii_of_curvature(const Vec3d& semi_axes, const Vec3d& unit_normal);

/// An ellipsoid's mean curvature, whose density over uniform normals is half the sum of the radii of curvature. That of
/// a long ellipsoid faces almost nowhere but across it: the normal is taken along P u, P
/// shrinking the direction of the longest axis by the ratio of the middle one to it. That of a flat one has a peak
/// along the shortest axis, with one over the angle: about that axis the polar angle of u is uniform, and its azimuth.
/// The weights are then bounded by some multiples of M for rods, strips and plates.
struct EllipsoidCurvature {
  Vec3d semi_axes;
  double mass = 0.0;  // factor times M
  double factor = 1.0;
};

/// A spindle's belt about the z axis: normals at polar angles pi/2 + t, |t| <= `half_angle_rad`, at most pi/2, with the
/// density `over_chord` (cos t - cos half_angle) + `straight` cos t in t, uniform about the axis.
struct NormalBelt {
  double half_angle_rad = 0.0;
  double over_chord = 0.0, straight = 0.0;
  double mass = 0.0;
};

/// The upper or the lower half of a spheroid about the z axis: its surface, or its mean curvature. With the points at
/// (a sin t, c cos t), normals along (c sin t, a cos t), g the length of that, they count 2 pi a g sin t and
/// pi (c + a^2 c / g^2) sin t in t. Of a flat one the latter has a peak at the equator, and the normal's polar angle p
/// is uniform instead: pi (a^2 / h + a^2 c^2 / h^3) sin p, h = |(a sin p, c cos p)|.
struct HalfSpheroidNormals {
  double across = 0.0, along = 0.0;  // a, c
  bool is_upper = true;
  bool is_curvature = false;
  double mass = 0.0;  // factor times S/2 or M/2 of the whole spheroid
  double factor = 1.0;
};

/// A superellipsoid's surface, or one of the two terms of its mean curvature, of which `curvature_across` is all that a
/// cylinder with this cross-section would have (shapes/superellipsoid_normals.h).
struct SuperellipsoidNormals {
  enum class Part { area, curvature_across, curvature_along };

  Vec3d semi_axes;
  double across = 2.0, along = 2.0;  // 2P and 2Q
  Part part = Part::area;
  double mass = 0.0;  // factor times the term
  double factor = 1.0;
};

/// The image of a point of the unit square: a unit normal (to a few roundings), and what it counts for.
struct WeightedNormal {
  Vec3d unit_normal;
  double weight = 0.0;
};

/// A measure on unit normals, in a body's own frame: the sum of its components. Masses are in the units of S (length^2)
/// or of M (length).
class NormalMeasure {
 public:
  using Component = std::variant<NormalAtom, NormalArc, NormalRing, NormalZone, NormalRim, NormalBelt, EllipsoidNormals,
                                 EllipsoidCurvature, HalfSpheroidNormals, SuperellipsoidNormals>;

  void add(const Component& component) { components_.push_back(component); }
  /// Every component of `other`, `factor` times.
  void add(const NormalMeasure& other, double factor);
  void reserve(std::size_t n) { components_.reserve(n); }

  std::span<const Component> components() const { return components_; }
  /// The sum of the masses: S or M of the body.
  double total_mass() const;

 private:
  std::vector<Component> components_;
};

/// Whether it is a part of a surface of revolution about z whose normals go around z with w: a ring, a zone, a rim, a
/// belt, a half spheroid, a superellipsoid that is round across z.
bool is_alike_about_z(const NormalMeasure::Component& component);

/// The part of a measure that is the component's own.
double mass_of(const NormalMeasure::Component& component);

/// For (v, w) uniform in the open unit square, the mean of weight * f(unit_normal) is the integral of f over the
/// component. v goes along an arc or from pole to pole, w around the z axis.
WeightedNormal normal_at(const NormalMeasure::Component& component, double v, double w);

/// Which of the two `normal_at` looks at: an atom at none, a ring at w alone, an arc at v alone.
struct CoordinatesUsed {
  bool v = false, w = false;
};
CoordinatesUsed coordinates_used(const NormalMeasure::Component& component);

/// The uniform measure on the sphere: r^2 times it is S, r times it H, of a ball of radius r, for mass 4 pi.
NormalMeasure uniform_normals(double mass);

/// S and H of a regular polyhedron whose faces look along these directions of equal length: faces share an edge where
/// no other pair is closer together.
NormalMeasure regular_polyhedron_area(std::span<const Vec3d> dir_normals, const Measures& measures);
NormalMeasure regular_polyhedron_mean_curvature(std::span<const Vec3d> dir_normals, const Measures& measures);

/// S and H of a body, made when they are asked for: those of a large mesh are larger than the mesh.
struct NormalMeasures {
  std::function<NormalMeasure()> area;            // S_K
  std::function<NormalMeasure()> mean_curvature;  // H_K
};

/// A body that knows both.
template <class Shape>
concept HasNormalMeasures = requires(const Shape& shape) {
  { shape.area_measure() } -> std::same_as<NormalMeasure>;
  { shape.mean_curvature_measure() } -> std::same_as<NormalMeasure>;
};

/// Keeps a copy of the shape.
template <HasNormalMeasures Shape>
NormalMeasures normal_measures_of(const Shape& shape) {
  return {[shape] { return shape.area_measure(); }, [shape] { return shape.mean_curvature_measure(); }};
}

}  // namespace vex
