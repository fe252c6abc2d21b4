// The sampling domain of hit-or-miss: a set that contains every position of B's centre at which B can meet A.
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/numeric/vec3.h"
#include "engine/support/convex_body.h"

namespace vex {

struct Domain {
  enum class Kind : std::uint8_t { ball, box };

  Kind kind = Kind::ball;
  Vec3d middle;       // in A's frame
  double radius = 0;  // of a ball
  Vec3d half_extent;  // of a box
  double volume = 0;  // length^3
};

constexpr std::string_view name_of(Domain::Kind kind) { return kind == Domain::Kind::ball ? "ball" : "box"; }

/// The ball about A's centre of the sum of the circumradii.
Domain ball_domain(const ConvexBody& a, const ConvexBody& b);

/// A's bounding box along its own axes, widened on every side by B's circumradius.
Domain box_domain(const ConvexBody& a, const ConvexBody& b);

/// Whether A - B has no volume where B is not turned, because both bodies lie in planes across the same axis: parallel
/// plates, or needles, which can only touch. Looks along x, y and z, which is where flat bodies of vex::shapes have
/// their planes.
bool aligned_difference_is_flat(const ConvexBody& a, const ConvexBody& b);

/// Whether every trial hits by construction: two balls about their centres (to rounding, as a rounded ball is), in the
/// ball of their radii.
bool hits_by_construction(const ConvexBody& a, const ConvexBody& b, const Domain& domain);

/// The one of smaller volume; but the box where both bodies are nearly balls, and fewer than one trial in 1000 would
/// miss in the ball.
Domain best_domain(const ConvexBody& a, const ConvexBody& b);

}  // namespace vex
