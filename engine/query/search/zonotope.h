// The difference of two zonotopes (support/generators.h) is a zonotope: of few vectors, its nearest point and its
// depth need no search. Docs: derivations, E24.
#pragma once

#include <array>
#include <optional>

#include "engine/numeric/interval.h"
#include "engine/query/search/query_error.h"

namespace vex {

/// Holds a reference. K = A - B = {centre_a - centre_b + sum of s_k g_k : |s_k| <= 1}, in A's frame; A's vectors come
/// first.
struct DifferenceZonotope {
  static constexpr int kMostVectors = 6;
  DifferenceZonotope(const Generators& a, const Generators& b, const Transformd& a_from_b);

  Vec3d centre_a, centre_b;
  int n_of_a = 0, n_vectors = 0;
  std::array<Vec3d, kMostVectors> vectors;
  const Generators& own_b;  // in B's frame
};

/// Along `normal`, a unit vector from A towards B, the zonotopes are `distance` apart, or minus the depth; `bounds`
/// are of the true signed distance of the cores, rounding included.
struct ZonotopeSeparation {
  Vec3d normal;
  double distance = 0.0;
  Interval<double> bounds;
  Vec3d point_a, point_b;  // the nearest ones, or those at the foot of the shortest way out
  Vec3d own_point_b;       // in B's frame
};

/// Of up to two vectors together, of points, segments and a rectangle beside a point: the nearest point in closed form.
/// None of more, or where rounding leaves it open, as of segments that cross.
std::optional<ZonotopeSeparation> nearest_of_segments(const Generators& a, const Generators& b,
                                                      const Transformd& a_from_b, const QueryError<double>& error);

/// Of three to six vectors: K reaches least far in the direction of one of its faces, each of which two vectors span.
/// All are looked at. With the origin outside a face proves it: then `bounds.lower` is positive, and nothing else is
/// told (of what is farther from the nearest face than from the nearest point). None where rounding leaves a face open
/// that may matter.
std::optional<ZonotopeSeparation> deepest_of_faces(const DifferenceZonotope& k, const QueryError<double>& error);

}  // namespace vex
