#include "meshes/hull_depth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

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

  /// The facet that the ray to `p` meets, by walking from `start` across edges that `p` is beyond. On a convex surface
  /// each step raises n . p / offset of the facet's plane, so the walk ends; rounding may make it circle among facets
  /// that agree to the last bits, and then any of them will do: the bound on the steps is that of a large detour.
  std::uint32_t facet_towards(const Vec3d& p, std::uint32_t start) {
    std::uint32_t facet = start;
    std::uint32_t came_from = kNone;
    for (std::size_t step = 0; step < hull_.size(); ++step) {
      const std::uint32_t across = edge_before(p, facet, came_from, step);
      if (across == kNone) {
        break;
      }
      if (++n_steps_ > kStepsPerFacet * (hull_.size() + kFewFacets)) {
        throw InputError("the mesh is too irregular to be compared with its convex hull (" + std::to_string(n_steps_) +
                         " steps) - mend the mesh, or use --hull, which takes the hull");
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
  static constexpr std::size_t kStepsPerFacet = 1000;
  static constexpr std::size_t kFewFacets = 1000;
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
    return kNone;
  }

  const Triangles& hull_;
  const std::vector<Vec3d>& vertices_;
  std::vector<Plane> planes_;
  std::size_t n_steps_ = 0;
  std::size_t n_full_searches_ = 0;
};

}  // namespace

HullDepth depth_below_hull(const Triangles& mesh, const Triangles& hull, const LocalPoint& centroid, double tolerated) {
  std::vector<Vec3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3d& v : mesh.vertices) {
    vertices.push_back(centroid.to(v).value());
  }
  std::vector<bool> is_done(vertices.size(), false);
  for (const auto& triangle : hull.corners) {
    for (const std::uint32_t vertex : triangle) {
      is_done[vertex] = true;  // on the hull
    }
  }
  HullFromInside surface(hull, vertices);
  HullDepth deepest;
  const auto look_at = [&](const Vec3d& p, std::uint32_t start) {
    const std::uint32_t facet = surface.facet_towards(p, start);
    double depth = surface.depth_below(p, facet);
    if (depth > tolerated) {
      depth = surface.least_depth(p, depth);
    }
    if (depth > deepest.depth) {
      deepest = {depth, centroid.value() + p};
    }
    return facet;
  };

  // Over the mesh from triangle to neighbouring triangle, so that each search starts beside the last.
  std::vector<std::uint32_t> facet_of(mesh.size(), kNone);
  std::vector<std::uint32_t> queue{0};
  queue.reserve(mesh.size());
  facet_of[0] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t t = queue[next];
    const auto& [a, b, c] = mesh.corners[t];
    facet_of[t] = look_at((1.0 / 3.0) * ((vertices[a] + vertices[b]) + vertices[c]), facet_of[t]);
    for (const std::uint32_t vertex : {a, b, c}) {
      if (!is_done[vertex]) {
        is_done[vertex] = true;
        look_at(vertices[vertex], facet_of[t]);
      }
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t neighbour = mesh.mates[3 * t + k] / 3;
      if (facet_of[neighbour] == kNone) {
        facet_of[neighbour] = facet_of[t];
        queue.push_back(neighbour);
      }
    }
  }
  return deepest;
}

}  // namespace vex
