// A fluid of two kinds of bodies at given densities: its two densities of orientations, pressure, chemical potentials.
#pragma once

#include <array>
#include <cstddef>

#include "shapes/nematic/mixture.h"
#include "shapes/nematic/orientation_density.h"

namespace vex {

/// Both densities of orientations.
struct BothDensities {
  std::array<OrientationDensity, 2> of;
  bool converged = false;
};

using TwoSeries = std::array<EvenSeries, 2>;
using TwoDensities = std::array<double, 2>;

class MixtureFluid {
 public:
  /// Throws UsageError where a pair excludes nothing, and of flat bodies in the theory of Parsons and Lee.
  explicit MixtureFluid(const NematicMixture& mixture);

  /// <V_ex> / 2
  double b(std::size_t i, std::size_t j) const { return 0.5 * pair(i, j).excluded_volume; }

  /// The fixed point for these densities, by iteration from the moments of `start` (fixed_point.h).
  BothDensities equilibrium(const TwoDensities& n, const TwoSeries& start) const;
  BothDensities isotropic() const;
  EvenSeries start_of_order() const { return grid_.trial(10.0).moments; }

  /// Whether the series ends before the orientations are resolved, by what its last term adds to the mean of V_ex.
  bool is_too_sharp(const BothDensities& both) const;

  MixturePhase phase(const TwoDensities& n, const BothDensities& both) const;

 private:
  /// G, its slope by the volume fraction, and that.
  struct Scaling {
    double factor = 1.0, slope = 0.0, volume_fraction = 0.0;
  };
  Scaling scaling(const TwoDensities& n) const;
  const NematicMixture::Pair& pair(std::size_t i, std::size_t j) const {
    return i != j ? mixture_.ab : (i == 0 ? mixture_.aa : mixture_.bb);
  }
  const EvenSeries& series(std::size_t i, std::size_t j) const { return pair(i, j).series; }
  double interaction(const BothDensities& both, std::size_t i, std::size_t j) const;

  const NematicMixture& mixture_;
  OrientationGrid grid_;
};

}  // namespace vex
