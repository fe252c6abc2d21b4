// What the hull of a few points proves about the origin, in exact arithmetic: for the checker of certificates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/numeric/whole.h"

namespace vex::checker {

/// Corners of a triangle, counter-clockwise seen from outside.
using Corners = std::array<std::uint32_t, 3>;

/// A point as numerator / denominator, in the unit of the points it was made of; the denominator is positive.
struct RationalPoint {
  whole::Vector numerator;
  whole::Integer denominator;
  bool is_inside = false;  // the points' convex hull, not only their affine one
};

/// The point of the affine hull of one to three points that is nearest to the origin. False where they are not
/// independent.
bool nearest_of_affine_hull(std::span<const whole::Vector> points, RationalPoint& nearest);

/// Some point of the hull of up to eight points is at most `distance` from the origin; `distance` >= 0. By
/// C. Caratheodory a nearest point is one of at most three of them, or the origin is in the hull of four.
bool comes_within(const std::vector<whole::DyadicVector>& points, const whole::Dyadic& distance);

/// The ball of this radius about the origin lies in the hull of four to twelve points: every facet has the origin
/// behind it by more than that; or, where the radius is 0, does not have it in front.
bool holds_ball(const std::vector<whole::DyadicVector>& points, const whole::Dyadic& radius);

/// The same of any number of points, by a closed surface of triangles that goes around the ball: each edge is that of
/// one other triangle, the other way round, and every triangle has the origin behind its plane by the radius at least,
/// and by more than 0. So the surface winds around every point of the ball, which then is in the points' hull.
bool surrounds_ball(const std::vector<whole::DyadicVector>& points, std::span<const Corners> faces,
                    const whole::Dyadic& radius);

/// All coordinates in one unit, a power of two, which is the result's exponent.
std::vector<whole::Vector> as_whole(const std::vector<whole::DyadicVector>& points, int& exponent);

}  // namespace vex::checker
