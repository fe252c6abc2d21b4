// Do two polytopes of few vertices share a point? By every axis that could separate them, in whole numbers: no descent,
// no simplex, nothing that is kept from one axis to the next.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/query/verdict.h"

namespace vex::exact {

using Whole = boost::multiprecision::cpp_int;
using WholePoint = std::array<Whole, 3>;

inline Whole inner(const WholePoint& a, const WholePoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Dimension of the difference conv(a) - conv(b), 0 to 3.
int dimension_of_difference(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b);

/// Calls `take` with axes, none of them zero, until it returns false. If the hulls are disjoint, one of the axes or its
/// opposite separates them. If the difference K of the hulls has volume, the normals of all faces of K are among them.
///
/// K with volume: a face of K is the difference of the parts of both hulls that are extreme along its normal, and
/// two-dimensional; so one of them holds three points that are not in line, or both hold two, whose directions differ.
/// Flat K: its normal, or, in its plane, the normals of its sides, each of which is parallel to two points of one hull.
/// K a segment: its direction, and across it towards the origin. K a point: the vector to it.
void for_each_axis(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b,
                   const std::function<bool(const WholePoint& axis)>& take);

/// Least and largest inner product with the points.
struct Extent {
  Whole least, largest;
};
Extent extent_along(const WholePoint& axis, const std::vector<WholePoint>& points);

}  // namespace vex::exact

namespace vex {

/// Overlap, which touching is, or disjoint; never undecided. Takes any two sets of one or more finite points, flat, in
/// line or repeated ones too. For few: the axes are as many as pairs of pairs, 3 ms for two cubes, seconds for twice 30
/// points.
Outcome exact_axes_outcome(std::span<const Vec3d> a, std::span<const Vec3d> placed_b);

}  // namespace vex
