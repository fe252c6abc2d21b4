// A triangle as a body: flat, three vertices. Meshes that are no convex solids are made of them.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/support/convex_body.h"
#include "engine/support/first_farthest.h"

namespace vex {

/// The convex hull of three points, which may be in line or the same. The vertices are the body exactly, and a support
/// point is one of them, bit for bit; of vertices that tie the first.
class TriangleBody {
 public:
  /// Throws InputError where a coordinate is not finite.
  explicit TriangleBody(const std::array<Vec3d, 3>& vertices) : vertices_(vertices) {
    for (const Vec3d& v : vertices) {
      if (!is_finite(v)) throw InputError("a vertex of a triangle is not finite - give finite coordinates");
      largest_ = larger(largest_, safe_norm(v));
    }
    const double third = 1.0 / 3.0;
    centre_ = third * vertices[0] + third * vertices[1] + third * vertices[2];
    for (const Vec3d& v : vertices) circumradius_ = larger(circumradius_, safe_norm(v - centre_));
    circumradius_ = circumradius_ * (1.0 + gamma(8));
  }

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    if constexpr (std::same_as<L, double>) {
      return vertices_[first_farthest(3, dir, [this](std::uint64_t k) -> const Vec3d& { return vertices_[k]; })];
    } else {
      Vec3<L> best = broadcast<L>(vertices_[0]);
      L most = dot(best, dir);
      for (std::size_t k = 1; k < 3; ++k) {
        const Vec3<L> vertex = broadcast<L>(vertices_[k]);
        const L value = dot(vertex, dir);
        best = select(value > most, vertex, best);
        most = select(value > most, value, most);
      }
      return best;
    }
  }
  /// As a polytope's (E2): the value is short of the largest by at most this times |dir|.
  double support_error() const { return 8.0 * kUnitRoundoff * largest_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return 0.0; }
  ExactForm exact_form() const { return {{vertices_[0], vertices_[1], vertices_[2]}, {}, 0.0}; }

  const std::array<Vec3d, 3>& vertices() const { return vertices_; }

 private:
  std::array<Vec3d, 3> vertices_;
  Vec3d centre_;
  double circumradius_ = 0.0;  // rounded upwards
  double largest_ = 0.0;
};

}  // namespace vex
