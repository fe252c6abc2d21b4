// What directions and witnesses of certificates prove of a placed pair: the steps that the checkers share.
#pragma once

#include <span>
#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/checker/exact_pair.h"

namespace vex::checker {

/// The bodies are apart by `distance` at least along `dir`; in each other, where that is negative, by no more than
/// minus that. False where the direction is 0 or not finite.
bool is_apart_by(const ExactPair& pair, const ExactVector& dir, const whole::Dyadic& distance);

/// The bodies are apart by no more than `distance`; where it is negative, in each other by minus that at least.
bool comes_as_near_as(const ExactPair& pair, const WitnessHull& hull, const whole::Dyadic& distance);

/// The same of points of A - B without the balls, all of them off by less than `margin`.
bool comes_as_near_as(const std::vector<whole::DyadicVector>& core_points,
                      std::span<const std::array<std::uint32_t, 3>> faces, const whole::Dyadic& radii,
                      const whole::Dyadic& margin, const whole::Dyadic& distance);

/// A point, in A's frame, is no farther than `distance` from the body; the hull of the witnesses' points shows it.
bool is_near_a(const ExactPair& pair, const std::vector<Witness>& witnesses, const whole::DyadicVector& point,
               const whole::Dyadic& distance);
bool is_near_b(const ExactPair& pair, const std::vector<Witness>& witnesses, const whole::DyadicVector& point,
               const whole::Dyadic& distance);

bool are_finite(const std::vector<Witness>& witnesses);
bool is_finite(const ExactVector& vector);

}  // namespace vex::checker
