// At which densities a fluid of hard bodies becomes nematic: the theories of shapes/nematic with V_ex(gamma) of the
// bodies themselves, a Legendre series from their measures on normals. What aligns is the z axis of a body; its spin
// about that is averaged over. Of V_ex(gamma) the even part counts, as for fluids with as many axes up as down.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "shapes/body.h"
#include "shapes/nematic/coexistence.h"
#include "shapes/nematic/mixture.h"

namespace vex {

struct NematicTransition {
  double excluded_volume = 0.0;  // <V_ex> of random orientations, length^3
  double volume = 0.0;           // of a body, length^3
  NematicFluid fluid{};
  CoexistenceResult result{};
  std::vector<std::string> notes{};  // what a reader should know of the body or of the numbers

  /// Of one of its fluids: in length^-3, the volume fraction NaN of flat bodies.
  double number_density(const NematicPhase& phase) const { return phase.reduced_density / (0.5 * excluded_volume); }
  double volume_fraction(const NematicPhase& phase) const {
    return volume > 0.0 ? number_density(phase) * volume : std::nan("");
  }
  /// P / kT, length^-3
  double pressure(const NematicPhase& phase) const { return phase.pressure / (0.5 * excluded_volume); }
};

/// The isotropic and the nematic fluid of this body that are in equilibrium; `trial_function`: by Onsager's, and not
/// by the density that minimises. Throws InputError where V_ex(gamma) is 0, overflows, or would take too long;
/// UsageError where a body has no measures on normals, or the theory is about volumes and the body is flat.
NematicTransition nematic_transition(const Body& body, NematicTheory theory = NematicTheory::onsager,
                                     bool trial_function = false);

struct MixtureTransition {
  NematicMixture mixture{};
  MixtureResult result{};

  /// The share of space that both kinds take; NaN where one is flat.
  double volume_fraction(const MixturePhase& phase) const;
  /// n <V_ex> / 2, <V_ex> the mean over all pairs of the fluid.
  double reduced_density(const MixturePhase& phase) const;
};

/// The same of fluids of two kinds, at shares of `b` in the number of bodies of the isotropic fluid that ascend from 0
/// to 1 (`coexistence_of_mixture`).
MixtureTransition mixture_transition(const Body& a, const Body& b, const std::vector<double>& compositions,
                                     NematicTheory theory = NematicTheory::onsager);

}  // namespace vex
