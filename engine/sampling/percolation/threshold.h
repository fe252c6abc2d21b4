// The percolation threshold of one size of the periodic cube, from realisations.
//
// Of a random number of bodies with the mean lambda (Poisson's law: bodies at a fixed density), R(lambda) is the
// probability that a cluster wraps. At the threshold it tends, for large cubes, to a value that is the same for all
// bodies. Where R of realisations has that value is an estimate of the threshold whose offset vanishes fast with the
// size.
//
// M. E. J. Newman and R. M. Ziff, Phys. Rev. E 64, 016706 (2001); S. Mertens and C. Moore, Phys. Rev. E 86, 061109
// (2012) for a Poisson number of bodies. Universal values: J. Wang, Z. Zhou, W. Zhang, T. M. Garoni and Y. Deng, Phys.
// Rev. E 87, 052107 (2013).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/sampling/percolation/realisation.h"

namespace vex {

enum class WrappingCriterion : std::uint8_t {
  x,    // along one axis; the mean of the three
  any,  // along at least one
  all,  // along each of the three
};
inline constexpr std::size_t kNWrappingCriteria = 3;
std::string_view name_of(WrappingCriterion criterion);

/// Of a cubic torus at the threshold.
struct UniversalProbability {
  double value, std_error;
};
UniversalProbability universal_probability(WrappingCriterion criterion);

/// R(lambda), of numbers of bodies with which clusters wrapped; lambda above 0.
double wrapping_probability(std::span<const WrappingNumbers> realisations, WrappingCriterion criterion, double lambda);

/// The mean numbers of bodies at which R is the universal value.
struct SizeThreshold {
  std::array<double, kNWrappingCriteria> lambda{};
  /// Covariance of those among the criteria, from the scatter of the realisations. It is that of their means.
  std::array<std::array<double, kNWrappingCriteria>, kNWrappingCriteria> covariance{};
  /// By how much the uncertainty of the universal value moves each of them, the same way in every run.
  std::array<double, kNWrappingCriteria> universal_error{};
};

/// With fewer the covariance of the criteria is not known well enough for a fit.
inline constexpr std::size_t kFewestRealisations = 50;
/// Throws UsageError where there are fewer.
void require_realisations(std::size_t n);

/// Of kFewestRealisations or more; throws UsageError. The covariance allows for how few they are.
SizeThreshold size_threshold(std::span<const WrappingNumbers> realisations);

}  // namespace vex
