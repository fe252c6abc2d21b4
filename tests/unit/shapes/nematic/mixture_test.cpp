#include "shapes/nematic/mixture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

NematicMixture::Pair pair_of(const Body& a, const Body& b) {
  const LegendreSeries series = excluded_volume_series(a, b, 256).value();
  NematicMixture::Pair pair;
  pair.excluded_volume = series[0];
  for (std::size_t l = 0; l < series.size(); l += 2) pair.series.push_back(series[l] / series[0]);
  return pair;
}

NematicMixture mixture_of(const char* a_text, const char* b_text, NematicTheory theory) {
  const Body a = parse_shape(a_text), b = parse_shape(b_text);
  return {pair_of(a, a), pair_of(a, b), pair_of(b, b), {a.measures.volume, b.measures.volume}, theory};
}

Coexistence pure(const NematicMixture::Pair& pair, double volume, NematicTheory theory) {
  NematicFluid fluid;
  fluid.series = pair.series;
  fluid.volume_by_b2 = 2.0 * volume / pair.excluded_volume;
  fluid.theory = theory;
  return coexistence(fluid).found.value();
}

TEST(NematicMixture, OfTwoEqualKindsIsOneKind) {
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    const NematicMixture mixture = mixture_of("capsule:20,0.5", "capsule:20,0.5", theory);
    const Coexistence one = pure(mixture.aa, mixture.volumes[0], theory);
    const MixtureResult result = coexistence_of_mixture(mixture, {0.0, 0.3, 0.7, 1.0});
    ASSERT_EQ(result.found.size(), 4u) << result.reason;
    const double b = 0.5 * mixture.aa.excluded_volume;
    for (const MixtureCoexistence& found : result.found) {
      EXPECT_NEAR(found.isotropic.number_density() * b, one.isotropic.reduced_density, 1e-7);
      EXPECT_NEAR(found.nematic.number_density() * b, one.nematic.reduced_density, 1e-7);
      EXPECT_NEAR(found.nematic.composition(), found.isotropic.composition(), 1e-8);
      EXPECT_NEAR(found.nematic.order_parameters[0], one.nematic.order_parameter, 1e-8);
      EXPECT_NEAR(found.nematic.order_parameters[1], one.nematic.order_parameter, 1e-8);
      EXPECT_NEAR(found.nematic.pressure * b, one.nematic.pressure, 1e-6);
    }
  }
}

TEST(NematicMixture, AtItsEndsIsTheOneKindOrTheOther) {
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    const NematicMixture mixture = mixture_of("capsule:20,0.5", "capsule:30,0.5", theory);
    const Coexistence a = pure(mixture.aa, mixture.volumes[0], theory);
    const Coexistence b = pure(mixture.bb, mixture.volumes[1], theory);
    const MixtureResult result = coexistence_of_mixture(mixture, {0.0, 1.0});
    ASSERT_EQ(result.found.size(), 2u) << result.reason;
    for (const auto& [found, one, excluded] : {std::tuple{result.found[0], a, mixture.aa.excluded_volume},
                                               std::tuple{result.found[1], b, mixture.bb.excluded_volume}}) {
      EXPECT_NEAR(0.5 * excluded * found.isotropic.number_density(), one.isotropic.reduced_density, 1e-5);
      EXPECT_NEAR(0.5 * excluded * found.nematic.number_density(), one.nematic.reduced_density, 1e-5);
    }
    EXPECT_NEAR(result.found[0].nematic.order_parameters[0], a.nematic.order_parameter, 1e-6);
    EXPECT_NEAR(result.found[1].nematic.order_parameters[1], b.nematic.order_parameter, 1e-6);
  }
}

TEST(NematicMixture, AlongTheBranchPressureAndPotentialsObeyGibbsAndDuhem) {
  // n_A dmu_A + n_B dmu_B = dP in each fluid: of the free energy that both follow from, checked by differences.
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    const NematicMixture mixture = mixture_of("cylinder:10,0.5", "cylinder:20,0.5", theory);
    const double step = 1e-3;
    const MixtureResult result = coexistence_of_mixture(mixture, {0.3 - step, 0.3, 0.3 + step});
    ASSERT_EQ(result.found.size(), 3u) << result.reason;
    for (const MixtureCoexistence& found : result.found) EXPECT_LT(found.residual, 1e-9);
    const auto difference = [&](const auto& of) { return of(result.found[2]) - of(result.found[0]); };
    const double pressure = difference([](const MixtureCoexistence& at) { return at.nematic.pressure; });
    for (const bool is_nematic : {false, true}) {
      const MixturePhase& middle = is_nematic ? result.found[1].nematic : result.found[1].isotropic;
      double sum = 0.0;
      for (const std::size_t kind : {0u, 1u}) {
        sum += middle.number_densities[kind] * difference([&](const MixtureCoexistence& at) {
                 return (is_nematic ? at.nematic : at.isotropic).chemical_potentials[kind];
               });
      }
      EXPECT_NEAR(sum, pressure, 1e-4 * std::fabs(pressure));
    }
    EXPECT_GT(result.found[1].nematic.composition(), 0.35) << "the longer rods order first";
    EXPECT_GT(result.found[1].nematic.order_parameters[1], result.found[1].nematic.order_parameters[0]);
  }
}

TEST(NematicMixture, OfUnlikeRodsHasTwoNematicFluidsBesideAnIsotropicOne) {
  const NematicMixture mixture = mixture_of("capsule:1000,0.5", "capsule:3000,0.5", NematicTheory::onsager);
  // On either side of the three fluids, where the branch has three equilibria, and far from there.
  const MixtureResult result = coexistence_of_mixture(mixture, {0.0, 1.25e-4, 1.27e-4, 0.3, 1.0});
  ASSERT_EQ(result.found.size(), 5u) << result.reason;
  EXPECT_EQ(result.reason, "");
  ASSERT_EQ(result.three.size(), 1u);
  const ThreeFluids& three = result.three.front();
  for (const MixturePhase& nematic : three.nematic) {
    EXPECT_NEAR(nematic.pressure, three.isotropic.pressure, 1e-9 * three.isotropic.pressure);
    const MixturePhase again = mixture_phase(mixture, nematic.number_densities, true).value();
    EXPECT_NEAR(again.pressure, nematic.pressure, 1e-9 * nematic.pressure);
    for (const std::size_t kind : {0u, 1u}) {
      EXPECT_NEAR(nematic.chemical_potentials[kind], three.isotropic.chemical_potentials[kind], 1e-8);
    }
  }
  const double split = three.isotropic.composition();
  EXPECT_GT(split, 1.25e-4);
  EXPECT_LT(split, 1.27e-4);
  EXPECT_LT(result.found[1].nematic.composition(), three.nematic[0].composition());
  EXPECT_GT(result.found[2].nematic.composition(), three.nematic[1].composition());
  EXPECT_GT(result.found[3].nematic.composition(), 0.69);
}

TEST(NematicMixture, OfDiscsAndRodsMayHaveRodsAcross) {
  const MixtureResult result =
      coexistence_of_mixture(mixture_of("disc:1", "capsule:30,0.1", NematicTheory::onsager), {0.0});
  EXPECT_EQ(result.reason.find("more sharply"), std::string::npos) << result.reason;
}

TEST(NematicMixture, GivesNoRowsOfABranchThatItLost) {
  const MixtureResult result = coexistence_of_mixture(
      mixture_of("capsule:1000,0.5", "capsule:10000,0.5", NematicTheory::onsager), {0.0, 1e-6, 0.5});
  EXPECT_NE(result.reason.find("the branch was lost at a share of"), std::string::npos) << result.reason;
  ASSERT_EQ(result.found.size(), 1u) << "of A alone";
  EXPECT_EQ(result.found[0].composition, 0.0);
}

TEST(NematicMixture, PotentialsAreTheSlopesOfTheFreeEnergy) {
  // f = sum n_i mu_i - P; its slope by n_i is mu_i, orientations being those of least free energy.
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    const NematicMixture mixture = mixture_of("cylinder:10,0.5", "cylinder:15,0.4", theory);
    const auto free_energy = [&](double n_a, double n_b) {
      const MixturePhase phase = mixture_phase(mixture, {n_a, n_b}, true).value();
      return n_a * phase.chemical_potentials[0] + n_b * phase.chemical_potentials[1] - phase.pressure;
    };
    const double n_a = 0.03, n_b = 0.03, h = 1e-6;
    const MixturePhase phase = mixture_phase(mixture, {n_a, n_b}, true).value();
    EXPECT_GT(phase.order_parameters[0], 0.5);
    EXPECT_NEAR((free_energy(n_a + h, n_b) - free_energy(n_a - h, n_b)) / (2 * h), phase.chemical_potentials[0], 1e-5);
    EXPECT_NEAR((free_energy(n_a, n_b + h) - free_energy(n_a, n_b - h)) / (2 * h), phase.chemical_potentials[1], 1e-5);
  }
}

TEST(NematicMixture, RefusesWhatItCannotBeAbout) {
  EXPECT_THROW(coexistence_of_mixture(mixture_of("capsule:20,0.5", "disc:1", NematicTheory::parsons_lee), {0.5}),
               UsageError);
  const NematicMixture rods = mixture_of("capsule:20,0.5", "capsule:20,0.5", NematicTheory::onsager);
  EXPECT_THROW(coexistence_of_mixture(rods, {0.5, 0.2}), UsageError);
  EXPECT_THROW(coexistence_of_mixture(rods, {1.5}), UsageError);
  const MixtureResult none =
      coexistence_of_mixture(mixture_of("sphere:1", "capsule:20,0.5", NematicTheory::onsager), {0.5});
  EXPECT_TRUE(none.found.empty());
  EXPECT_NE(none.reason, "");
}

}  // namespace
}  // namespace vex
