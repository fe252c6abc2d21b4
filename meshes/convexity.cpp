#include "meshes/convexity.h"

#include <cmath>
#include <optional>
#include <vector>

#include "engine/numeric/interruption.h"
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

/// The vertices of a surface as its centroid sees them: exactly, and rounded.
class SeenFromCentroid {
 public:
  SeenFromCentroid(const Triangles& triangles, const LocalPoint& centroid)
      : triangles_(triangles), centroid_(centroid) {
    rounded_.reserve(triangles.vertices.size());
    for (const Vec3d& v : triangles.vertices) {
      rounded_.push_back(centroid.to(v).value());
    }
  }

  const Vec3d& rounded(std::uint32_t vertex) const { return rounded_[vertex]; }
  DoubleDoubleVec3 exactly(std::uint32_t vertex) const { return centroid_.to(triangles_.point(vertex)); }

 private:
  const Triangles& triangles_;
  const LocalPoint& centroid_;
  std::vector<Vec3d> rounded_;
};

/// 1, -1 or 0 where the sign of det(a, b, c) may be hidden by rounding. Most are sure in double: its error is at most
/// gamma(8) times the product of the lengths. `exactly` is called for the others: the three in double-double.
template <class Exactly>
int sure_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Exactly& exactly) {
  const double rough = dot(a, cross(b, c));
  if (std::fabs(rough) > gamma(16) * (norm_1(a) * norm_1(b) * norm_1(c))) {
    return rough > 0.0 ? 1 : -1;
  }
  const BoundedDeterminant det = exactly();
  return det.surely_positive() ? 1 : (det.surely_negative() ? -1 : 0);
}

/// The triangles that the ray from the centroid along `ray` meets, those seen from outside counted negative; nothing
/// where it may pass through an edge, a vertex or a triangle seen edge-on. (Solid angles would do without a ray, but of
/// a thin body nearly all are seen at a grazing angle, and their sum loses everything: a needle of 10^10 to 1 wound
/// twice.)
std::optional<long> windings_along(const Triangles& triangles, const SeenFromCentroid& seen, const Vec3d& ray) {
  const DoubleDoubleVec3 exact_ray{ray.x, ray.y, ray.z};
  const auto side_of = [&](std::uint32_t a, std::uint32_t b) {
    return sure_sign(seen.rounded(a), seen.rounded(b), ray,
                     [&] { return determinant(seen.exactly(a), seen.exactly(b), exact_ray); });
  };
  long n = 0;
  for (const auto& [a, b, c] : triangles.corners) {
    const int side_ab = side_of(a, b);
    const int side_bc = side_of(b, c);
    if (side_ab * side_bc < 0) {
      continue;
    }
    const int side_ca = side_of(c, a);
    if (side_ab * side_ca < 0 || side_bc * side_ca < 0) {
      continue;
    }
    if (side_ab == 0 || side_bc == 0 || side_ca == 0) {
      return std::nullopt;
    }
    // All three sides agree: the ray or its opposite meets the triangle, the ray where the triangle's own sign agrees.
    const int facing = sure_sign(seen.rounded(a), seen.rounded(b), seen.rounded(c), [&, a = a, b = b, c = c] {
      return determinant(seen.exactly(a), seen.exactly(b), seen.exactly(c));
    });
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
long winding_number(const Triangles& triangles, const SeenFromCentroid& seen) {
  constexpr std::size_t kMostRays = 64;
  const std::size_t stride = triangles.size() / kMostRays + 1;
  for (std::size_t t = 0; t < triangles.size(); t += stride) {
    end_if_interrupted();
    const auto& [a, b, c] = triangles.corners[t];
    const Vec3d inside = (0.4013 * seen.rounded(a) + 0.3271 * seen.rounded(b)) + 0.2716 * seen.rounded(c);
    if (const std::optional<long> n = windings_along(triangles, seen, inside)) {
      return *n;
    }
  }
  return 0;
}

}  // namespace

ConvexityCensus convexity_census(const Triangles& triangles, const LocalPoint& centroid) {
  ConvexityCensus census;
  for (std::uint32_t h = 0; h < triangles.mates.size(); ++h) {
    if (h % 4096 == 0) end_if_interrupted();
    if (triangles.mates[h] < h) {
      continue;
    }
    const Vec3d a = triangles.point(triangles.tail(h));
    const Vec3d b = triangles.point(triangles.head(h));
    const Vec3d c = triangles.point(triangles.opposite(h));
    const Vec3d d = triangles.point(triangles.opposite(triangles.mates[h]));
    if (sure_determinant_sign(b - a, c - a, d - a) < 0) {
      continue;
    }
    const BoundedDeterminant det = orientation(a, b, c, d);
    if (det.surely_positive()) {
      const double depth = depth_at(a, b, c, d, det.value.value());
      if (census.n_reflex_edges++ == 0 || depth > census.reflex_depth) {
        census.reflex_depth = depth;
        census.deepest_half_edge = h;
      }
    }
  }
  const SeenFromCentroid seen(triangles, centroid);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t % 4096 == 0) end_if_interrupted();
    const auto& [a, b, c] = triangles.corners[t];
    if (sure_determinant_sign(seen.rounded(a), seen.rounded(b), seen.rounded(c)) > 0) {
      continue;
    }
    const BoundedDeterminant det = determinant(seen.exactly(a), seen.exactly(b), seen.exactly(c));
    if (!det.surely_positive() && census.n_blind_triangles++ == 0) {
      census.first_blind_triangle = static_cast<std::uint32_t>(t);
    }
    if (det.surely_negative()) {
      census.area_turned_away += norm(cross(exact_difference(triangles.corner(t, 1), triangles.corner(t, 0)),
                                            exact_difference(triangles.corner(t, 2), triangles.corner(t, 0)))) /
                                 2.0;
    }
  }
  census.winding_number = winding_number(triangles, seen);
  return census;
}

std::string edge_text(const Triangles& triangles, std::uint32_t half_edge) {
  return "the edge from " + point_text(triangles.point(triangles.tail(half_edge))) + " to " +
         point_text(triangles.point(triangles.head(half_edge)));
}

}  // namespace vex
