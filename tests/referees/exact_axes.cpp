#include "tests/referees/exact_axes.h"

#include <algorithm>
#include <set>

#include "apps/referees/exact_overlap.h"
#include "engine/numeric/expect.h"

namespace vex::exact {
namespace {

WholePoint difference(const WholePoint& a, const WholePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

WholePoint cross(const WholePoint& a, const WholePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const WholePoint& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

// One vector for all that are parallel: without common factor, the first coordinate that is not zero positive.
WholePoint primitive(const WholePoint& v) {
  Whole factor = gcd(gcd(v[0], v[1]), v[2]);
  if (factor == 0) return v;
  const auto leading = std::find_if(v.begin(), v.end(), [](const Whole& x) { return x != 0; });
  if (*leading < 0) factor = -factor;
  return {v[0] / factor, v[1] / factor, v[2] / factor};
}

using Directions = std::set<WholePoint>;

Directions directions_between(const std::vector<WholePoint>& points) {
  Directions directions;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const WholePoint d = primitive(difference(points[i], points[j]));
      if (!is_zero(d)) directions.insert(d);
    }
  }
  return directions;
}

// Normals of the planes through three points.
void add_normals(const std::vector<WholePoint>& points, Directions& normals) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const WholePoint normal = primitive(cross(difference(points[j], points[i]), difference(points[k], points[i])));
        if (!is_zero(normal)) normals.insert(normal);
      }
    }
  }
}

// What the difference of the hulls spans: directions, and where they span a plane or more, a normal of two of them.
struct Span {
  Directions directions;
  WholePoint normal{};
  int dimension = 0;
};

Span span_of(const Directions& of_a, const Directions& of_b) {
  Span span{of_a, {}, 0};
  span.directions.insert(of_b.begin(), of_b.end());
  if (span.directions.empty()) return span;
  span.dimension = 1;
  if (span.directions.size() == 1) return span;
  span.dimension = 2;  // no two are parallel
  span.normal = primitive(cross(*span.directions.begin(), *std::next(span.directions.begin())));
  for (const WholePoint& d : span.directions) {
    if (inner(d, span.normal) != 0) span.dimension = 3;
  }
  return span;
}

Directions axes_of_flat_difference(const Span& span, const WholePoint& between) {
  Directions axes;
  if (span.dimension == 2) {
    axes.insert(span.normal);
    for (const WholePoint& d : span.directions) axes.insert(primitive(cross(d, span.normal)));
  } else if (span.dimension == 1) {
    const WholePoint& d = *span.directions.begin();
    axes.insert(d);
    axes.insert(primitive(cross(cross(d, between), d)));
  } else {
    axes.insert(primitive(between));
  }
  axes.erase(WholePoint{});
  return axes;
}

}  // namespace

int dimension_of_difference(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b) {
  return span_of(directions_between(a), directions_between(b)).dimension;
}

void for_each_axis(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b,
                   const std::function<bool(const WholePoint& axis)>& take) {
  const Directions of_a = directions_between(a), of_b = directions_between(b);
  const Span span = span_of(of_a, of_b);
  Directions axes;
  if (span.dimension < 3) {
    axes = axes_of_flat_difference(span, difference(a[0], b[0]));
  } else {
    add_normals(a, axes);
    add_normals(b, axes);
  }
  for (const WholePoint& axis : axes) {
    if (!take(axis)) return;
  }
  if (span.dimension < 3) return;
  for (const WholePoint& along_a : of_a) {
    for (const WholePoint& along_b : of_b) {
      const WholePoint axis = cross(along_a, along_b);
      if (!is_zero(axis) && !take(axis)) return;
    }
  }
}

Extent extent_along(const WholePoint& axis, const std::vector<WholePoint>& points) {
  Extent extent{inner(axis, points[0]), inner(axis, points[0])};
  for (const WholePoint& p : points) {
    const Whole height = inner(axis, p);
    if (height < extent.least) extent.least = height;
    if (height > extent.largest) extent.largest = height;
  }
  return extent;
}

}  // namespace vex::exact

namespace vex {
namespace {

std::vector<exact::Point> exact_points(std::span<const Vec3d> points) {
  std::vector<exact::Point> result;
  for (const Vec3d& p : points) result.push_back(exact::exactly(p));
  return result;
}

std::vector<exact::WholePoint> numerators(const std::vector<exact::Point>& points) {
  std::vector<exact::WholePoint> result;
  for (const exact::Point& p : points) result.push_back({numerator(p[0]), numerator(p[1]), numerator(p[2])});
  return result;
}

}  // namespace

Outcome exact_axes_outcome(std::span<const Vec3d> a, std::span<const Vec3d> placed_b) {
  VEX_EXPECT(!a.empty() && !placed_b.empty());
  std::vector<exact::Point> exact_a = exact_points(a), exact_b = exact_points(placed_b);
  exact::make_whole(exact_a, exact_b);
  const std::vector<exact::WholePoint> whole_a = numerators(exact_a), whole_b = numerators(exact_b);
  bool separated = false;
  exact::for_each_axis(whole_a, whole_b, [&](const exact::WholePoint& axis) {
    const exact::Extent of_a = exact::extent_along(axis, whole_a), of_b = exact::extent_along(axis, whole_b);
    separated = of_a.largest < of_b.least || of_b.largest < of_a.least;
    return !separated;
  });
  return separated ? Outcome::disjoint : Outcome::overlap;
}

}  // namespace vex
