#include "meshes/convexity.h"

#include <cmath>
#include <numbers>

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

/// The solid angle of a triangle seen from the origin, signed (van Oosterom and Strackee 1983).
double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c, double det) {
  const double la = norm(a);
  const double lb = norm(b);
  const double lc = norm(c);
  return 2.0 * std::atan2(det, ((la * lb) * lc + dot(a, b) * lc) + (dot(b, c) * la + dot(c, a) * lb));
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
  double total_angle = 0.0;
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
    total_angle += solid_angle(a.value(), b.value(), c.value(), det.value.value());
  }
  census.winding_number = std::lround(total_angle / (4.0 * std::numbers::pi));
  return census;
}

std::string edge_text(const Triangles& triangles, std::uint32_t half_edge) {
  return "the edge from " + point_text(triangles.point(triangles.tail(half_edge))) + " to " +
         point_text(triangles.point(triangles.head(half_edge)));
}

}  // namespace vex
