#include "meshes/extreme_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/numeric/interruption.h"
#include "engine/numeric/rounding.h"
#include "meshes/exact_hull.h"
#include "meshes/facet_distance.h"
#include "meshes/joining_order.h"
#include "meshes/polyhedron_measures.h"

namespace vex {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// For each vertex a direction that it is outermost in, if it is a corner: the triangles' unit normals, each times the
/// chord of its angle at the vertex, about as long as the angle; so how a face is cut matters little.
std::vector<Vec3d> outward_directions(const Triangles& surface) {
  std::vector<Vec3d> directions(surface.vertices.size());
  for (const auto& [a, b, c] : surface.corners) {
    const std::array<std::uint32_t, 3> at{a, b, c};
    std::array<Vec3d, 3> edge;  // edge k starts at corner k
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = surface.point(at[(k + 1) % 3]) - surface.point(at[k]);
    }
    const Vec3d normal = cross(edge[0], edge[1]);
    const double length = norm(normal);
    if (!(length > 0.0)) {
      continue;
    }
    for (Vec3d& e : edge) {
      e = (1.0 / norm(e)) * e;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      directions[at[k]] = directions[at[k]] + (norm(edge[k] + edge[(k + 2) % 3]) / length) * normal;
    }
  }
  return directions;
}

/// For each vertex whether it is surely a corner that is farther than `tolerance` outside the hull of all others.
///
/// Where a vertex is higher than all its neighbours along a direction, it is the highest of all, and the next highest
/// is a neighbour: both are so of every convex surface. So the others' hull is as far below it as its highest neighbour
/// is. Each coordinate of a difference is off by u of itself, the product by some u of the sum of magnitudes.
std::vector<bool> sure_corners(const Triangles& surface, double tolerance) {
  const std::vector<Vec3d> directions = outward_directions(surface);
  std::vector<double> least_drop(directions.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t h = 0; h < surface.mates.size(); ++h) {
    const std::uint32_t v = surface.tail(h);
    const Vec3d& n = directions[v];
    const Vec3d step = surface.point(v) - surface.point(surface.head(h));
    const double error = gamma(8) * (std::fabs(n.x * step.x) + std::fabs(n.y * step.y) + std::fabs(n.z * step.z));
    least_drop[v] = std::min(least_drop[v], dot(n, step) - error);
  }
  std::vector<bool> is_sure(directions.size());
  for (std::size_t v = 0; v < is_sure.size(); ++v) {
    const double drop = least_drop[v];
    is_sure[v] = drop < std::numeric_limits<double>::infinity() && drop > 0.0 &&
                 drop > tolerance * norm(directions[v]) * (1.0 + gamma(16));
  }
  return is_sure;
}

/// The first of the vertices that are outermost in each of a few directions.
void keep_outermost(std::span<const Vec3d> vertices, std::vector<bool>* is_kept) {
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const Vec3d dir{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        std::size_t best = 0;
        for (std::size_t v = 1; v < vertices.size(); ++v) {
          best = dot(dir, vertices[v]) > dot(dir, vertices[best]) ? v : best;
        }
        (*is_kept)[best] = true;
      }
    }
  }
}

/// A choice of the corners of a hull that grows until it is near enough to it.
class GrowingChoice {
 public:
  GrowingChoice(const HullOfPoints& corners, double tolerance)
      : corners_(corners), tolerance_(tolerance), is_kept_(sure_corners(corners.triangles, tolerance)) {
    keep_outermost(corners.vertices, &is_kept_);
    for (const std::uint32_t v : joining_order(corners.vertices)) {
      if (!is_kept_[v]) {
        undecided_.push_back(v);
      }
    }
  }

  /// The hull of the choice; nothing where none could be made, or where the choice came to hold all.
  std::optional<ExtremeVertices> grown() {
    constexpr int kMostRounds = 40;  // each about doubles what grows
    constexpr std::size_t kMany = 10'000, kMostHulls = 4;
    const std::size_t n_all = corners_.vertices.size();
    std::size_t n_in_hulls = 0;
    if (n_all > kMany && few_are_undecided(n_all)) {
      return std::nullopt;
    }
    for (int round = 0; round < kMostRounds && (round == 0 || !few_are_undecided(n_kept_)); ++round) {
      ExtremeVertices result;
      result.hull.vertices = chosen_points(corners_.vertices, is_kept_);
      n_kept_ = result.hull.vertices.size();
      if (n_kept_ == n_all) {
        return std::nullopt;
      }
      std::optional<Triangles> hull = exact_hull(result.hull.vertices);
      if (!hull) {
        return std::nullopt;
      }
      result.hull.triangles = std::move(*hull);
      if (!keep_what_is_outside(result.hull.triangles)) {
        result.farthest_outside = farthest_outside_;
        return result;
      }
      // Of points each farther out than the one before every round adds a few, to a hull of many.
      n_in_hulls += n_kept_;
      if (n_all > kMany && n_in_hulls >= kMostHulls * n_all) break;
    }
    return with_the_undecided();
  }

 private:
  /// A further hull is not worth it for an eighth of the vertices.
  bool few_are_undecided(std::size_t n_vertices) const { return 8 * undecided_.size() <= n_vertices; }

  /// What is farther outside than the tolerance and could have been spared, perhaps.
  std::optional<ExtremeVertices> with_the_undecided() {
    for (const std::uint32_t v : undecided_) {
      is_kept_[v] = true;
    }
    ExtremeVertices result;
    result.hull.vertices = chosen_points(corners_.vertices, is_kept_);
    std::optional<Triangles> hull = exact_hull(result.hull.vertices);
    if (!hull) {
      return std::nullopt;
    }
    result.hull.triangles = std::move(*hull);
    result.farthest_outside = farthest_outside_;
    return result;
  }

  /// Decides the vertices that are within the tolerance: they stay so when the hull grows. Of the others, keeps the
  /// farthest above each facet. Whether there was one.
  bool keep_what_is_outside(const Triangles& hull) {
    FacetDistance distance(hull);
    struct Farthest {
      double distance = 0.0;
      std::uint32_t vertex = kNoVertex;
    };
    std::vector<Farthest> farthest(hull.size());
    std::vector<std::uint32_t> undecided;
    for (const std::uint32_t v : undecided_) {
      end_if_interrupted();
      const auto [facet, outside] = distance.to(corners_.vertices[v]);
      if (outside <= tolerance_) {
        farthest_outside_ = std::max(farthest_outside_, outside);
        continue;
      }
      undecided.push_back(v);
      if (farthest[facet].vertex == kNoVertex || outside > farthest[facet].distance) {
        farthest[facet] = {outside, v};
      }
    }
    for (const Farthest& one : farthest) {
      if (one.vertex != kNoVertex) {
        is_kept_[one.vertex] = true;
      }
    }
    std::erase_if(undecided, [&](std::uint32_t v) { return is_kept_[v]; });
    const bool found = std::ranges::any_of(farthest, [](const Farthest& one) { return one.vertex != kNoVertex; });
    undecided_ = std::move(undecided);
    return found;
  }

  const HullOfPoints& corners_;
  double tolerance_;
  std::vector<bool> is_kept_;
  std::vector<std::uint32_t> undecided_;  // near each other in this order, mostly
  std::size_t n_kept_ = 0;
  double farthest_outside_ = 0.0;
};

std::vector<bool> used_vertices(const Triangles& surface) {
  std::vector<bool> is_used(surface.vertices.size(), false);
  for (const auto& triangle : surface.corners) {
    for (const std::uint32_t v : triangle) {
      is_used[v] = true;
    }
  }
  return is_used;
}

}  // namespace

ExtremeVertices extreme_vertices(HullOfPoints convex, double tolerance, MadeFrom triangles) {
  convex.triangles.vertices = convex.vertices;
  const std::vector<bool> is_used = used_vertices(convex.triangles);
  if (sure_corners(convex.triangles, tolerance) == is_used) {
    return {over_used_vertices(std::move(convex.triangles), is_used), 0.0};
  }
  const std::vector<bool> is_corner = hull_corners(convex.triangles);
  HullOfPoints corners;
  if (triangles == MadeFrom::vertices && is_corner == is_used) {
    corners = over_used_vertices(std::move(convex.triangles), is_used);
  } else {
    corners.vertices = chosen_points(convex.vertices, is_corner);
    std::optional<Triangles> hull = exact_hull(corners.vertices);
    if (!hull) {
      return {over_used_vertices(std::move(convex.triangles), is_used), 0.0};
    }
    corners.triangles = std::move(*hull);
  }
  convex = {};
  if (std::optional<ExtremeVertices> fewer = GrowingChoice(corners, tolerance).grown()) {
    return std::move(*fewer);
  }
  return {std::move(corners), 0.0};
}

}  // namespace vex
