// The isotropic and the nematic fluid of two kinds of hard bodies that are in equilibrium with each other: H. N. W.
// Lekkerkerker, P. Coulon, R. van der Haegen, R. Deblieck, J. Chem. Phys. 80, 3427 (1984), for any two bodies.
//
// Free energy of a unit of volume, in kT, with the densities n_i of both kinds and b_ij = <V_ex,ij> / 2:
//   sum of n_i (ln n_i + sigma_i - 1) + G(eta) sum over i and j of n_i n_j b_ij e_ij,
// sigma and e_ij of the two densities of orientations, e_ij = sum of k_l^ij <P_l>_i <P_l>_j; G is 1 in Onsager's
// theory, and Parsons' and Lee's factor of the volume fraction of both (coexistence.h). The densities of orientations
// are those of least free energy, on a grid; pressure and chemical potentials follow by differentiation.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "shapes/nematic/coexistence.h"

namespace vex {

/// Two kinds of bodies, as the theory sees them.
struct NematicMixture {
  struct Pair {
    EvenSeries series;           // of V_ex(gamma) / <V_ex>
    double excluded_volume = 0;  // <V_ex>, length^3, above 0
  };
  Pair aa, ab, bb;
  std::array<double, 2> volumes{};  // length^3; used by Parsons and Lee alone, and then above 0
  NematicTheory theory = NematicTheory::onsager;
};

/// A fluid of both.
struct MixturePhase {
  std::array<double, 2> number_densities{};     // 1 / length^3
  double pressure = 0.0;                        // P / kT, 1 / length^3
  std::array<double, 2> chemical_potentials{};  // mu / kT, of which an ideal gas has the ln of its density times b_aa
  std::array<double, 2> order_parameters{};     // <P_2>

  double number_density() const { return number_densities[0] + number_densities[1]; }
  /// Share of B in the number.
  double composition() const { return number_densities[1] / number_density(); }
};

/// Of these densities. `start`: from which order of both the iteration begins; nothing where it does not converge.
std::optional<MixturePhase> mixture_phase(const NematicMixture& mixture, std::array<double, 2> number_densities,
                                          bool is_ordered);

struct MixtureCoexistence {
  double composition = 0.0;  // of the isotropic fluid, as it was asked for
  MixturePhase isotropic, nematic;
  /// The largest relative difference of the two pressures and of the two chemical potentials.
  double residual = 0.0;
};

/// An isotropic fluid and two nematic ones, all three in equilibrium.
struct ThreeFluids {
  MixturePhase isotropic;
  std::array<MixturePhase, 2> nematic;  // the one with less of B first
};

struct MixtureResult {
  std::vector<MixtureCoexistence> found;  // as far as the branch was followed
  std::vector<ThreeFluids> three;         // of bodies that are unlike enough; from there on two nematic fluids exist
  std::string reason;                     // why not to the end
};

/// For each share of B in the isotropic fluid, ascending from 0 to 1: a branch of equilibria that begins at the fluid
/// of A alone and is followed to that of B alone, with Newton's method. Where the branch
/// turns back there are several at one share, and the one of the least dense isotropic fluid is given: it is the first
/// that a fluid which grows denser meets. Shares of 0 and 1 stand for at most 1e-7 of the other kind in both fluids,
/// which changes them by as little. Equal pressures and chemical potentials to 1e-9 of their size. Equilibria of two
/// nematic fluids without an isotropic one are not looked for.
MixtureResult coexistence_of_mixture(const NematicMixture& mixture, const std::vector<double>& compositions);

}  // namespace vex
