#include "shapes/polytope.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"

namespace vex {

Polytope::Polytope(std::span<const Vec3d> vertices, const Vec3d& centre, double inradius)
    : centre_(centre), inradius_(inradius) {
  checked_size_or_zero(inradius, "the inradius of a polytope");
  if (vertices.empty()) throw InputError("a polytope has no vertex - give at least one point");
  double farthest = 0.0, largest = 0.0;
  for (const Vec3d& v : vertices) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw InputError("a vertex of a polytope is not finite - give finite coordinates");
    }
    x_.push_back(v.x);
    y_.push_back(v.y);
    z_.push_back(v.z);
    farthest = std::max(farthest, safe_norm(v - centre));
    largest = std::max(largest, safe_norm(v));
  }
  circumradius_ = farthest * (1.0 + gamma(8));
  support_error_ = 8.0 * kUnitRoundoff * largest;
  if (n_vertices() > kMostScannedVertices) map_ = std::make_shared<LazyDirectionMap>();
}

std::vector<Vec3d> Polytope::vertices() const {
  std::vector<Vec3d> all;
  all.reserve(n_vertices());
  for (std::size_t i = 0; i < n_vertices(); ++i) all.push_back(vertex(i));
  return all;
}

}  // namespace vex
