#include "engine/sampling/virial/virial_integrand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/box.h"
#include "shapes/cone.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "tests/referees/virial_brute_force.h"

namespace vex {
namespace {

VolumeEstimate coefficient(const ConvexBody& body, const OrientationLaw& law, int order, std::uint64_t n_bunches,
                           ClusterWeights::GraphSum sum = biconnected_sum, int n_threads = 1,
                           InstructionSet set = best_instruction_set(), double excluded_volume = std::nan("")) {
  const auto weights = std::make_shared<const ClusterWeights>(order, sum);
  const KnownExcludedVolume known{excluded_volume, 0x1p-40};
  const auto control = VirialIntegrand::control_of(body, law, weights, known, set);
  EXPECT_EQ(control == nullptr, std::isnan(excluded_volume));
  MonteCarloSettings settings;
  settings.n_threads = n_threads;
  settings.stop.trials = n_bunches;
  settings.instruction_set = set;
  settings.integrand = [&] { return std::make_unique<VirialIntegrand>(body, law, weights, set, control, known); };
  const RunRecord record = run_monte_carlo(body, body, settings);
  EXPECT_EQ(record.tally.n_undecided, 0u);
  const VirialPairs pairs = VirialPairs::of(record.tally);
  EXPECT_EQ(pairs.n_all, n_bunches * VirialIntegrand::n_clusters(order) * weights->pairs().size());
  EXPECT_LE(pairs.n_by_balls + pairs.n_searched, pairs.n_all);
  return volume_estimate(record.tally, settings.domain);
}

double z_of(const VolumeEstimate& estimate, double known) {
  return (estimate.excluded_volume - known) / estimate.std_error;
}

constexpr double kB4OfSpheres = 0.28694950598;  // N. Clisby and B. M. McCoy, J. Stat. Phys. 122, 15, 2006

TEST(VirialIntegrand, OfSpheresAndAlignedCubesTheCoefficientsAreTheKnownOnes) {
  const ConvexBody sphere = Sphere(0.5), cube = Box(1.0, 1.0, 1.0);
  EXPECT_LT(std::fabs(z_of(coefficient(sphere, {}, 3, 2048), 0.625)), 4.0);
  EXPECT_LT(std::fabs(z_of(coefficient(sphere, {}, 4, 2048), kB4OfSpheres)), 4.0);
  EXPECT_LT(std::fabs(z_of(coefficient(sphere, {}, 5, 2048), 0.110252)), 4.0);
  EXPECT_LT(std::fabs(z_of(coefficient(cube, OrientationLaw::aligned(), 3, 2048), 9.0 / 16.0)), 4.0);
  EXPECT_LT(std::fabs(z_of(coefficient(cube, OrientationLaw::aligned(), 4, 2048), 34.0 / 3.0 / 64.0)), 4.0);
  // With trees among the clusters.
  EXPECT_LT(std::fabs(z_of(coefficient(sphere, {}, 6, 4096), 0.03888198)), 4.0);
}

// A sheared or stretched body has the coefficients of the body, where all are turned alike.
TEST(VirialIntegrand, AlignedBodiesMayBeStretched) {
  const VolumeEstimate ball = coefficient(Ellipsoid(1.0, 2.0, 5.0), OrientationLaw::aligned(), 4, 1024);
  EXPECT_LT(std::fabs(z_of(ball, kB4OfSpheres)), 4.0);
  const VolumeEstimate box = coefficient(Box(0.1, 2.0, 1.0), OrientationLaw::aligned(), 3, 1024);
  EXPECT_LT(std::fabs(z_of(box, 9.0 / 16.0)), 4.0);
}

TEST(VirialIntegrand, WrongSumsAreFoundOut) {
  const ConvexBody sphere = Sphere(0.5);
  const auto without_rings = [](const OverlapGraph& graph) {
    const std::int64_t sum = biconnected_sum(graph);
    return sum > 0 ? std::int64_t{0} : sum;
  };
  const auto of_sign = [](const OverlapGraph& graph) { return -biconnected_sum(graph); };
  EXPECT_GT(std::fabs(z_of(coefficient(sphere, {}, 4, 2048, without_rings), kB4OfSpheres)), 8.0);
  EXPECT_GT(std::fabs(z_of(coefficient(sphere, {}, 4, 2048, of_sign), kB4OfSpheres)), 8.0);
}

TEST(VirialIntegrand, ThreadsAndInstructionSetsChangeNoBit) {
  const ConvexBody box = Box(1.0, 0.8, 2.0), rod = Ellipsoid(0.2, 0.2, 4.0);
  // <V_ex> of the box, by the formula; the rod has no control variate.
  const double of_box = 2.0 * 1.6 + 2.0 * 8.8 * (3.8 * std::numbers::pi) / (4.0 * std::numbers::pi);
  for (const ConvexBody* const body : {&box, &rod}) {
    const double excluded_volume = body == &box ? of_box : std::nan("");
    for (const int order : {4, 6}) {
      const VolumeEstimate one =
          coefficient(*body, {}, order, 64, biconnected_sum, 1, best_instruction_set(), excluded_volume);
      for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse2, best_instruction_set()}) {
        const VolumeEstimate other = coefficient(*body, {}, order, 64, biconnected_sum, 3, set, excluded_volume);
        EXPECT_EQ(one.excluded_volume, other.excluded_volume) << order << " " << name_of(set);
        EXPECT_EQ(one.std_error, other.std_error);
      }
    }
  }
}

constexpr double kOfSpheres = 4.0 / 3.0 * std::numbers::pi;  // <V_ex>, of the diameter 1
constexpr double kOfCubes = 11.0;                            // in random orientation, of edge 1

TEST(VirialIntegrand, AControlVariateChangesNoMeanAndMuchOfTheVariance) {
  const ConvexBody sphere = Sphere(0.5), cube = Box(1.0, 1.0, 1.0), ellipsoid = Ellipsoid(0.5, 0.5, 0.4);
  struct Case {
    const ConvexBody* body;
    OrientationLaw law;
    int order;
    double excluded_volume, known, least_gain;
  };
  const std::vector<Case> cases = {{&sphere, {}, 3, kOfSpheres, 0.625, 1.3},
                                   {&sphere, {}, 4, kOfSpheres, kB4OfSpheres, 1.1},
                                   {&sphere, {}, 6, kOfSpheres, 0.03888198, 1.0},
                                   {&cube, OrientationLaw::aligned(), 3, 8.0, 9.0 / 16.0, 1.05},
                                   {&cube, {}, 3, kOfCubes, 0.0, 1.2},
                                   {&ellipsoid, OrientationLaw::aligned(), 3, 0.8 * kOfSpheres, 0.625, 1.05}};
  for (const Case& one : cases) {
    const auto with = [&one](double excluded_volume) {
      return coefficient(*one.body, one.law, one.order, 2048, biconnected_sum, 1, best_instruction_set(),
                         excluded_volume);
    };
    const VolumeEstimate plain = with(std::nan("")), found = with(one.excluded_volume);
    EXPECT_GT(plain.std_error, one.least_gain * found.std_error) << one.order;
    if (one.known > 0.0) {
      EXPECT_LT(std::fabs(z_of(found, one.known)), 4.0) << one.order;
    }
    // Of the same poses: less scatter between the two than either has.
    const double apart = std::fabs(found.excluded_volume - plain.excluded_volume);
    EXPECT_LT(apart, 4.0 * std::sqrt(plain.std_error * plain.std_error - found.std_error * found.std_error));
    EXPECT_GT(apart, 0.0);
  }
  // A wrong <V_ex> is found out.
  const VolumeEstimate wrong =
      coefficient(sphere, {}, 3, 2048, biconnected_sum, 1, best_instruction_set(), 1.03 * kOfSpheres);
  EXPECT_GT(std::fabs(z_of(wrong, 0.625)), 8.0);
}

TEST(VirialIntegrand, MixturesAgreeWithBruteForce) {
  const std::array<std::array<ConvexBody, 3>, 2> mixtures = {
      {{Box(1.0, 1.0, 1.0), Sphere(0.7), Box(1.0, 1.0, 1.0)}, {Ellipsoid(1.0, 0.4, 0.4), Cone(1.0, 0.6), Sphere(0.5)}}};
  for (const std::array<ConvexBody, 3>& bodies : mixtures) {
    const auto weights = std::make_shared<const ClusterWeights>(3);
    MonteCarloSettings settings;
    settings.stop.trials = 1024;
    settings.integrand = [&] { return std::make_unique<VirialIntegrand>(bodies, settings.law, weights); };
    const VolumeEstimate reduced =
        volume_estimate(run_monte_carlo(bodies[0], bodies[2], settings).tally, settings.domain);
    // B_ij of both pairs of neighbours, by the driver's hit or miss.
    double factor = 1.0;
    for (const std::size_t k : {0u, 1u}) {
      MonteCarloSettings of_pair;
      of_pair.domain = best_domain(bodies[k], bodies[k + 1]);
      of_pair.stop.trials = 400'000;
      factor *=
          0.5 *
          volume_estimate(run_monte_carlo(bodies[k], bodies[k + 1], of_pair).tally, of_pair.domain).excluded_volume;
    }
    const VolumeEstimate direct = third_virial_by_brute_force(bodies, 200'000);
    const double error =
        std::hypot(std::hypot(factor * reduced.std_error, direct.std_error), 2e-3 * direct.excluded_volume);
    EXPECT_LT(std::fabs(factor * reduced.excluded_volume - direct.excluded_volume), 4.0 * error);
    EXPECT_LT(error, 0.02 * direct.excluded_volume);
  }
}

// Of the laws of one body those that are isotropic, or aligned, by another name: chains are weighed by what neighbours
// count for, and not drawn from all poses that overlap.
TEST(VirialIntegrand, LawsThatAreIsotropicOrAlignedByAnotherNameAgree) {
  const auto z_between = [](const VolumeEstimate& x, const VolumeEstimate& y) {
    return (x.excluded_volume - y.excluded_volume) / std::hypot(x.std_error, y.std_error);
  };
  const auto by_law = [](const ConvexBody& body, const OrientationLaw& law, int order, std::uint64_t n,
                         double excluded_volume) {
    return coefficient(body, law, order, n, biconnected_sum, 1, best_instruction_set(), excluded_volume);
  };
  const ConvexBody cube = Box(1.0, 1.0, 1.0), ellipsoid = Ellipsoid(0.5, 0.5, 2.0);
  const OrientationLaw flat = OrientationLaw::table({{-1.0, 1.0}, {1.0, 1.0}});
  for (const int order : {3, 6}) {
    const VolumeEstimate known =
        coefficient(cube, {}, order, 1024, biconnected_sum, 1, best_instruction_set(), kOfCubes);
    for (const OrientationLaw& law : {OrientationLaw::onsager(0.0), flat}) {
      const VolumeEstimate found = by_law(cube, law, order, 512, kOfCubes);
      EXPECT_LT(std::fabs(z_between(found, known)), 4.0) << law.name() << " " << order;
      EXPECT_LT(found.std_error, 3.0 * known.std_error);
      EXPECT_NE(found.excluded_volume, known.excluded_volume);
    }
  }
  // Parallel ellipsoids have the coefficients of spheres, those of half a degree nearly.
  const double of_ellipsoids = 4.0 * kOfSpheres;
  const std::array known = {0.625, kB4OfSpheres, 0.110252, 0.03888198, 0.01302354};
  for (const int order : {3, 4, 7}) {
    const double of_spheres = known[static_cast<std::size_t>(order - 3)];
    for (const OrientationLaw& law : {OrientationLaw::cone(0.0), OrientationLaw::onsager(1e9)}) {
      const VolumeEstimate found = by_law(ellipsoid, law, order, 512, of_ellipsoids);
      EXPECT_LT(std::fabs(z_of(found, of_spheres)), 4.0) << law.name() << " " << order;
    }
  }
  // Balls have no orientation.
  EXPECT_LT(std::fabs(z_of(by_law(Sphere(0.5), OrientationLaw::maier_saupe(3.0), 4, 1024, kOfSpheres), kB4OfSpheres)),
            4.0);
}

TEST(VirialIntegrand, ByALawOfOneBodyB3AgreesWithBruteForce) {
  constexpr double kAlpha = 8.0;
  const OrientationLaw law = OrientationLaw::onsager(kAlpha);
  const ConvexBody rod = Box(0.4, 0.6, 2.4), cone = Cone(1.5, 0.5);
  struct Case {
    std::array<ConvexBody, 3> bodies;
    bool is_mixture;
  };
  for (const Case& one : {Case{{rod, rod, rod}, false}, Case{{rod, rod, cone}, true}, Case{{rod, cone, rod}, true}}) {
    const std::array<ConvexBody, 3>& bodies = one.bodies;
    // B_ij of both pairs of neighbours, by the driver's hit or miss.
    std::array<KnownExcludedVolume, 2> known;
    for (const std::size_t k : {0u, 1u}) {
      MonteCarloSettings of_pair;
      of_pair.law = law;
      of_pair.domain = best_domain(bodies[k], bodies[k + 1]);
      of_pair.stop.trials = 1'000'000;
      known[k].value =
          volume_estimate(run_monte_carlo(bodies[k], bodies[k + 1], of_pair).tally, of_pair.domain).excluded_volume;
    }
    const auto weights = std::make_shared<const ClusterWeights>(3);
    MonteCarloSettings settings;
    settings.stop.trials = 1024;
    const InstructionSet set = best_instruction_set();
    settings.integrand = [&]() -> std::unique_ptr<Integrand> {
      if (one.is_mixture) return std::make_unique<VirialIntegrand>(bodies, law, weights, set, known);
      return std::make_unique<VirialIntegrand>(bodies[0], law, weights, set, nullptr, known[0]);
    };
    const VolumeEstimate reduced =
        volume_estimate(run_monte_carlo(bodies[0], bodies[2], settings).tally, settings.domain);
    const double factor = 0.25 * known[0].value * known[1].value;
    const VolumeEstimate direct = third_virial_by_brute_force(bodies, 500'000, 11, onsager_turn(kAlpha));
    // What is known of <V_ex> goes out: it is the unit only.
    const double error = std::hypot(factor * reduced.std_error, direct.std_error);
    EXPECT_LT(std::fabs(factor * reduced.excluded_volume - direct.excluded_volume), 4.0 * error);
    EXPECT_LT(error, 0.02 * direct.excluded_volume);
    if (one.is_mixture) continue;
    // In random orientation it is another number.
    const VolumeEstimate of_isotropic = third_virial_by_brute_force(bodies, 500'000);
    EXPECT_GT(std::fabs(of_isotropic.excluded_volume - direct.excluded_volume), 6.0 * error);
  }
}

TEST(VirialIntegrand, ByALawOfOneBodyThreadsAndInstructionSetsChangeNoBit) {
  const ConvexBody box = Box(1.0, 0.8, 2.0);
  for (const int order : {4, 6}) {
    const auto with = [&](int n_threads, InstructionSet set) {
      return coefficient(box, OrientationLaw::onsager(4.0), order, 64, biconnected_sum, n_threads, set, 20.0);
    };
    const VolumeEstimate one = with(1, best_instruction_set());
    for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse2, best_instruction_set()}) {
      const VolumeEstimate other = with(3, set);
      EXPECT_EQ(one.excluded_volume, other.excluded_volume) << order << " " << name_of(set);
      EXPECT_EQ(one.std_error, other.std_error);
    }
  }
}

TEST(VirialIntegrand, LawsThatAreNotOfOneBodyAreRefused) {
  const auto weights = std::make_shared<const ClusterWeights>(3);
  const ConvexBody body = Box(1.0, 1.0, 2.0);
  const auto with = [&](const OrientationLaw& law, const KnownExcludedVolume& known) {
    return VirialIntegrand(body, law, weights, best_instruction_set(), nullptr, known);
  };
  const KnownExcludedVolume known{20.0, 0.0};
  const Vec3d x{1.0, 0.0, 0.0}, z{0.0, 0.0, 1.0};
  EXPECT_NO_THROW(with(OrientationLaw::onsager(3.0).about(x, x), known));
  EXPECT_THROW(with(OrientationLaw::onsager(3.0), {}), UsageError);
  EXPECT_THROW(with(OrientationLaw::onsager(3.0).about(x, z), known), UsageError);
  EXPECT_THROW(with(OrientationLaw::fixed(1.0, 0.0, 0.0, 0.0), known), UsageError);
  EXPECT_THROW(with(OrientationLaw::angle(30.0), known), UsageError);
  EXPECT_THROW(with(OrientationLaw::each(AxisLaw::cone(30.0), AxisLaw::onsager(2.0)), known), UsageError);
  EXPECT_THROW(VirialIntegrand({body, body, body}, {}, std::make_shared<const ClusterWeights>(4)), UsageError);
}

}  // namespace
}  // namespace vex
