// The faces of a hull that grows (growing_hull.h), and the memory that it grows in.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/numeric/lane.h"
#include "engine/numeric/vec3.h"

namespace vex {

namespace detail {

/// A place in an array of faces, and an edge of that face: from corner k to the next one. In one word: of two that are
/// written one after the other and read together the reader waits for the writer.
class FaceEdge {
 public:
  FaceEdge() = default;
  FaceEdge(std::uint32_t face, std::uint32_t edge) : bits_(4 * face + edge) {}
  std::uint32_t face() const { return bits_ / 4; }
  std::uint32_t edge() const { return bits_ % 4; }

 private:
  std::uint32_t bits_ = 0;
};

template <class L>
struct HullFace {
  std::array<std::uint32_t, 3> corners;  // outwards where it turns counter-clockwise
  std::array<FaceEdge, 3> across;        // the other side of the edge from corner k to the next one
  Vec3<L> normal;                        // outwards, of any length
  L offset;                              // of the plane: normal . corner
  L coplanar;                            // what is less above the plane, times the normal's length, is in it
  L nearness;                            // the square of `distance`, with its sign
  std::uint32_t mark = 0;                // of the last search that came by
  bool is_alive = true;
  bool has_origin_behind = false;  // proven

  /// No point of the triangle is nearer to the origin, by its computed products; negative where that is in front.
  L distance() const {
    const L size = square_root(absolute(nearness));
    return nearness < L(0.0) ? -size : size;
  }
};

/// Of a sliver, the point of its longest edge that is nearest to the origin. Hardly ever asked, and so not in line.
template <class L>
[[gnu::cold, gnu::noinline]] Vec3<L> nearest_on_longest_edge(const Vec3<L>& p, const Vec3<L>& q, const Vec3<L>& r) {
  const std::array<std::array<const Vec3<L>*, 2>, 3> edges = {{{&p, &q}, {&q, &r}, {&r, &p}}};
  Vec3<L> nearest = p;
  L longest(-1.0);
  for (const auto& edge : edges) {
    const Vec3<L>&from = *edge[0], &to = *edge[1];
    const Vec3<L> e = to - from;
    const L square = dot(e, e);
    if (!(square > longest)) continue;
    longest = square;
    const L along = -dot(from, e);
    nearest = !(along > L(0.0)) ? from : !(along < square) ? to : from + (along / square) * e;
  }
  return nearest;
}

}  // namespace detail

/// Memory that a hull grows in. One serves one query at a time, and then others.
template <class L, class Point>
struct PolytopeStore {
  struct RimEdge {
    std::uint32_t from, to;
    detail::FaceEdge outside;
  };
  std::vector<Point> points;
  std::vector<detail::HullFace<L>> faces;
  std::vector<std::pair<L, std::uint32_t>> near;  // distances and faces that may be the nearest
  std::vector<std::uint32_t> hidden;
  std::vector<RimEdge> rim;
  struct Step {
    std::uint32_t face, edge, n_left;
  };
  std::vector<Step> path;
  std::vector<std::uint32_t> point_marks;  // of the last rim that passed

  void clear() {
    points.clear();
    faces.clear();
    near.clear();
    point_marks.clear();
  }
};

}  // namespace vex
