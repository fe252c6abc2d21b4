#include "meshes/convexity.h"

#include <cmath>
#include <optional>

#include "engine/numeric/rounding.h"
#include "meshes/determinant.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

/// How deep a reflex edge a b between the triangles a b c and b a d lies below the hull of the four points, at its
/// deepest point. Along the edge the distance from the face a c d grows from 0 at a to h_b = det / |ac x ad| at b, that
/// from b c d falls from h_a = det / |bc x bd| at a to 0 at b; they are equal where both are h_a h_b / (h_a + h_b). The
/// whole hull contains the four points', so this never exaggerates.
double depth_at(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, double det) {
  const double area_at_a = norm(cross(exact_difference(c, a), exact_difference(d, a)));
  const double area_at_b = norm(cross(exact_difference(c, b), exact_difference(d, b)));
  return det / (area_at_a + area_at_b);  // det > 0: the four points are not coplanar
}

/// -1, 0 or 1: the sign of det(a, b, c) beyond rounding; 0 where it is not sure. Most are sure in double: its error is
/// at most gamma(8) times the product of the lengths.
int sure_sign(const DoubleDoubleVec3& a, const DoubleDoubleVec3& b, const DoubleDoubleVec3& c) {
  const Vec3d a_double = a.value(), b_double = b.value(), c_double = c.value();
  const double rough = dot(a_double, cross(b_double, c_double));
  if (std::fabs(rough) > gamma(16) * (norm_1(a_double) * norm_1(b_double) * norm_1(c_double))) {
    return rough > 0.0 ? 1 : -1;
  }
  const BoundedDeterminant det = determinant(a, b, c);
  return det.surely_positive() ? 1 : (det.surely_negative() ? -1 : 0);
}

/// The triangles that the ray from the centroid along `ray` meets, those seen from outside counted negative; nothing
/// where it may pass through an edge, a vertex or a triangle seen edge-on. (Solid angles would do without a ray, but of
/// a thin body nearly all are seen at a grazing angle, and their sum loses everything: a needle of 10^10 to 1 wound
/// twice.)
std::optional<long> windings_along(const Triangles& triangles, const LocalPoint& centroid,
                                   const DoubleDoubleVec3& ray) {
  long n = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const DoubleDoubleVec3 a = centroid.to(triangles.corner(t, 0));
    const DoubleDoubleVec3 b = centroid.to(triangles.corner(t, 1));
    const int side_ab = sure_sign(a, b, ray);
    const DoubleDoubleVec3 c = centroid.to(triangles.corner(t, 2));
    const int side_bc = sure_sign(b, c, ray);
    if (side_ab * side_bc < 0) {
      continue;
    }
    const int side_ca = sure_sign(c, a, ray);
    if (side_ab * side_ca < 0 || side_bc * side_ca < 0) {
      continue;
    }
    if (side_ab == 0 || side_bc == 0 || side_ca == 0) {
      return std::nullopt;
    }
    // All three sides agree: the ray or its opposite meets the triangle, the ray where the triangle's own sign agrees.
    const int facing = sure_sign(a, b, c);
    if (facing == 0) {
      return std::nullopt;
    }
    if (facing == side_ab) {
      n += facing;
    }
  }
  return n;
}

/// By a ray through a point inside one triangle or another, until one meets nothing in doubt; 0, which is no convex
/// surface's, where none does.
long winding_number(const Triangles& triangles, const LocalPoint& centroid) {
  constexpr std::size_t kMostRays = 64;
  const std::size_t stride = triangles.size() / kMostRays + 1;
  for (std::size_t t = 0; t < triangles.size(); t += stride) {
    const Vec3d a = centroid.to(triangles.corner(t, 0)).value();
    const Vec3d b = centroid.to(triangles.corner(t, 1)).value();
    const Vec3d c = centroid.to(triangles.corner(t, 2)).value();
    const Vec3d inside = (0.4013 * a + 0.3271 * b) + 0.2716 * c;
    const DoubleDoubleVec3 ray{inside.x, inside.y, inside.z};
    if (const std::optional<long> n = windings_along(triangles, centroid, ray)) {
      return *n;
    }
  }
  return 0;
}

}  // namespace

ConvexityCensus convexity_census(const Triangles& triangles, const LocalPoint& centroid) {
  ConvexityCensus census;
  for (std::uint32_t h = 0; h < triangles.mates.size(); ++h) {
    if (triangles.mates[h] < h) {
      continue;
    }
    const Vec3d a = triangles.point(triangles.tail(h));
    const Vec3d b = triangles.point(triangles.head(h));
    const Vec3d c = triangles.point(triangles.opposite(h));
    const Vec3d d = triangles.point(triangles.opposite(triangles.mates[h]));
    const BoundedDeterminant det = orientation(a, b, c, d);
    if (det.surely_positive()) {
      const double depth = depth_at(a, b, c, d, det.value.value());
      if (census.n_reflex_edges++ == 0 || depth > census.reflex_depth) {
        census.reflex_depth = depth;
        census.deepest_half_edge = h;
      }
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const DoubleDoubleVec3 a = centroid.to(triangles.corner(t, 0));
    const DoubleDoubleVec3 b = centroid.to(triangles.corner(t, 1));
    const DoubleDoubleVec3 c = centroid.to(triangles.corner(t, 2));
    const BoundedDeterminant det = determinant(a, b, c);
    if (!det.surely_positive() && census.n_blind_triangles++ == 0) {
      census.first_blind_triangle = static_cast<std::uint32_t>(t);
    }
    if (det.surely_negative()) {
      census.area_turned_away += norm(cross(exact_difference(triangles.corner(t, 1), triangles.corner(t, 0)),
                                            exact_difference(triangles.corner(t, 2), triangles.corner(t, 0)))) /
                                 2.0;
    }
  }
  census.winding_number = winding_number(triangles, centroid);
  return census;
}

std::string edge_text(const Triangles& triangles, std::uint32_t half_edge) {
  return "the edge from " + point_text(triangles.point(triangles.tail(half_edge))) + " to " +
         point_text(triangles.point(triangles.head(half_edge)));
}

}  // namespace vex
