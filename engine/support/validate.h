// Whether a support mapping keeps what it promises: for whoever brings a body of his own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/support/convex_body.h"

namespace vex {

struct ValidationSettings {
  std::size_t n_directions = 1000;  // at random, and up to three times as many hard ones; all are compared pairwise
  std::uint64_t seed = 1;
};

struct Violation {
  enum class Claim : std::uint8_t {
    finite_points,  // a support point is finite
    convexity,      // support points of other directions are no farther: s is the mapping of some convex body
    support_error,  // what the exact form says is no farther than that
    scale,          // the length of a direction does not matter
    centre,
    circumradius,
    inradius,
    ball_part,       // support is the core's with the ball
    generators,      // the core is their sum
    power_form,      // the core is that superellipsoid
    profile_form,    // the core has that outline
    rolling_radius,  // the core is another convex body with such a ball about each point
  };
  Claim claim;
  Vec3d dir;         // where it is broken most
  double by;         // how far beyond what is claimed, a length
  std::string text;  // "the circumradius is too small (...) - ..."
};

/// Asks the body along random directions, along axes and diagonals, along the normals of the faces and edges that its
/// support points span and as near beside them as doubles are, and compares what it says with what it claims
/// (support_mapping.h), in twice the precision. One violation a claim, the worst. Nothing is proven by an empty list;
/// whatever is in the list is wrong. A query of a body that breaks a claim may be wrong and say that it is proven.
/// Throws UsageError for no directions.
std::vector<Violation> validate(const ConvexBody& body, const ValidationSettings& settings = {});

}  // namespace vex
