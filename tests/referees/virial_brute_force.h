// The third virial coefficient of three bodies from nothing but hits and misses: a referee of engine/sampling/virial,
// with which it shares no code but `overlap`.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

#include "engine/query/overlap.h"
#include "engine/sampling/estimate.h"

namespace vex {

/// A rotation of its own for each body.
using RandomTurn = std::function<Transformd(std::mt19937_64&)>;

/// Rz(phi) Ry(theta) Rz(psi), phi and psi uniform, by its columns; no translation.
inline Transformd turn_with_cosine(double cos_theta, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  const double sin_theta = std::sqrt(std::fmax(0.0, 1.0 - cos_theta * cos_theta)), phi = angle(random),
               psi = angle(random);
  const Vec3d along{sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
  const Vec3d down{cos_theta * std::cos(phi), cos_theta * std::sin(phi), -sin_theta};
  const Vec3d across = cross(along, down);
  const Vec3d x = std::cos(psi) * down + std::sin(psi) * across, y = cross(along, x);
  return {{x.x, y.x, along.x}, {x.y, y.y, along.y}, {x.z, y.z, along.z}, {}};
}

inline Transformd uniform_turn(std::mt19937_64& random) {
  return turn_with_cosine(std::uniform_real_distribution<double>(-1.0, 1.0)(random), random);
}

/// The axis by the density cosh(alpha cos(theta)), by rejection.
inline RandomTurn onsager_turn(double alpha) {
  return [alpha](std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double cos_theta = 0.0;
    do {
      cos_theta = 2.0 * uniform(random) - 1.0;
    } while (uniform(random) * std::cosh(alpha) > std::cosh(alpha * cos_theta));
    return turn_with_cosine(cos_theta, random);
  };
}

/// B_ijk, length^6: bodies j and k anywhere in balls about i, each turned on its own, each pair asked for by `overlap`.
/// Nothing of chains, domains or weights.
inline VolumeEstimate third_virial_by_brute_force(const std::array<ConvexBody, 3>& bodies, std::uint64_t n,
                                                  std::uint64_t seed = 11, const RandomTurn& turn = uniform_turn) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto radius_of = [&bodies](std::size_t k) { return bodies[0].circumradius() + bodies[k].circumradius(); };
  // With its centre in the ball about the world's origin.
  const auto placed = [&](std::size_t k, double radius) {
    Transformd world_from_body = turn(random);
    Vec3d place{};
    do {
      place = radius * Vec3d{uniform(random), uniform(random), uniform(random)};
    } while (dot(place, place) > radius * radius);
    world_from_body.translation = place - world_from_body(bodies[k].centre());
    return world_from_body;
  };
  const auto meet = [&bodies](std::size_t i, const Transformd& a, std::size_t j, const Transformd& b) {
    const auto row = [&b](double x, double y, double z) { return x * b.row_x + y * b.row_y + z * b.row_z; };
    const Transformd a_from_b{row(a.row_x.x, a.row_y.x, a.row_z.x), row(a.row_x.y, a.row_y.y, a.row_z.y),
                              row(a.row_x.z, a.row_y.z, a.row_z.z), a.direction_to_b(b.translation - a.translation)};
    return overlap(bodies[i], bodies[j], Pose::unchecked(a_from_b)).outcome == Outcome::overlap;
  };
  std::uint64_t n_hits = 0;
  for (std::uint64_t trial = 0; trial < n; ++trial) {
    const Transformd i = placed(0, 0.0), j = placed(1, radius_of(1));
    if (!meet(0, i, 1, j)) continue;
    const Transformd k = placed(2, radius_of(2));
    if (meet(0, i, 2, k) && meet(1, j, 2, k)) ++n_hits;
  }
  const auto ball = [](double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; };
  const double volume = ball(radius_of(1)) * ball(radius_of(2)) / 3.0;
  const double p = static_cast<double>(n_hits) / static_cast<double>(n);
  return {volume * p, volume * std::sqrt(p * (1.0 - p) / static_cast<double>(n)), {}};
}

}  // namespace vex
