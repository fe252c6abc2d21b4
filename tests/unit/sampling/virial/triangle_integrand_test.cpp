#include "engine/sampling/virial/triangle_integrand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/virial/virial_integrand.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/formula.h"
#include "shapes/scaled.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

struct Wrong {
  double factor = 1.0;  // of <V_ex>
  int n_sides = 3;
};

double excluded_volume_of(const Body& body, const OrientationLaw& law) {
  return law.dimension() > 0 ? average_excluded_volume(body.measures, body.measures)
                             : exact_average(body, body, law).excluded_volume;
}

VolumeEstimate third(const std::string& text, const OrientationLaw& law, std::uint64_t n_trials, std::uint64_t seed = 1,
                     int n_threads = 1, InstructionSet set = best_instruction_set(), const Wrong& wrong = {}) {
  const Body body = parse_shape(text);
  const double excluded_volume = wrong.factor * excluded_volume_of(body, law);
  MonteCarloSettings settings;
  settings.seed = seed;
  settings.n_threads = n_threads;
  settings.instruction_set = set;
  settings.sequence = Sequence::sobol;
  settings.stop.trials = n_trials;
  settings.integrand = [&] {
    return std::make_unique<TriangleIntegrand>(body.body, law, excluded_volume, 0x1p-40, set, wrong.n_sides);
  };
  const RunRecord record = run_monte_carlo(body.body, body.body, settings);
  EXPECT_EQ(record.tally.n_undecided, 0u);
  EXPECT_EQ(VirialPairs::of(record.tally).n_searched, 3 * n_trials);
  return volume_estimate(record.tally, settings.domain);
}

double errors_off(const VolumeEstimate& estimate, double known) {
  return (estimate.excluded_volume - known) / estimate.std_error;
}

const OrientationLaw kAligned = OrientationLaw::aligned();
constexpr double kB3OfSpheres = 5.0 / 8.0, kB3OfAlignedCubes = 9.0 / 16.0;

TEST(TriangleIntegrand, OfSpheresAndAlignedBoxesTheCoefficientIsTheKnownOne) {
  // A lens as thick as it is wide is a ball, of which no packets find the rays.
  for (const char* const text : {"sphere:0.5", "ellipsoid:1,1,100", "ellipsoid:0.2,1,7", "lens:1,2"}) {
    const VolumeEstimate found = third(text, kAligned, 1u << 16);
    EXPECT_LT(std::fabs(errors_off(found, kB3OfSpheres)), 4.0) << text;
    EXPECT_LT(found.std_error, 5e-5) << text;
  }
  // A superball of exponent 1 is a sphere by powers.
  for (const char* const text : {"sphere:2", "superball:1,2"}) {
    EXPECT_LT(std::fabs(errors_off(third(text, {}, 1u << 16), kB3OfSpheres)), 4.0) << text;
  }
  for (const char* const text : {"box:1,1,1", "box:0.1,2,9"}) {
    const VolumeEstimate found = third(text, kAligned, 1u << 16);
    EXPECT_LT(std::fabs(errors_off(found, kB3OfAlignedCubes)), 4.0) << text;
    EXPECT_LT(found.std_error, 1.5e-3) << text;
  }
}

// What 40 seeds are off by, in their own errors: the sum of squares of 40 numbers of Student's law with 31 degrees of
// freedom, 43 on average and with a spread of 10.
TEST(TriangleIntegrand, ErrorsAreHonest) {
  constexpr int kSeeds = 40;
  double of_spheres = 0.0, of_cubes = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const double z_sphere = errors_off(third("sphere:0.5", {}, 1u << 12, seed), kB3OfSpheres);
    const double z_cube = errors_off(third("box:1,1,1", kAligned, 1u << 12, seed), kB3OfAlignedCubes);
    of_spheres += z_sphere * z_sphere;
    of_cubes += z_cube * z_cube;
  }
  for (const double sum : {of_spheres, of_cubes}) {
    EXPECT_GT(sum, 15.0);
    EXPECT_LT(sum, 90.0);
  }
}

TEST(TriangleIntegrand, AgreesWithClustersThatAreHitOrMissed) {
  for (const char* const text :
       {"box:1,1,1", "box:3,2,1", "cylinder:2,0.5", "cone:1,0.6", "tetrahedron:1", "capsule:3,0.2", "ellipsoid:1,0.5,2",
        "hemisphere:1", "disc:1", "lens:1,0.5", "egg:1,0.5,0.3", "spindle:2,0.5", "rounded:0.2,lens:1,0.5",
        "superball:4,1", "superellipsoid:1,1,2,0.8,1.2", "rounded:0.1,superball:0.6,1"}) {
    const Body body = parse_shape(text);
    const VolumeEstimate found = third(text, {}, 1u << 15);
    MonteCarloSettings settings;
    settings.stop.trials = 2048;
    const auto weights = std::make_shared<const ClusterWeights>(3);
    settings.integrand = [&] { return std::make_unique<VirialIntegrand>(body.body, settings.law, weights); };
    const VolumeEstimate other =
        volume_estimate(run_monte_carlo(body.body, body.body, settings).tally, settings.domain);
    const double apart = found.excluded_volume - other.excluded_volume;
    EXPECT_LT(std::fabs(apart), 4.0 * std::hypot(found.std_error, other.std_error)) << text;
    EXPECT_LT(found.std_error, 5e-3) << text;
  }
}

TEST(TriangleIntegrand, WrongOnesAreFoundOut) {
  const auto z = [](const Wrong& wrong) {
    return errors_off(third("sphere:0.5", {}, 1u << 14, 1, 1, best_instruction_set(), wrong), kB3OfSpheres);
  };
  EXPECT_LT(std::fabs(z({})), 4.0);
  EXPECT_GT(std::fabs(z({1.001, 3})), 8.0);
  EXPECT_GT(std::fabs(z({1.0, 2})), 8.0);
}

TEST(TriangleIntegrand, ThreadsAndInstructionSetsChangeNoBit) {
  for (const char* const text :
       {"box:1,0.8,2", "tetrahedron:1", "ellipsoid:1,1,3", "cylinder:3,0.5", "lens:1,0.5", "superball:2,1"}) {
    for (const OrientationLaw& law : {OrientationLaw{}, kAligned}) {
      const VolumeEstimate one = third(text, law, 2048);
      for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse2, best_instruction_set()}) {
        const VolumeEstimate other = third(text, law, 2048, 1, 3, set);
        EXPECT_EQ(one.excluded_volume, other.excluded_volume) << text << " " << name_of(set);
        EXPECT_EQ(one.std_error, other.std_error) << text << " " << name_of(set);
      }
    }
  }
}

TEST(TriangleIntegrand, AValueHangsOnItsPointAlone) {
  const Body body = parse_shape("cylinder:2,0.5");
  TriangleIntegrand integrand(body.body, {}, excluded_volume_of(body, {}), 0x1p-40);
  const auto dimension = static_cast<std::size_t>(integrand.dimension());
  constexpr std::size_t kN = 100;
  std::mt19937_64 random(5);
  std::vector<double> points(dimension * kN), values(kN), one(dimension);
  for (double& x : points) x = std::uniform_real_distribution<double>(0.001, 0.999)(random);
  EXPECT_TRUE(integrand.evaluate(points, values).empty());
  for (std::size_t k = 0; k < kN; ++k) {
    for (std::size_t c = 0; c < dimension; ++c) one[c] = points[c * kN + k];
    double value = 0.0;
    integrand.evaluate(one, {&value, 1});
    EXPECT_EQ(value, values[k]);
    EXPECT_GT(value, 0.0);
  }
}

TEST(TriangleIntegrand, IsForBodiesThatAreKnownAndNotTooLong) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0), rod = Box(1500.0, 1.0, 1.0), slab = Box(1500.0, 1500.0, 1.0);
  EXPECT_TRUE(TriangleIntegrand::is_for(cube, {}, 11.0, 0x1p-40));
  EXPECT_FALSE(TriangleIntegrand::is_for(cube, {}, std::nan(""), 0x1p-40));
  EXPECT_FALSE(TriangleIntegrand::is_for(cube, {}, 11.0, 1e-6));
  EXPECT_FALSE(TriangleIntegrand::is_for(rod, {}, 1.0, 0x1p-40));
  EXPECT_FALSE(TriangleIntegrand::is_for(slab, kAligned, 1.0, 0x1p-40));
  EXPECT_TRUE(TriangleIntegrand::is_for(slab, {}, 1.0, 0x1p-40));
  EXPECT_TRUE(TriangleIntegrand::is_for(Box(100.0, 1.0, 1.0), kAligned, 800.0, 0x1p-40));
  const ConvexBody flattened = scaled(parse_shape("lens:1,0.3"), {1.0, 1.0, 0.5}).body;
  EXPECT_TRUE(TriangleIntegrand::is_for(flattened, {}, 1.0, 0x1p-40)) << "no packets";
  EXPECT_FALSE(TriangleIntegrand::is_for(flattened, kAligned, 1.0, 0x1p-40)) << "rays stall";
  for (const char* outline : {"lens:1,0.3", "spindle:1,0.3", "cut-sphere:1,1,0.2", "egg:1,0.3,3"}) {
    EXPECT_TRUE(TriangleIntegrand::is_for(parse_shape(outline).body, kAligned, 1.0, 0x1p-40)) << outline;
  }
  EXPECT_TRUE(TriangleIntegrand::is_for(parse_shape("superball:2,1").body, {}, 1.0, 0x1p-40)) << "packets of powers";
  EXPECT_FALSE(TriangleIntegrand::is_for(scaled(parse_shape("superball:2,1"), {1.0, 1.0, 0.5}).body, {}, 1.0, 0x1p-40))
      << "long mappings, and no packets";
  EXPECT_FALSE(TriangleIntegrand::is_for(cube, OrientationLaw::onsager(3.0), 11.0, 0x1p-40));
  EXPECT_FALSE(TriangleIntegrand::is_for(Box(1e-14, 1e-14, 1e-14), {}, 1e-41, 0x1p-40)) << "rays that stay open";
  EXPECT_THROW(TriangleIntegrand(cube, OrientationLaw::onsager(3.0), 11.0, 0x1p-40), UsageError);
}

}  // namespace
}  // namespace vex
