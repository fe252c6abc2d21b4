#include "meshes/polyhedron_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"

namespace vex {

VolumeAndCentroid volume_and_centroid(const Triangles& triangles) {
  VolumeAndCentroid result;
  const Vec3d base = triangles.corner(0, 0);
  DoubleDouble& six_volumes = result.six_volumes;
  double error = 0.0;
  double magnitude = 0.0;
  DoubleDoubleVec3 moment;  // sum of six_volume * (a + b + c), coordinates from the base
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const DoubleDoubleVec3 a = exact_difference(triangles.corner(t, 0), base);
    const DoubleDoubleVec3 b = exact_difference(triangles.corner(t, 1), base);
    const DoubleDoubleVec3 c = exact_difference(triangles.corner(t, 2), base);
    const BoundedDeterminant det = determinant(a, b, c);
    six_volumes += det.value;
    error += det.error;
    magnitude += std::fabs(det.value.value());
    const DoubleDoubleVec3 sum = (a + b) + c;
    moment = moment + DoubleDoubleVec3{det.value * sum.x, det.value * sum.y, det.value * sum.z};
  }
  // Each sum adds 3 u^2 of the partial sum's magnitude.
  error += 4.0 * kUnitRoundoff * kUnitRoundoff * static_cast<double>(triangles.size()) * magnitude;
  result.volume = six_volumes.value() / 6.0;
  result.volume_error = error / 6.0;
  result.centroid.base = base;
  if (std::fabs(result.volume) > result.volume_error) {
    // A tetrahedron's centroid is a quarter of the sum of its corners, one of which is the base.
    const double scale = 4.0 * six_volumes.value();
    result.centroid.step = {moment.x.value() / scale, moment.y.value() / scale, moment.z.value() / scale};
  }
  return result;
}

namespace {

/// Twice the area, along the outward normal.
DoubleDoubleVec3 dir_normal_of(const Triangles& triangles, std::size_t t) {
  const Vec3d a = triangles.corner(t, 0);
  return cross(exact_difference(triangles.corner(t, 1), a), exact_difference(triangles.corner(t, 2), a));
}

Vec3d normalised(const DoubleDoubleVec3& v) {
  const Vec3d dir = scaled_to_unit_exponent(v.value());
  return (1.0 / norm(dir)) * dir;
}

/// An edge and the angle by which the surface turns there.
struct Edge {
  DoubleDoubleVec3 along, dir_normal_left;
  double length = 0.0, exterior_angle_rad = 0.0;
};

template <class Visit>
void for_each_edge(const Triangles& triangles, const Visit& visit) {
  for (std::uint32_t h = 0; h < triangles.mates.size(); ++h) {
    const std::uint32_t back = triangles.mates[h];
    if (back < h) {
      continue;
    }
    const Vec3d a = triangles.point(triangles.tail(h));
    const DoubleDoubleVec3 edge = exact_difference(triangles.point(triangles.head(h)), a);
    const DoubleDoubleVec3 to_left = exact_difference(triangles.point(triangles.opposite(h)), a);
    const DoubleDoubleVec3 to_right = exact_difference(triangles.point(triangles.opposite(back)), a);
    const DoubleDoubleVec3 dir_normal_left = cross(edge, to_left);
    const DoubleDoubleVec3 dir_normal_right = cross(to_right, edge);
    // With n1 = e x l and n2 = r x e: n1 x n2 = -det(e, l, r) e, which has the direction of e at a convex edge.
    const double length = norm(edge);
    const double sine = -dot(dir_normal_left, to_right).value() * length;
    const double cosine = dot(dir_normal_left, dir_normal_right).value();
    visit(Edge{edge, dir_normal_left, length, std::atan2(sine, cosine)});
  }
}

}  // namespace

SolidMoments solid_moments(const Triangles& triangles) {
  const VolumeAndCentroid solid = volume_and_centroid(triangles);
  SolidMoments moments{solid.volume, solid.centroid.value(), {}};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Vec3d, 3> corners;
    Vec3d sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const DoubleDoubleVec3 from_centroid = solid.centroid.to(triangles.corner(t, k));
      corners[k] = {from_centroid.x.value(), from_centroid.y.value(), from_centroid.z.value()};
      sum = sum + corners[k];
    }
    // Of a tetrahedron with a corner at the origin: V/20 of the sums of v v^T over the corners and of their sum's.
    const double share = dot(corners[0], cross(corners[1], corners[2])) / 120.0;
    for (const Vec3d& v : {corners[0], corners[1], corners[2], sum}) {
      moments.second[0] = moments.second[0] + (share * v.x) * v;
      moments.second[1] = moments.second[1] + (share * v.y) * v;
      moments.second[2] = moments.second[2] + (share * v.z) * v;
    }
  }
  return moments;
}

double surface_area(const Triangles& triangles) {
  DoubleDouble twice_area;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    twice_area += norm(dir_normal_of(triangles, t));
  }
  return twice_area.value() / 2.0;
}

double integrated_mean_curvature(const Triangles& triangles) {
  DoubleDouble twice_curvature;
  for_each_edge(triangles, [&](const Edge& edge) { twice_curvature += edge.length * edge.exterior_angle_rad; });
  return twice_curvature.value() / 2.0;
}

NormalMeasure area_measure(const Triangles& triangles) {
  NormalMeasure area;
  area.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const DoubleDoubleVec3 dir_normal = dir_normal_of(triangles, t);
    const double twice_area = norm(dir_normal);
    if (twice_area > 0.0) {
      area.add(NormalAtom{normalised(dir_normal), 0.5 * twice_area});
    }
  }
  return area;
}

NormalMeasure mean_curvature_measure(const Triangles& triangles) {
  NormalMeasure curvature;
  curvature.reserve(triangles.mates.size() / 2);
  for_each_edge(triangles, [&](const Edge& edge) {
    if (edge.exterior_angle_rad > 0.0) {
      // Across the edge, from the face on its left: the rotation from that face's normal to the other's is about e.
      const Vec3d from = normalised(edge.dir_normal_left);
      const Vec3d across = cross(normalised(edge.along), from);
      curvature.add(NormalArc{from, (1.0 / norm(across)) * across, edge.exterior_angle_rad,
                              0.5 * edge.length * edge.exterior_angle_rad});
    }
  });
  return curvature;
}

double bounding_diagonal(std::span<const Vec3d> vertices) {
  VEX_EXPECT(!vertices.empty());
  Vec3d low = vertices.front();
  Vec3d high = low;
  for (const Vec3d& v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return norm(high - low);
}

namespace {

/// A lower bound of what `computed_distance` makes of a triangle, where rounding leaves one; minus infinity where not.
///
/// The determinant is off by at most gamma(11) permanents (sure_determinant_sign), by some u^2 of one there, and its
/// bound there is 40 u^2. Each coordinate of the normal is off by gamma(5) of its two products' magnitudes, which are
/// at most `spread` together, so its length by gamma(12) of that, unless its square is near to underflow.
double sure_distance(const Triangles& triangles, std::size_t t, const LocalPoint& centre) {
  constexpr double kLeastSureLength = 0x1p-480;
  const Vec3d corner = triangles.corner(t, 0);
  const Vec3d a = centre.to(corner).value();
  const Vec3d ab = triangles.corner(t, 1) - corner;
  const Vec3d ac = triangles.corner(t, 2) - corner;
  const double magnitude = permanent(a, ab, ac);
  const double normal_length = norm(cross(ab, ac));
  const double least = rough_determinant(a, ab, ac) - gamma(32) * magnitude;
  if (!(least > 0.0) || !(magnitude > kLeastSurePermanent) || !(normal_length > kLeastSureLength)) {
    return -std::numeric_limits<double>::infinity();
  }
  const double spread = norm_1(ab) * norm_1(ac);
  return least / (normal_length + gamma(32) * spread) * (1.0 - gamma(8));
}

double computed_distance(const Triangles& triangles, std::size_t t, const LocalPoint& centre) {
  const DoubleDoubleVec3 a = centre.to(triangles.corner(t, 0));
  const DoubleDoubleVec3 ab = exact_difference(triangles.corner(t, 1), triangles.corner(t, 0));
  const DoubleDoubleVec3 ac = exact_difference(triangles.corner(t, 2), triangles.corner(t, 0));
  const BoundedDeterminant det = determinant(a, ab, ac);
  const double normal_length = norm(cross(ab, ac));
  return normal_length > 0.0 ? (det.value.value() - det.error) / normal_length
                             : std::numeric_limits<double>::infinity();  // it lies in its neighbours
}

}  // namespace

double inscribed_radius(const Triangles& triangles, const LocalPoint& centre) {
  // Those whose bound is the least first: they leave few others in doubt.
  std::vector<double> at_least(triangles.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    at_least[t] = sure_distance(triangles, t, centre);
    least = std::min(least, at_least[t]);
  }
  double radius = std::numeric_limits<double>::infinity();
  const auto compare = [&](std::size_t t) { radius = std::min(radius, computed_distance(triangles, t, centre)); };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (at_least[t] == least) {
      compare(t);
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (at_least[t] != least && at_least[t] <= radius) {
      compare(t);
    }
  }
  if (!std::isfinite(radius)) {
    return 0.0;
  }
  // A dozen roundings of one division, one root and the norm under it.
  return std::max(0.0, radius * (1.0 - gamma(16)));
}

Vec3d rounded_centre(const LocalPoint& centroid, double inradius, double size) {
  const double scale = inradius > 0.0 ? inradius * 0x1p-20 : size * 0x1p-40;
  const double grid = std::ldexp(1.0, std::ilogb(scale));
  // Twice: what rounding left of a sum that should be a whole number of half grids must not choose the side.
  const auto rounded = [grid](double base, double step) {
    const double fine = std::nearbyint((base + step) / (grid * 0x1p-24)) * (grid * 0x1p-24);
    return std::nearbyint(fine / grid) * grid + 0.0;
  };
  return {rounded(centroid.base.x, centroid.step.x), rounded(centroid.base.y, centroid.step.y),
          rounded(centroid.base.z, centroid.step.z)};
}

}  // namespace vex
