// V, S and M of a closed triangulated surface, and where its middle is.
#pragma once

#include "engine/numeric/double_double.h"
#include "engine/numeric/vec3.h"
#include "meshes/determinant.h"
#include "meshes/triangles.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

/// A point near a surface, held as one of the surface's own vertices and a step from it: far from the origin a double
/// has too few digits left for a point inside a thin body, the step keeps all of them.
struct LocalPoint {
  Vec3d base;
  Vec3d step;

  Vec3d value() const { return base + step; }
  /// p - this, in double-double.
  DoubleDoubleVec3 to(const Vec3d& p) const {
    const DoubleDoubleVec3 d = exact_difference(p, base);
    return {d.x - step.x, d.y - step.y, d.z - step.z};
  }
};

/// Signed volume by the divergence theorem, and the centroid of the volume.
///
/// The cone point is a vertex of the surface: for a convex body no term is negative, so nothing cancels, wherever the
/// body lies. `volume_error` bounds the rounding of `volume`; where |volume| is not above it, there is no centroid.
struct VolumeAndCentroid {
  double volume = 0.0;
  double volume_error = 0.0;
  DoubleDouble six_volumes;  // 6 V, not yet rounded to double
  LocalPoint centroid;
};
VolumeAndCentroid volume_and_centroid(const Triangles& triangles);

/// Second moments about the centroid, tetrahedron by tetrahedron from there: of a convex surface nothing cancels.
SolidMoments solid_moments(const Triangles& triangles);

/// Sum of the triangles' areas.
double surface_area(const Triangles& triangles);

/// M = 1/2 sum over edges of length times exterior angle, the angle between the outward normals: 0 where two triangles
/// are coplanar, negative where an edge is reflex. No triangle may be without area.
double integrated_mean_curvature(const Triangles& triangles);

/// The surface area measure: an atom for each triangle that has an area, in the order of the triangles; those of one
/// plane stay apart. Its mass is `surface_area`.
NormalMeasure area_measure(const Triangles& triangles);

/// The mean-curvature measure: an arc for each edge whose exterior angle is positive. The surface must be convex, and
/// no triangle without area; then its mass is `integrated_mean_curvature`.
NormalMeasure mean_curvature_measure(const Triangles& triangles);

/// The diagonal of the bounding box: what tolerances are fractions of.
double bounding_diagonal(std::span<const Vec3d> vertices);

/// The radius of a ball about `centre` that surely lies inside the surface: a lower bound of the least distance to a
/// triangle's plane; 0 where some triangle does not see the centre from inside. A surface that is star-shaped about the
/// centre contains the ball, convex or not: no point of a triangle is nearer than its plane.
double inscribed_radius(const Triangles& triangles, const LocalPoint& centre);

/// A point near `centroid` that is the same bits however the faces are cut and ordered, which moves the centroid's own
/// last bits: its coordinates are multiples of a power of two, about a millionth of `inradius`, the distance from the
/// centroid to the nearest plane (where that is 0, of a fraction of `size`).
Vec3d rounded_centre(const LocalPoint& centroid, double inradius, double size);

}  // namespace vex
