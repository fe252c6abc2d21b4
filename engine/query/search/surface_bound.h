// How near a closed surface of triangles comes to the origin that it goes around, proven: one look at each triangle,
// for a hull that is known already but for where its corners are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "engine/query/search/query_error.h"

namespace vex {

/// The most corners of such a surface, and the most triangles of one that is like a sphere.
inline constexpr std::uint32_t kMostSurfaceCorners = 64, kMostSurfaceFaces = 2 * kMostSurfaceCorners - 4;

/// The edges of triangles that are put together to a surface: an edge from i to j is one of one triangle, and that from
/// j to i is one of another.
class SurfaceEdges {
 public:
  /// n_corners: at most kMostSurfaceCorners.
  explicit SurfaceEdges(std::uint32_t n_corners) : n_corners_(n_corners) {
    for (std::uint32_t i = 0; i < n_corners_; ++i) forwards_[i] = backwards_[i] = 0;
  }
  /// False where a triangle has one of these edges already, or is none. Corners below n_corners.
  bool add(const std::array<std::uint32_t, 3>& corners) {
    bool is_new = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[k < 2 ? k + 1 : 0];
      is_new = is_new & (from != to) & ((forwards_[from] >> to & 1u) == 0);
      forwards_[from] |= std::uint64_t{1} << to;
      backwards_[to] |= std::uint64_t{1} << from;
    }
    return is_new;
  }
  bool are_closed() const {
    bool are = true;
    for (std::uint32_t i = 0; i < n_corners_; ++i) are &= forwards_[i] == backwards_[i];
    return are;
  }

 private:
  std::uint32_t n_corners_;
  // Bit j of i; those from n_corners on hold nothing.
  std::array<std::uint64_t, kMostSurfaceCorners> forwards_, backwards_;
};

template <class L>
struct SurfaceBound {
  L distance;      // as computed, of the nearest triangle's plane (E21)
  Vec3<L> normal;  // of that triangle, outwards, of any length
};

namespace detail {

typedef double TwoDoubles __attribute__((vector_size(16)));
typedef std::int64_t TwoMasks __attribute__((vector_size(16)));
inline TwoDoubles smaller(TwoDoubles a, TwoDoubles b) { return a < b ? a : b; }

/// The plane of a triangle, of one or of two side by side.
template <class V>
struct TrianglePlane {
  V least;        // of the normal's products with the corners
  V distance_sq;  // from the origin
  V sides_sq;     // the product of two edges' squares

  TrianglePlane(const Vec3<V>& p, const Vec3<V>& q, const Vec3<V>& r) {
    const Vec3<V> e = q - p, f = r - p, normal = cross(e, f);
    const V of_p = dot(normal, p), of_q = dot(normal, q), of_r = dot(normal, r);
    least = smaller(smaller(of_p, of_q), of_r);
    distance_sq = least * (least / dot(normal, normal));
    sides_sq = dot(e, e) * dot(f, f);
  }
  /// Whether the origin is behind it, proven (E21). rounding_sq: (32 u W)^2.
  auto has_origin_behind(const V& rounding_sq) const {
    return (least > V{}) & (least * least > rounding_sq * sides_sq);
  }
};

/// The nearest of triangles and the square of its distance; none where the origin is not behind each, proven.
struct NearestTriangle {
  std::uint32_t index;
  double distance_sq;
};
template <class At, class CornersOf>
std::optional<NearestTriangle> nearest_triangle(const At& at, std::uint32_t n_faces, const CornersOf& corners,
                                                double rounding_sq) {
  std::array<double, kMostSurfaceFaces + 1> distance_sq;
  TwoMasks are_behind = TwoMasks{} - 1;
  TwoDoubles least_sq = TwoDoubles{} + std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < n_faces; k += 2) {
    const std::array<std::uint32_t, 3> u = corners(k), v = corners(k + 1 < n_faces ? k + 1 : k);
    const auto both_at = [&](std::size_t j) {
      const Vec3<double>&a = at(u[j]), &b = at(v[j]);
      return Vec3<TwoDoubles>{{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
    };
    const TrianglePlane<TwoDoubles> plane(both_at(0), both_at(1), both_at(2));
    are_behind &= plane.has_origin_behind(TwoDoubles{} + rounding_sq);
    least_sq = smaller(plane.distance_sq, least_sq);
    std::memcpy(&distance_sq[k], &plane.distance_sq, sizeof plane.distance_sq);
  }
  if ((are_behind[0] & are_behind[1]) == 0) return std::nullopt;
  NearestTriangle nearest{0, std::min(least_sq[0], least_sq[1])};
  for (std::uint32_t k = 0; k < n_faces; ++k) {
    nearest.index = distance_sq[k] <= nearest.distance_sq ? k : nearest.index;
  }
  return nearest;
}

}  // namespace detail

/// `at(i)`: the i-th point, of n_points; `corners(k)` for k below n_faces. None where these triangles are no closed
/// surface that has the origin behind each of them, beyond rounding.
template <class L, class At, class CornersOf>
std::optional<SurfaceBound<L>> bound_by_surface(std::uint32_t n_points, const At& at, std::uint32_t n_faces,
                                                const CornersOf& corners, const QueryError<L>& error) {
  if (n_points > kMostSurfaceCorners || n_faces == 0 || n_faces > kMostSurfaceFaces) return std::nullopt;
  const L rounding_sq = L(1024.0 * (unit_roundoff<L>() * unit_roundoff<L>())) * (error.reach * error.reach);
  SurfaceEdges edges(n_points);
  bool are_right = true;
  for (std::uint32_t k = 0; k < n_faces; ++k) {
    const std::array<std::uint32_t, 3> of = corners(k);
    if (std::max({of[0], of[1], of[2]}) >= n_points) return std::nullopt;
    are_right = are_right & edges.add(of);
  }
  if (!are_right || !edges.are_closed()) return std::nullopt;
  std::uint32_t nearest = 0;
  L distance_sq(0.0);
  if constexpr (std::is_same_v<L, double>) {
    const std::optional<detail::NearestTriangle> found = detail::nearest_triangle(at, n_faces, corners, rounding_sq);
    if (!found) return std::nullopt;
    nearest = found->index;
    distance_sq = found->distance_sq;
  } else {
    for (std::uint32_t k = 0; k < n_faces; ++k) {
      const std::array<std::uint32_t, 3> of = corners(k);
      const detail::TrianglePlane<L> plane(at(of[0]), at(of[1]), at(of[2]));
      if (!plane.has_origin_behind(rounding_sq)) return std::nullopt;
      if (k != 0 && !(plane.distance_sq < distance_sq)) continue;
      distance_sq = plane.distance_sq;
      nearest = k;
    }
  }
  const std::array<std::uint32_t, 3> of = corners(nearest);
  return SurfaceBound<L>{square_root(distance_sq), cross(at(of[1]) - at(of[0]), at(of[2]) - at(of[0]))};
}

}  // namespace vex
