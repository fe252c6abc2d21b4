// The isotropic and the nematic fluid of hard bodies that are in equilibrium with each other.
//
// Free energy of a body, in kT: ln c + sigma + C(c) e, with c = n <V_ex> / 2, sigma and e of orientation_density.h.
// - Onsager (Ann. N.Y. Acad. Sci. 51, 627, 1949): C = c, the second virial coefficient alone. Exact for bodies that are
//   infinitely thin.
// - Parsons and Lee (J. D. Parsons, Phys. Rev. A 19, 1225, 1979; S.-D. Lee, J. Chem. Phys. 87, 4972, 1987): C = c G
// with
//   G = (4 - 3 eta) / (4 (1 - eta)^2), eta the volume fraction: all higher coefficients as those of hard spheres have
//   them (Carnahan and Starling).
// Pressure and chemical potential follow by differentiation; f minimises the free energy, so it counts as constant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shapes/nematic/orientation_density.h"

namespace vex {

enum class NematicTheory { onsager, parsons_lee };

/// Bodies of one kind, as the theory sees them.
struct NematicFluid {
  EvenSeries series;          // of V_ex(gamma) / <V_ex>
  double volume_by_b2 = 0.0;  // V / (<V_ex> / 2); used by Parsons and Lee alone, and then above 0
  NematicTheory theory = NematicTheory::onsager;
  bool trial_function = false;  // Onsager's, and not the density that minimises
};

/// A fluid of this density, in units of b = <V_ex> / 2 and kT.
struct NematicPhase {
  double reduced_density = 0.0;          // c = n b
  double pressure = 0.0;                 // P b / kT
  double chemical_potential = 0.0;       // mu / kT, of which an ideal gas with c has ln c
  double order_parameter = 0.0;          // <P_2>
  std::vector<double> cosines, density;  // 4 pi f(theta); empty of an isotropic one
};

/// The isotropic fluid of density c.
NematicPhase isotropic_phase(const NematicFluid& fluid, double reduced_density);

struct Coexistence {
  NematicPhase isotropic, nematic;
  /// The largest relative change of densities, order parameter and pressure from a grid with half of the nodes and
  /// degrees: what is left is far below.
  double grid_error = 0.0;
  /// Nematic fluids of other densities, ascending, some of them not stable: the branch of the isotherm.
  std::vector<NematicPhase> branch;
};

struct CoexistenceResult {
  std::optional<Coexistence> found;
  std::string reason;  // why there is none
};

/// Equal pressure and chemical potential to 1e-12. There is none where aligned axes exclude no less than others do
/// (k_2 >= 0, as of spheres). Throws UsageError where Parsons and Lee's theory has no volume.
CoexistenceResult coexistence(const NematicFluid& fluid);

/// c, and where the isotropic fluid is no longer even metastable: C = -5 / (2 k_2).
double largest_isotropic_coupling(const NematicFluid& fluid);

}  // namespace vex
