// How far points are outside a convex surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"

namespace vex {

/// Finds for one point after another the facet of a convex surface that the ray from the surface's middle meets. Points
/// that come near each other are found in few steps: each search starts where the last one ended.
class FacetDistance {
 public:
  /// `hull`: convex, every triangle with area; it must outlive this.
  explicit FacetDistance(const Triangles& hull);

  struct Found {
    std::uint32_t facet = 0;
    double distance = 0.0;  // from that facet: never below the distance from the surface, rounding included
  };
  Found to(const Vec3d& point);

 private:
  std::uint32_t facet_towards(const Vec3d& local);

  const Triangles& hull_;
  LocalPoint middle_;
  std::vector<Vec3d> local_;  // the vertices from the middle
  std::uint32_t near_ = 0;
  std::size_t n_steps_ = 0, most_steps_ = 100'000;
};

}  // namespace vex
