// The third virial coefficient of three bodies from nothing but hits and misses: a referee of engine/sampling/virial,
// with which it shares no code but the drawing of single poses and `overlap`.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/query/overlap.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/estimate.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {

/// B_ijk, length^6: bodies j and k anywhere in balls about i, turned at random by the driver's own poses,
// each pair asked for by `overlap`. Nothing of chains, domains or weights.
inline VolumeEstimate third_virial_by_brute_force(const std::array<ConvexBody, 3>& bodies, std::uint64_t n,
                                                  std::uint64_t seed = 11) {
  const std::array<Domain, 2> domains = {ball_domain(bodies[0], bodies[1]), ball_domain(bodies[0], bodies[2])};
  const OrientationLaw law;
  const PoseSampler of_j(bodies[0], bodies[1], seed, law, domains[0]),
      of_k(bodies[0], bodies[2], seed + 1, law, domains[1]);
  std::uint64_t n_hits = 0;
  for (std::uint64_t trial = 0; trial < n; ++trial) {
    const Transformd j = of_j(trial).a_from_b, k = of_k(trial).a_from_b;
    const auto meet = [](const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
      return overlap(a, b, Pose::unchecked(pose)).outcome == Outcome::overlap;
    };
    if (!meet(bodies[0], bodies[1], j) || !meet(bodies[0], bodies[2], k)) continue;
    Transformd j_from_k;
    const auto row = [&](double x, double y, double z) { return x * k.row_x + y * k.row_y + z * k.row_z; };
    j_from_k.row_x = row(j.row_x.x, j.row_y.x, j.row_z.x);
    j_from_k.row_y = row(j.row_x.y, j.row_y.y, j.row_z.y);
    j_from_k.row_z = row(j.row_x.z, j.row_y.z, j.row_z.z);
    j_from_k.translation = j.direction_to_b(k.translation - j.translation);
    if (meet(bodies[1], bodies[2], j_from_k)) ++n_hits;
  }
  const double volume = domains[0].volume * domains[1].volume / 3.0;
  const double p = static_cast<double>(n_hits) / static_cast<double>(n);
  return {volume * p, volume * std::sqrt(p * (1.0 - p) / static_cast<double>(n)), {}};
}

}  // namespace vex
