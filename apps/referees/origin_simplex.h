// The nearest point of a simplex to the origin, and what of the simplex carries it: the inner step of Gilbert, Johnson
// and Keerthi's descent (1988), in twice the precision of a double.
#pragma once

#include <vector>

#include "apps/referees/difference_body.h"

namespace vex::exact {

inline DoubleDouble determinant_of(const Vec3dd& a, const Vec3dd& b, const Vec3dd& c) { return dot(a, cross(b, c)); }

/// One to four points of a difference of bodies.
class OriginSimplex {
 public:
  std::vector<DifferencePoint> points;

  /// Reduces the simplex to what carries its point nearest to the origin; false where the origin is inside of a
  /// tetrahedron.
  bool reduce(Vec3dd& nearest_point);

 private:
  struct Nearest {
    Vec3dd point;
    unsigned carriers = 0;  // a bit for each of the points
    DoubleDouble distance_sq;
  };
  const Vec3dd& at(std::size_t i) const { return points[i].approximately; }
  bool holds_origin() const;
  void offer(const Vec3dd& point, unsigned carriers);
  void offer_edge(std::size_t i, std::size_t j);
  void offer_triangle(std::size_t i, std::size_t j, std::size_t k);

  Nearest best_;
};

/// Whether the point is one of the simplex already: a descent that comes back to it has ended.
bool has_point(const OriginSimplex& simplex, const DifferencePoint& point);

}  // namespace vex::exact
