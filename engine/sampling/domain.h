// The sampling domain of hit-or-miss: a set that contains every position of B's centre at which B can meet A.
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/numeric/vec3.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/support/convex_body.h"

namespace vex {

struct Domain {
  enum class Kind : std::uint8_t {
    ball,
    box,
    fitted,  // another parallelepiped for each relative orientation (fitted_domain.h)
  };

  Kind kind = Kind::ball;
  Vec3d middle;       // in A's frame
  double radius = 0;  // of a ball
  Vec3d half_extent;  // of a box
  double volume = 0;  // length^3; of a fitted domain the unit in which shares are counted, which no trial's exceeds
};

constexpr std::string_view name_of(Domain::Kind kind) {
  switch (kind) {
    case Domain::Kind::ball: return "ball";
    case Domain::Kind::box: return "box";
    case Domain::Kind::fitted: break;
  }
  return "fitted";
}

/// The ball about A's centre of the sum of the circumradii.
Domain ball_domain(const ConvexBody& a, const ConvexBody& b);

/// A's bounding box along its own axes, widened on every side by B's circumradius.
Domain box_domain(const ConvexBody& a, const ConvexBody& b);

/// Whether A - B has no volume for any orientation of the law but by rounding, because both bodies lie in planes across
/// the same axis: parallel plates, or a needle along a plate, which can only touch. Looks along the bodies' x, y and z,
/// which is where flat bodies of vex::shapes have their planes. Never so for laws that are not of one orientation, or
/// of one about z (cone:0).
bool difference_is_flat(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law);

/// Whether the body is a ball about its centre, to rounding, as a rounded ball is.
bool is_ball(const ConvexBody& body);

/// The one of smaller volume; but the box where both bodies are nearly balls, and fewer than one trial in 1000 would
/// miss in the ball.
Domain best_domain(const ConvexBody& a, const ConvexBody& b);

}  // namespace vex
