// The threshold of a system that is not isotropic, where the universal probabilities of threshold.h do not hold.
//
// Bodies that are turned alike percolate more easily along one axis than along another: for them a cube is what a box
// of unlike edges is for others, and R at the threshold of a large one is another number for each axis and shape of
// that box. It still does not depend on the size of the cube: curves of R of several sizes cross at the threshold. So R
// at the threshold is fitted, for each criterion, beside the threshold,
//
//   R_c(L, n) = R_c + b_c(L) (n - n_c) + a_c L^-y,
//
// with the slopes b_c(L) of the same realisations, and the leading correction to scaling, of which y = 1.2(2) is known
// and of a_c that it is small. K. Binder, Z. Phys. B 43, 119 (1981) for crossings.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "engine/sampling/percolation/extrapolation.h"

namespace vex {

/// Along x, along y, along z. (Along any or all adds a tenth to what is known, and where one axis is the hardest `all`
/// is that one but for a few realisations, of which no covariance is known.)
inline constexpr std::size_t kNCrossingCriteria = 3;
std::string_view name_of_crossing_criterion(std::size_t criterion);

/// The exponent of the corrections; and how large they are in cubes of kCorrectionSize extents of the largest body, as
/// a standard deviation about 0: a datum of the fit for each criterion. Those of cubes, discs, needles and boxes are
/// below 0.04 there (docs/decisions/0019-percolation.md).
inline constexpr double kCorrectionExponent = 1.2, kCorrectionExponentError = 0.2;
inline constexpr double kCorrectionError = 0.05, kCorrectionSize = 2.0;
/// Of those of two criteria, which one scaling field causes: they mostly have one sign.
inline constexpr double kCorrectionCorrelation = 0.8;

/// All realisations of one size of the cube.
struct SizedRealisations {
  double size = 0.0;  // L, in extents of the largest body
  double volume = 0.0;
  std::span<const WrappingNumbers> realisations;
};

struct Crossing {
  /// `exponent` is y there, as it was known; nothing is universal.
  Extrapolation threshold;
  std::array<double, kNCrossingCriteria> probability{}, probability_std_error{};  // R_c
  /// Where R of a size is R_c, with the scatter of that size alone.
  struct OfSize {
    std::array<double, kNCrossingCriteria> density{}, std_error{};
  };
  std::vector<OfSize> sizes;
};

/// Of two sizes or more, each with kFewestRealisations. Throws UsageError.
Crossing find_crossing(std::span<const SizedRealisations> sizes);

/// R of a criterion of a crossing, as wrapping_probability; lambda above 0.
double crossing_probability(std::span<const WrappingNumbers> realisations, std::size_t criterion, double lambda);

}  // namespace vex
