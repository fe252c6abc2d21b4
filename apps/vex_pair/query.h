// What vex_pair asks of each pose.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "engine/numeric/vec3.h"

namespace vex {

enum class Query : std::uint8_t { overlap, distance, depth, signed_distance, ray, cast, time_of_impact, manifold };
inline constexpr std::array kQueries = {Query::overlap, Query::distance, Query::depth,          Query::signed_distance,
                                        Query::ray,     Query::cast,     Query::time_of_impact, Query::manifold};

/// As --query has it.
constexpr std::string_view name_of(Query query) {
  switch (query) {
    case Query::overlap: return "overlap";
    case Query::distance: return "distance";
    case Query::depth: return "depth";
    case Query::signed_distance: return "signed";
    case Query::ray: return "ray";
    case Query::cast: return "cast";
    case Query::time_of_impact: return "toi";
    case Query::manifold: break;
  }
  return "manifold";
}

/// Something moves until it meets something; else the bodies stay where they are.
constexpr bool is_of_motion(Query query) {
  return query == Query::ray || query == Query::cast || query == Query::time_of_impact;
}

/// The answer is a distance or a depth, as the case is.
constexpr bool is_of_either_sign(Query query) { return query == Query::signed_distance || query == Query::manifold; }

/// The largest coordinate of a translation, a ray or a motion where the answer is a number, so that sums of a few of
/// them are finite. An overlap is decided at any.
inline constexpr double kFarthest = 1e300;

struct QuerySettings {
  Query query = Query::overlap;
  Vec3d ray_origin;                              // in A's frame, as all below
  Vec3d velocity;                                // of the ray, or of B: what happens in a unit of time
  Vec3d angular_velocity_degrees;                // of B about its origin
  Vec3d velocity_a, angular_velocity_a_degrees;  // of A, where it moves as well
  double margin = 0.0;                           // a gap up to this counts as contact
  bool four_at_most = false;                     // of a manifold's contacts
  double until = HUGE_VAL;                       // the last time, or parameter, of a motion that is looked at
  double max_distance = HUGE_VAL;                // larger distances need not be known
  bool with_certificate = false;                 // what is answered is proven again
};

}  // namespace vex
