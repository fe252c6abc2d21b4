// How near a closed surface of triangles comes to the origin that it goes around, proven: one look at each triangle,
// for a hull that is known already but for where its corners are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "engine/query/search/query_error.h"

namespace vex {

/// The most corners of such a surface.
inline constexpr std::uint32_t kMostSurfaceCorners = 64;

/// The edges of triangles that are put together to a surface: an edge from i to j is one of one triangle, and that from
/// j to i is one of another.
class SurfaceEdges {
 public:
  /// False where a triangle has one of these edges already, or is none. Corners below kMostSurfaceCorners.
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
  bool are_closed() const { return forwards_ == backwards_; }

 private:
  std::array<std::uint64_t, kMostSurfaceCorners> forwards_{}, backwards_{};  // bit j of i
};

template <class L>
struct SurfaceBound {
  L distance;      // as computed, of the nearest triangle's plane (E21)
  Vec3<L> normal;  // of that triangle, outwards, of any length
};

/// `at(i)`: the i-th point, of n_points; `corners(k)` for k below n_faces. None where these triangles are no closed
/// surface that has the origin behind each of them, beyond rounding.
template <class L, class At, class CornersOf>
std::optional<SurfaceBound<L>> bound_by_surface(std::uint32_t n_points, const At& at, std::uint32_t n_faces,
                                                const CornersOf& corners, const QueryError<L>& error) {
  if (n_points > kMostSurfaceCorners || n_faces == 0) return std::nullopt;
  const L rounding_sq = L(1024.0 * (unit_roundoff<L>() * unit_roundoff<L>())) * (error.reach * error.reach);
  SurfaceEdges edges;
  bool are_right = true;
  L least_quotient(0.0);
  Vec3<L> nearest;
  for (std::uint32_t k = 0; k < n_faces; ++k) {
    const std::array<std::uint32_t, 3> of = corners(k);
    if (std::max({of[0], of[1], of[2]}) >= n_points) return std::nullopt;
    are_right = are_right & edges.add(of);
    const Vec3<L>&p = at(of[0]), &q = at(of[1]), &r = at(of[2]);
    const Vec3<L> e = q - p, f = r - p, normal = cross(e, f);
    const L of_p = dot(normal, p), of_q = dot(normal, q), of_r = dot(normal, r);
    const L least = smaller(smaller(of_p, of_q), of_r);
    const L least_sq = least * least;
    are_right = are_right & (least > L(0.0)) & (least_sq > rounding_sq * (dot(e, e) * dot(f, f)));
    const L quotient = least_sq / dot(normal, normal);
    if (k == 0 || quotient < least_quotient) {
      least_quotient = quotient;
      nearest = normal;
    }
  }
  if (!are_right || !edges.are_closed()) return std::nullopt;
  return SurfaceBound<L>{square_root(least_quotient), nearest};
}

}  // namespace vex
