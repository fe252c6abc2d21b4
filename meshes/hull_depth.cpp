#include "meshes/hull_depth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace vex {
namespace {

constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

/// n . p = offset with a unit normal; both zero for a triangle without area, whose place its neighbours cover.
struct Plane {
  Vec3d unit_normal;
  double offset = 0.0;
};

/// The hull as seen from the centroid, which is the origin here.
class HullFromInside {
 public:
  HullFromInside(const Triangles& hull, const std::vector<Vec3d>& vertices) : hull_(hull), vertices_(vertices) {
    planes_.reserve(hull.size());
    for (const auto& [a, b, c] : hull.corners) {
      const Vec3d normal = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
      const double length = norm(normal);
      const Vec3d unit = length > 0.0 ? (1.0 / length) * normal : Vec3d{};
      planes_.push_back({unit, dot(unit, vertices[a])});
    }
  }

  /// From `start` to neighbours whose planes are nearer to `p`, until there is none.
  std::uint32_t nearest_facet_from(const Vec3d& p, std::uint32_t start) const {
    std::uint32_t facet = start;
    for (std::uint32_t previous = kNoIndex; previous != facet;) {
      previous = facet;
      for (std::uint32_t k = 0; k < 3; ++k) {
        facet = nearer(p, facet, hull_.mates[3 * previous + k] / 3);
      }
    }
    return facet;
  }

  /// The nearest of `known` and the facets around the tail of a half-edge, of which a vertex may have too many to ask
  /// all.
  std::uint32_t nearest_around(const Vec3d& p, std::uint32_t known, std::uint32_t half_edge) const {
    constexpr int kMostAsked = 64;
    std::uint32_t h = half_edge;
    for (int n = 0; n < kMostAsked; ++n) {
      known = nearer(p, known, h / 3);
      h = hull_.mates[previous_in_triangle(h)];
      if (h == half_edge) {
        break;
      }
    }
    return known;
  }

  std::uint32_t nearer(const Vec3d& p, std::uint32_t facet, std::uint32_t other) const {
    return depth_below(p, other) < depth_below(p, facet) ? other : facet;
  }

  /// The facet that the ray to `p` meets, by crossing edges that `p` is beyond. On a convex surface each step raises
  /// n . p / offset of the facet's plane, so the walk ends; near-linear in all for a hull that was made from points in
  /// random order. All walks together have a bounded number of steps, after which any facet has to do for a bound.
  std::uint32_t facet_towards(const Vec3d& p, std::uint32_t start) {
    std::uint32_t facet = start;
    std::uint32_t came_from = kNoIndex;
    for (std::size_t step = 0; step < hull_.size() && n_steps_ < kMostSteps; ++step, ++n_steps_) {
      const std::uint32_t across = edge_before(p, facet, came_from, step);
      if (across == kNoIndex) {
        break;
      }
      came_from = facet;
      facet = hull_.mates[across] / 3;
    }
    return facet;
  }

  double depth_below(const Vec3d& p, std::uint32_t facet) const {
    return planes_[facet].offset - dot(planes_[facet].unit_normal, p);
  }

  /// The least depth below any facet; linear in the hull, so granted to a bounded number of points.
  double least_depth(const Vec3d& p, double known) {
    if (n_full_searches_++ * hull_.size() > kMostPlanesAsked) {
      return known;
    }
    for (const Plane& plane : planes_) {
      if (plane.offset > 0.0) {
        known = std::min(known, plane.offset - dot(plane.unit_normal, p));
      }
    }
    return known;
  }

 private:
  static constexpr std::size_t kMostSteps = 1'000'000'000;
  static constexpr std::size_t kMostPlanesAsked = 1'000'000'000;

  /// A half-edge of the facet that `p` is beyond, not the one just crossed; none where p is over the facet. Where there
  /// are two, steps take turns: a fixed choice could circle.
  std::uint32_t edge_before(const Vec3d& p, std::uint32_t facet, std::uint32_t came_from, std::size_t step) const {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t half_edge = 3 * facet + (i + static_cast<std::uint32_t>(step)) % 3;
      const Vec3d side = cross(vertices_[hull_.tail(half_edge)], vertices_[hull_.head(half_edge)]);
      if (dot(side, p) < 0.0 && hull_.mates[half_edge] / 3 != came_from) {
        return half_edge;
      }
    }
    return kNoIndex;
  }

  const Triangles& hull_;
  const std::vector<Vec3d>& vertices_;
  std::vector<Plane> planes_;
  std::size_t n_steps_ = 0;
  std::size_t n_full_searches_ = 0;
};

}  // namespace

HullDepth depth_below_hull(const Triangles& mesh, const Triangles& hull, const LocalPoint& centroid, double enough) {
  std::vector<Vec3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3d& v : mesh.vertices) {
    vertices.push_back(centroid.to(v).value());
  }
  HullFromInside surface(hull, vertices);
  HullDepth deepest;
  const auto note_depth = [&](const Vec3d& p, double depth) {
    if (depth > enough) {
      depth = surface.least_depth(p, depth);
    }
    if (depth > deepest.depth) {
      deepest.depth = depth;
      deepest.where = centroid.value() + p;
    }
  };
  // For each vertex a half-edge of the hull: one that starts there, or one of a facet that the vertex is in or near.
  std::vector<std::uint32_t> half_edge_at(vertices.size(), kNoIndex);
  for (std::uint32_t h = 0; h < hull.mates.size(); ++h) {
    half_edge_at[hull.tail(h)] = h;
  }
  const auto find_vertex = [&](std::uint32_t vertex, std::uint32_t start) {
    const Vec3d& p = vertices[vertex];
    const std::uint32_t near = surface.nearest_facet_from(p, start);
    const std::uint32_t facet = surface.facet_towards(p, near);
    note_depth(p, std::min(surface.depth_below(p, near), surface.depth_below(p, facet)));
    half_edge_at[vertex] = 3 * facet;
  };

  // Over the mesh from triangle to neighbouring triangle, from one with a vertex of the hull.
  std::vector<std::uint32_t> facet_of_middle(mesh.size(), kNoIndex);
  std::vector<std::uint32_t> queue;
  queue.reserve(mesh.size());
  for (std::uint32_t t = 0; queue.empty(); ++t) {
    if (half_edge_at[mesh.corners[t][0]] != kNoIndex) {
      facet_of_middle[t] = half_edge_at[mesh.corners[t][0]] / 3;
      queue.push_back(t);
    }
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t t = queue[next];
    const auto& [a, b, c] = mesh.corners[t];
    const Vec3d middle = (1.0 / 3.0) * ((vertices[a] + vertices[b]) + vertices[c]);
    const std::uint32_t towards_middle = surface.facet_towards(middle, facet_of_middle[t]);
    std::uint32_t start = towards_middle;
    for (const std::uint32_t vertex : {a, b, c}) {
      if (half_edge_at[vertex] != kNoIndex) {
        start = surface.nearest_around(middle, start, half_edge_at[vertex]);
      }
    }
    for (const std::uint32_t vertex : {a, b, c}) {
      if (half_edge_at[vertex] == kNoIndex) {
        find_vertex(vertex, start);
      }
    }
    start = surface.nearer(middle, start, towards_middle);
    note_depth(middle, surface.depth_below(middle, surface.nearest_facet_from(middle, start)));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t neighbour = mesh.mates[3 * t + k] / 3;
      if (facet_of_middle[neighbour] == kNoIndex) {
        facet_of_middle[neighbour] = towards_middle;
        queue.push_back(neighbour);
      }
    }
  }
  return deepest;
}

}  // namespace vex
