#include "shapes/nematic/coexistence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

using std::numbers::pi;

/// |sin gamma| over its mean pi / 4: its coefficients are -pi (4 n + 1) (2 n - 3)!! (2 n - 1)!! / (2^(2 n + 2) n! (n +
/// 1)!) (R. F. Kayser, H. J. Raveche, Phys. Rev. A 17, 2067, 1978).
EvenSeries needles() {
  EvenSeries series = {1.0};
  double factor = 1.0 / 32.0;  // without 4 n + 1, of n = 1
  for (int n = 1; n <= 128; ++n) {
    if (n > 1) factor *= (2.0 * n - 3.0) * (2.0 * n - 1.0) / (4.0 * n * (n + 1.0));
    series.push_back(-4.0 * (4.0 * n + 1.0) * factor);
  }
  return series;
}

NematicFluid fluid_of(const char* text, NematicTheory theory) {
  const Body body = parse_shape(text);
  const LegendreSeries series = excluded_volume_series(body, body, 256).value();
  NematicFluid fluid;
  for (std::size_t l = 0; l < series.size(); l += 2) fluid.series.push_back(series[l] / series[0]);
  fluid.volume_by_b2 = 2.0 * body.measures.volume / series[0];
  fluid.theory = theory;
  return fluid;
}

TEST(Needles, HaveTheSeriesThatIsTheSine) {
  // The series is the sine again, and the first of them are known.
  const EvenSeries series = needles();
  EXPECT_NEAR(series[1], -5.0 / 8.0, 1e-15);
  EXPECT_NEAR(series[2], -9.0 / 64.0, 1e-15);
  double sum = 0.0;
  for (const double k : series) sum += k;  // at gamma = 0, where |sin| is 0: as slowly as 1 / n
  EXPECT_NEAR(sum, 0.0, 0.01);
}

TEST(Needles, CoexistAsInTheLiterature) {
  // H. N. W. Lekkerkerker, P. Coulon, R. van der Haegen, R. Deblieck, J. Chem. Phys. 80, 3427 (1984).
  const CoexistenceResult result = coexistence({needles()});
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(result.found->isotropic.reduced_density, 3.290, 1e-3);
  EXPECT_NEAR(result.found->nematic.reduced_density, 4.191, 1e-3);
  EXPECT_NEAR(result.found->nematic.order_parameter, 0.792, 1e-3);
  EXPECT_LT(result.found->grid_error, 1e-10);
  EXPECT_NEAR(result.found->isotropic.pressure, result.found->nematic.pressure, 1e-11);
  EXPECT_NEAR(result.found->isotropic.chemical_potential, result.found->nematic.chemical_potential, 1e-11);
}

TEST(Needles, CoexistByTheTrialFunctionAsOnsagerFound) {
  NematicFluid fluid{needles()};
  fluid.trial_function = true;
  const CoexistenceResult result = coexistence(fluid);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_NEAR(result.found->isotropic.reduced_density, 3.340, 1e-3);
  EXPECT_NEAR(result.found->nematic.reduced_density, 4.486, 1e-3);
  EXPECT_NEAR(result.found->nematic.order_parameter, 0.848, 1e-3);
}

TEST(Needles, ArePrecededByThinRods) {
  const Coexistence needle = coexistence({needles()}).found.value();
  double off_before = 1.0;
  for (const char* text : {"capsule:100,0.5", "capsule:1e4,0.5", "capsule:1e6,0.5"}) {
    const Coexistence rod = coexistence(fluid_of(text, NematicTheory::onsager)).found.value();
    const double off = std::fabs(rod.nematic.reduced_density - needle.nematic.reduced_density);
    EXPECT_LT(off, 0.1 * off_before) << text;
    off_before = off;
  }
  EXPECT_LT(off_before, 1e-4);
}

TEST(ParsonsLee, TendsToOnsagersTheoryForThinRods) {
  const Coexistence one = coexistence(fluid_of("cylinder:1e5,0.5", NematicTheory::onsager)).found.value();
  const Coexistence other = coexistence(fluid_of("cylinder:1e5,0.5", NematicTheory::parsons_lee)).found.value();
  EXPECT_NEAR(one.isotropic.reduced_density, other.isotropic.reduced_density, 1e-3);
  EXPECT_NEAR(one.nematic.reduced_density, other.nematic.reduced_density, 1e-3);
}

TEST(ParsonsLee, IsCarnahanAndStarlingsFluidWhereNothingIsOrdered) {
  const NematicFluid spheres = fluid_of("sphere:0.5", NematicTheory::parsons_lee);
  for (const double eta : {1e-6, 0.1, 0.3, 0.49, 0.7}) {
    const double c = eta / spheres.volume_by_b2;  // c = 4 eta
    EXPECT_NEAR(c, 4.0 * eta, 1e-12);
    const double z = (1.0 + eta + eta * eta - eta * eta * eta) / std::pow(1.0 - eta, 3);
    EXPECT_NEAR(isotropic_phase(spheres, c).pressure, c * z, 1e-12 * c * z);
  }
}

TEST(Pressure, IsTheDensityTimesTheSlopeOfTheChemicalPotential) {
  // Gibbs and Duhem: dP = n dmu, along the isotherm of the density that minimises.
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    const NematicFluid fluid = fluid_of("cylinder:10,0.5", theory);
    const std::vector<NematicPhase> branch = coexistence(fluid).found.value().branch;
    ASSERT_GT(branch.size(), 20u);
    for (std::size_t k = 1; k + 1 < branch.size(); k += 7) {
      const NematicPhase &before = branch[k - 1], &here = branch[k], &after = branch[k + 1];
      const double slope = (after.pressure - before.pressure) / (after.chemical_potential - before.chemical_potential);
      EXPECT_NEAR(slope, here.reduced_density, 2e-3 * here.reduced_density);
    }
  }
}

TEST(OrientationDensity, IsTheOneOfLeastFreeEnergy) {
  const EvenSeries series = needles();
  const OrientationGrid grid(series);
  constexpr double kCoupling = 4.5;
  const OrientationDensity best = grid.equilibrium(kCoupling, grid.trial(10.0).moments);
  ASSERT_TRUE(best.converged);
  const double least = best.entropy + kCoupling * best.interaction;
  for (const double alpha : {5.0, 15.0, 20.0, 22.0, 30.0}) {
    const OrientationDensity other = grid.trial(alpha);
    EXPECT_GT(other.entropy + kCoupling * other.interaction, least + 1e-4) << alpha;
  }
  EXPECT_GT(0.0 + kCoupling, least);  // the isotropic one
}

TEST(OrientationDensity, OfTheTrialFunctionHasOnsagersClosedForms) {
  const OrientationGrid grid(needles());
  for (const double alpha : {0.5, 5.0, 18.58, 40.0}) {
    const OrientationDensity density = grid.trial(alpha);
    const double entropy = std::log(alpha / std::tanh(alpha)) - 1.0 + std::atan(std::sinh(alpha)) / std::sinh(alpha);
    EXPECT_NEAR(density.entropy, entropy, 1e-12);
    EXPECT_NEAR(density.order_parameter(), 1.0 - 3.0 / (alpha * std::tanh(alpha)) + 3.0 / (alpha * alpha), 1e-12);
  }
}

TEST(Coexistence, IsNoneWhereNothingAligns) {
  for (const char* text : {"sphere:1", "box:1,1,1", "octahedron:1"}) {
    const CoexistenceResult result = coexistence(fluid_of(text, NematicTheory::onsager));
    EXPECT_FALSE(result.found) << text;
    EXPECT_NE(result.reason.find("nothing makes them align"), std::string::npos);
  }
  EXPECT_THROW(coexistence(fluid_of("disc:1", NematicTheory::parsons_lee)), UsageError);
}

TEST(Coexistence, IsFoundForBodiesOfAllKinds) {
  for (const NematicTheory theory : {NematicTheory::onsager, NematicTheory::parsons_lee}) {
    for (const char* text :
         {"cylinder:0.1,1", "ellipsoid:1,1,1.2", "cone:5,0.5", "hemisphere:1", "rounded:0.1,box:1,1,4"}) {
      const CoexistenceResult result = coexistence(fluid_of(text, theory));
      ASSERT_TRUE(result.found) << text << ": " << result.reason;
      EXPECT_LT(result.found->isotropic.reduced_density, result.found->nematic.reduced_density) << text;
      EXPECT_GT(result.found->nematic.order_parameter, 0.3) << text;
      EXPECT_LT(result.found->grid_error, 1e-8) << text;
    }
  }
}

TEST(ExcludedVolumeSeries, BeginsWithTheFormulaAndHasOddTermsWhereEndsDiffer) {
  const Body a = parse_shape("frustum:2,1,0.5"), b = parse_shape("cone:1,0.5");
  const LegendreSeries series = excluded_volume_series(a, b, 64).value();
  EXPECT_NEAR(series[0],
              a.measures.volume + b.measures.volume + a.measures.mean_radius() * b.measures.surface_area +
                  b.measures.mean_radius() * a.measures.surface_area,
              1e-10 * series[0]);
  EXPECT_GT(std::fabs(series[3]), 1e-6 * series[0]) << "of both bodies the ends differ";
}

}  // namespace
}  // namespace vex
