// The front door: it gives what the driver gives, beside what is known, and refuses what makes no sense.
#include "shapes/estimators/excluded_volume.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/formula.h"
#include "shapes/needle.h"
#include "shapes/polytope.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"
#include "shapes/tetrahedron.h"

namespace vex {
namespace {

/// A user's own ball, which tells nothing of its measures.
struct OwnBall {
  double radius;
  Vec3d support(const Vec3d& d) const {
    const double length = norm(d);
    return length == 0.0 ? Vec3d{} : (radius / length) * d;
  }
  double support_error() const { return 8.0 * kUnitRoundoff * radius; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return radius * (1.0 + 0x1p-48); }
  double inradius() const { return radius * (1.0 - 0x1p-48); }
};

/// Wrong ones.
struct MismeasuredBall : OwnBall {
  Measures of_ball;
  Measures measures() const { return of_ball; }
};

/// It tells its volume and the rest.
struct MeasuredBall : OwnBall {
  Measures measures() const {
    const double r = radius, pi = std::numbers::pi;
    return {4.0 / 3.0 * pi * r * r * r, 4.0 * pi * r * r, 4.0 * pi * r};
  }
};

TEST(FrontDoor, TakesShapesAndHoldsTheResultAgainstTheFormula) {
  const ExcludedVolume r = excluded_volume(Box(1, 2, 3), Sphere(0.5), {.rel_error = 1e-3});
  ASSERT_TRUE(r.reference.has_value());
  EXPECT_EQ(r.reference->kind, Reference::Kind::formula);
  EXPECT_NEAR(r.reference->value, 22.235987756, 1e-9);
  EXPECT_EQ(r.reference->std_error, 0.0);
  ASSERT_TRUE(r.z.has_value());
  EXPECT_LT(std::fabs(*r.z), 5.0);
  EXPECT_EQ(*r.z, (r.value - r.reference->value) / r.std_error);
  EXPECT_LE(r.std_error, 1e-3 * r.value);
  EXPECT_LT(r.ci95.lower, r.value);
  EXPECT_GT(r.ci95.upper, r.value);
  EXPECT_EQ(r.b2, 0.5 * r.value);
  EXPECT_NEAR(r.reduced, r.value / std::sqrt(6.0 * 4.0 / 3.0 * std::numbers::pi / 8.0), 1e-12 * r.reduced);
  EXPECT_TRUE(r.complete);
  ASSERT_NE(r.estimator, nullptr);
  EXPECT_FALSE(r.candidates.empty());
  EXPECT_NE(r.chosen_because.find("pilot"), std::string::npos);
}

TEST(FrontDoor, IsTheDriverBitForBitForAnyNumberOfThreads) {
  const Body a = parse_shape("cone:1,1"), b = parse_shape("box:1,2,3");
  for (const Estimator* const estimator : estimators()) {
    SCOPED_TRACE(estimator->name);
    MonteCarloSettings driver;
    driver.seed = 7;
    driver.stop.trials = 3000;
    driver.sequence = estimator->usual_sequence;
    set_estimator(driver, *estimator, a, b);
    const VolumeEstimate expected = volume_estimate(run_monte_carlo(a, b, driver).tally, driver.domain);
    for (const int threads : {1, 2, 3, 8}) {
      const ExcludedVolume r = excluded_volume(
          a, b, {.trials = 3000, .estimator = std::string(estimator->name), .seed = 7, .threads = threads});
      EXPECT_EQ(r.value, expected.excluded_volume);
      EXPECT_EQ(r.std_error, expected.std_error);
      EXPECT_EQ(r.estimator, estimator);
      ASSERT_TRUE(r.z.has_value()) << r.z_reason;
      EXPECT_LT(std::fabs(*r.z), 5.0);
    }
  }
  double chosen = 0.0;
  for (const int threads : {1, 2, 8}) {
    const ExcludedVolume r = excluded_volume(a, b, {.rel_error = 1e-3, .seed = 3, .threads = threads});
    if (chosen == 0.0) chosen = r.value;
    EXPECT_EQ(r.value, chosen);
  }
}

TEST(FrontDoor, SaysWhereNothingIsKnown) {
  const ExcludedVolume r = excluded_volume(OwnBall{1.0}, OwnBall{1.0}, {.rel_error = 1e-3});
  EXPECT_FALSE(r.reference.has_value());
  EXPECT_FALSE(r.z.has_value());
  EXPECT_EQ(r.z_reason, "V, S and M of a body are not known");
  EXPECT_EQ(r.reference_reason, r.z_reason);
  EXPECT_TRUE(std::isnan(r.reduced));
  EXPECT_LT(std::fabs(r.value - 32.0 / 3.0 * std::numbers::pi), 5.0 * r.std_error);
  for (const char* const needs_measures : {"mixed-volume", "mean-width"}) {
    EXPECT_THROW(excluded_volume(OwnBall{1.0}, OwnBall{1.0}, {.estimator = needs_measures}), UsageError);
  }

  // Of a law without series or normals.
  const ExcludedVolume of_law =
      excluded_volume(MeasuredBall{{1.0}}, Box(1, 1, 1), {.trials = 1000, .law = OrientationLaw::cone(30.0)});
  EXPECT_FALSE(of_law.reference.has_value());
  EXPECT_NE(of_law.reference_reason.find("cone:30"), std::string::npos) << of_law.reference_reason;
}

TEST(FrontDoor, TakesAUsersOwnMeasures) {
  const ExcludedVolume r = excluded_volume(MeasuredBall{{1.0}}, Box(1, 1, 1), {.rel_error = 1e-3});
  ASSERT_TRUE(r.z.has_value()) << r.z_reason;
  EXPECT_LT(std::fabs(*r.z), 5.0);
}

TEST(FrontDoor, RefusesMeasuresThatNoBodyHas) {
  for (const Measures& m : {Measures{-1.0, 1.0, 1.0}, Measures{1.0, -1.0, 1.0}, Measures{1.0, 1.0, -1.0},
                            Measures{HUGE_VAL, 1.0, 1.0}, Measures{1.0, HUGE_VAL, 1.0}}) {
    EXPECT_THROW(excluded_volume(MismeasuredBall{{1.0}, m}, Box(1, 1, 1), {.trials = 1000}), InputError);
  }
  EXPECT_THROW(
      excluded_volume(Box(1, 1, 1), Box(1, 1, 1), {.control_variate = {MismeasuredBall{{1.0}, {-1.0, 1.0, 1.0}}}}),
      InputError);
  // Zeros are no answer in place of the run.
  const ExcludedVolume of_zeros =
      excluded_volume(MismeasuredBall{{1.0}, {}}, MismeasuredBall{{1.0}, {}}, {.rel_error = 1e-3});
  EXPECT_NEAR(of_zeros.value, 32.0 / 3.0 * std::numbers::pi, 5.0 * of_zeros.std_error);
  // Others, if wrong, the run disagrees with.
  const ExcludedVolume r =
      excluded_volume(MismeasuredBall{{1.0}, {4.0, 12.0, 12.0}}, Box(1, 1, 1), {.rel_error = 1e-3});
  EXPECT_GT(std::fabs(r.z.value()), 20.0);
}

TEST(FrontDoor, RefusesSizesOfWhichVolumesOverflow) {
  for (const double size : {1e-50, 1e77, 1e99}) {
    EXPECT_THROW(excluded_volume(Box(size, 2.0 * size, size), Sphere(size), {.rel_error = 1e-3}), InputError) << size;
  }
}

/// Made of a shape, with a mapping of its own.
struct DoubledTetrahedron : Tetrahedron {
  using Tetrahedron::Tetrahedron;
  template <class L>
  Vec3<L> support(const Vec3<L>& d) const {
    const Vec3<L> s = Tetrahedron::support(d);
    return {s.x + s.x, s.y + s.y, s.z + s.z};
  }
  double support_error() const { return 2.0 * Tetrahedron::support_error(); }
  double circumradius() const { return 2.0 * Tetrahedron::circumradius(); }
  double inradius() const { return 2.0 * Tetrahedron::inradius(); }
};

TEST(Body, OfAClassMadeOfAPolytopeKeepsItsOwnMapping) {
  const Body doubled = DoubledTetrahedron(1.0), regular = Tetrahedron(1.0);
  const Vec3d up{0.0, 0.0, 1.0};
  EXPECT_NEAR(doubled.body.support(up).z, 2.0 * regular.body.support(up).z, 1e-15);
  EXPECT_EQ(doubled.body.circumradius(), 2.0 * regular.body.circumradius());
  EXPECT_NE(regular.body.target<Polytope>(), nullptr) << "a regular polyhedron is its vertices";
  EXPECT_EQ(doubled.body.target<Polytope>(), nullptr);
  EXPECT_FALSE(doubled.body.exact_form().has_value()) << "it is that of half of it";
  EXPECT_FALSE(doubled.body.rounds_as_kernels() || doubled.body.may_have_direction_table());
}

TEST(Body, OfAClassWithItsOwnMappingDoesNotInheritMeasures) {
  struct DoubledBox : Box {
    using Box::Box;
    Vec3d support(const Vec3d& d) const { return 2.0 * Box::support(d); }
    double circumradius() const { return 2.0 * Box::circumradius(); }
  };
  struct MeasuredDoubledBox : DoubledBox {
    using DoubledBox::DoubledBox;
    Measures measures() const {
      const Measures half = Box::measures();
      return {8.0 * half.volume, 4.0 * half.surface_area, 2.0 * half.integrated_mean_curvature};
    }
  };
  struct NamedBox : Box {
    using Box::Box;
  };
  const Body doubled = DoubledBox(1, 2, 3), measured = MeasuredDoubledBox(1, 2, 3), named = NamedBox(1, 2, 3);
  EXPECT_FALSE(doubled.measures.are_known()) << "they are those of half of it";
  EXPECT_FALSE(static_cast<bool>(doubled.normals.area));
  EXPECT_EQ(doubled.n_faces, 0U);
  EXPECT_FALSE(doubled.body.exact_form() || doubled.body.generators() || doubled.body.rounds_as_kernels());
  EXPECT_EQ(measured.measures.volume, 48.0);
  EXPECT_FALSE(static_cast<bool>(measured.normals.area));
  EXPECT_EQ(named.measures.volume, 6.0);
  EXPECT_TRUE(static_cast<bool>(named.normals.area));
  EXPECT_TRUE(static_cast<bool>(Body(Rounded<Box>(Box(1, 2, 3), Box(1, 2, 3).measures(), 0.1)).normals.area));
  const ExcludedVolume r = excluded_volume(doubled, Sphere(1), {.trials = 4096});
  EXPECT_FALSE(r.reference.has_value());
  const double truth = average_excluded_volume(Box(2, 4, 6).measures(), Sphere(1).measures());
  EXPECT_LT(std::fabs(r.value - truth), 5.0 * r.std_error);
}

TEST(FrontDoor, RefusesAMappingThatReachesFartherThanItClaims) {
  // In a thousandth of all directions, which no pilot need have seen: the volumes of the sets that hold A - B at one
  // orientation were then more than sums have room for, or below 0.
  struct Liar : OwnBall {
    double far;
    Vec3d support(const Vec3d& d) const {
      const double length = norm(d);
      return d.x > 0.59 * length && d.x < 0.6 * length ? Vec3d{far, far, far} : OwnBall::support(d);
    }
  };
  const auto run = [](double far, InstructionSet set) {
    return excluded_volume(
        Liar{{1.0}, far}, Box(1, 1, 1),
        {.trials = 200'000, .estimator = "hit-or-miss-fitted", .threads = 2, .instruction_set = set});
  };
  for (const InstructionSet set : {InstructionSet::scalar, best_instruction_set()}) {
    for (const double far : {1e5, -1e5, 1e300, -1e300}) EXPECT_THROW(run(far, set), InputError) << far;
    // Where another set than that of the wrong height is the smallest one, nobody sees it: `validate` would.
    for (const double far : {3.0, HUGE_VAL}) {
      const ExcludedVolume r = run(far, set);
      EXPECT_LE(r.value, 8.0 * 3.0 * 3.0 * 3.0);
    }
  }
}

TEST(FrontDoor, KeepsWhatItsIntegrandsAreOf) {
  MonteCarloSettings settings;
  settings.stop.trials = 4096;
  const ConvexBody nobody = Sphere(1);
  for (const char* const name : {"radial", "mixed-volume", "mean-width"}) {
    set_estimator(settings, estimator_named(name), Body(Box(1, 2, 3)), Body(parse_shape("capsule:1,0.5")));
    const VolumeEstimate found = volume_estimate(run_monte_carlo(nobody, nobody, settings).tally, {});
    const double truth = average_excluded_volume(Box(1, 2, 3).measures(), parse_shape("capsule:1,0.5").measures);
    EXPECT_LT(std::fabs(found.excluded_volume - truth), 5.0 * found.std_error) << name;
  }
}

TEST(FrontDoor, IsNotLedAstrayByALargeControlVariate) {
  // Rounding of volumes 1e60 times as large was taken for a variance that goes with that of the bodies.
  for (const char* const control : {"sphere:1e20", "box:1e20,1e20,1e20", "ellipsoid:1e20,1e20,1.1e20", "sphere:1e-9"}) {
    for (const char* const estimator : {"radial", "mixed-volume"}) {
      const ExcludedVolume r =
          excluded_volume(parse_shape("box:1,2,3"), parse_shape("capsule:1,1"),
                          {.trials = 1u << 15, .estimator = estimator, .control_variate = {parse_shape(control)}});
      ASSERT_TRUE(r.z.has_value()) << r.z_reason;
      EXPECT_LT(std::fabs(*r.z), 5.0) << control << " " << estimator;
      EXPECT_LT(r.std_error, 0.01 * r.value) << control << " " << estimator;
      EXPECT_LT(r.ci95.lower, r.ci95.upper);
    }
  }
}

TEST(FrontDoor, ChecksSettingsAlsoWhereNothingIsRun) {
  for (const ExcludedVolumeSettings& settings :
       {ExcludedVolumeSettings{.rel_error = -1.0}, ExcludedVolumeSettings{.trials = 0},
        ExcludedVolumeSettings{.seconds = -1.0}, ExcludedVolumeSettings{.threads = kMostThreads + 1},
        ExcludedVolumeSettings{.estimator = "radail"}}) {
    EXPECT_THROW(excluded_volume(Needle(1), Needle(1), settings), UsageError);
  }
}

TEST(FrontDoor, EndsAtTheSameRelativeErrorWithWhateverEstimatorWhereNoRuleIsGiven) {
  for (const char* const estimator : {"", "radial", "hit-or-miss-fitted"}) {
    const ExcludedVolume r =
        excluded_volume(parse_shape("capsule:10,0.5"), parse_shape("needle:10"), {.estimator = estimator});
    EXPECT_LE(r.std_error, 1e-4 * r.value) << estimator;
    EXPECT_GT(r.std_error, 1e-5 * r.value) << estimator;
  }
}

TEST(FrontDoor, EndsWhereNothingIsHit) {
  // Two triangles in planes that stay parallel, though neither is across an axis: A - B is flat, and no rule would end
  // the run before 1e11 trials.
  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};
  const Body triangle = Polytope(corners, corners[0], 0.0);
  const ExcludedVolume of_triangles =
      excluded_volume(triangle, triangle, {.law = OrientationLaw::aligned(), .estimator = "hit-or-miss"});
  EXPECT_EQ(of_triangles.record.stopped_by, StopReason::in_vain);
  EXPECT_FALSE(of_triangles.complete);
  EXPECT_LT(of_triangles.value, 1e-6);
  const ExcludedVolume of_the_long =
      excluded_volume(parse_shape("sphere:1e-9"), parse_shape("needle:1e9"), {.estimator = "hit-or-miss"});
  EXPECT_EQ(of_the_long.record.stopped_by, StopReason::in_vain);
  EXPECT_GT(of_the_long.ci95.upper, of_the_long.reference->value);
}

TEST(FrontDoor, PassesOnWhatASupportMappingThrows) {
  struct Throwing : OwnBall {
    Vec3d support(const Vec3d& /*d*/) const { throw std::runtime_error("of the user's own"); }
  };
  EXPECT_THROW(excluded_volume(Throwing{{1.0}}, Box(1, 1, 1), {.estimator = "hit-or-miss"}), std::runtime_error);
}

TEST(FrontDoor, HoldsOtherLawsAgainstTheExactAverage) {
  const ExcludedVolume r = excluded_volume(parse_shape("capsule:1,0.25"), parse_shape("capsule:1,0.25"),
                                           {.rel_error = 1e-3, .law = OrientationLaw::cone(30.0)});
  ASSERT_TRUE(r.reference.has_value());
  EXPECT_EQ(r.reference->kind, Reference::Kind::exact);
  EXPECT_GT(r.reference->std_error, 0.0);
  EXPECT_NEAR(r.reference->value, 2.53527615, 1e-6);
  ASSERT_TRUE(r.z.has_value());
  EXPECT_LT(std::fabs(*r.z), 5.0);
  const ExcludedVolume without = excluded_volume(
      Box(1, 1, 1), Box(1, 1, 1), {.trials = 1000, .law = OrientationLaw::cone(30.0), .exact_average = false});
  EXPECT_FALSE(without.reference.has_value());
}

TEST(FrontDoor, SamplesNothingWhereTheVolumeIsZero) {
  const ExcludedVolume r = excluded_volume(Needle(1), Needle(2));
  EXPECT_EQ(r.value, 0.0);
  EXPECT_EQ(r.std_error, 0.0);
  EXPECT_EQ(r.estimator, nullptr);
  EXPECT_EQ(r.record.tally.n_trials, 0U);
  EXPECT_FALSE(r.no_run_reason.empty());
  EXPECT_FALSE(r.z.has_value());
  EXPECT_TRUE(r.complete);
  const ExcludedVolume of_law = excluded_volume(Needle(1), Needle(2), {.law = OrientationLaw::cone(30.0)});
  ASSERT_TRUE(of_law.reference.has_value());
  EXPECT_EQ(of_law.reference->kind, Reference::Kind::exact);
  EXPECT_EQ(of_law.reference->value, 0.0);
}

TEST(FrontDoor, RefusesSettingsThatContradictEachOther) {
  const Body box = Box(1, 1, 1), ball = Sphere(1);
  EXPECT_THROW(excluded_volume(box, box, {.estimator = "radail"}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.estimator = "radial", .domain = "box"}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.domain = "cube"}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.estimator = "radial", .verify = true}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.estimator = "mixed-volume", .quick_verdicts = false}), UsageError);
  EXPECT_THROW(excluded_volume(ball, ball, {.estimator = "stratified"}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.threads = -1}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.threads = kMostThreads + 1}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.rel_error = 0.0}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.rel_error = std::nan("")}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.control_variate = {box, box, box}}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.estimator = "hit-or-miss", .control_variate = {ball}}), UsageError);
  EXPECT_THROW(excluded_volume(box, box, {.control_variate = {OwnBall{1.0}}}), UsageError);
  EXPECT_THROW(excluded_volume(Box(1e120, 1e120, 1e120), box), InputError);
  EXPECT_THROW(excluded_volume(Box(1e-120, 1e-120, 1e-120), Sphere(1e-120)), InputError);
}

TEST(FrontDoor, TakesHitOrMissWhereASettingIsAboutPoses) {
  const Body box = Box(1, 1, 1);
  for (const ExcludedVolumeSettings& settings :
       {ExcludedVolumeSettings{.trials = 100, .domain = "best"}, ExcludedVolumeSettings{.trials = 100, .verify = true},
        ExcludedVolumeSettings{.trials = 100, .quick_verdicts = false}}) {
    EXPECT_EQ(excluded_volume(box, box, settings).estimator->name, "hit-or-miss");
  }
  EXPECT_EQ(excluded_volume(box, box, {.trials = 100, .control_variate = {Sphere(0.6)}}).estimator->name, "radial");
}

TEST(FrontDoor, EndsWhereItIsInterrupted) {
  const std::atomic<int> interrupt{2};
  const ExcludedVolume r = excluded_volume(Box(1, 1, 1), Box(1, 1, 1), {.rel_error = 1e-9, .interrupt = &interrupt});
  EXPECT_FALSE(r.complete);
  EXPECT_EQ(r.record.stopped_by, StopReason::interrupted);
  if (r.record.tally.n_trials == 0) {
    EXPECT_TRUE(std::isnan(r.value));
    EXPECT_TRUE(std::isinf(r.std_error));
    EXPECT_EQ(r.z_reason, "no trial was done");
  }
}

TEST(Registry, NamesEachEstimatorOnce) {
  std::set<std::string_view> names;
  for (const Estimator* const one : estimators()) {
    EXPECT_TRUE(names.insert(one->name).second) << one->name;
    EXPECT_EQ(find_estimator(one->name), one);
    EXPECT_FALSE(one->meaning.empty());
    EXPECT_TRUE(one->runs_gjk || !one->samples_poses);
  }
  EXPECT_EQ(find_estimator("Radial"), nullptr);
  EXPECT_THROW(estimator_named(""), UsageError);
}

TEST(Body, KnowsItsMeasuresWhereItsClassDoes) {
  const Body box = Box(1, 2, 3), tetrahedron = Tetrahedron(1), own = OwnBall{1.0}, bare = ConvexBody(Box(1, 2, 3));
  EXPECT_EQ(box.measures.volume, 6.0);
  EXPECT_EQ(box.n_faces, 6U);
  EXPECT_TRUE(box.normals.area && box.normals.mean_curvature);
  EXPECT_EQ(vertices_of(tetrahedron).size(), 4U);
  EXPECT_FALSE(own.measures.are_known());
  EXPECT_FALSE(bare.measures.are_known());
  const std::vector<Vec3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, 0.2}};
  const Body hull = hull_of(corners);
  EXPECT_NEAR(hull.measures.volume, 1.0 / 6.0, 1e-16);
  EXPECT_EQ(vertices_of(hull).size(), 4U);
  EXPECT_EQ(hull.n_faces, 4U);
  EXPECT_THROW(hull_of({}), InputError);
  EXPECT_THROW(hull_of(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), InputError);
  EXPECT_THROW(hull_of(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}), InputError);
}

TEST(OrderParameter, IsTheMeanOfTheSecondLegendrePolynomial) {
  EXPECT_EQ(OrientationLaw::isotropic().order_parameter(), 0.0);
  EXPECT_EQ(OrientationLaw::aligned().order_parameter(), 1.0);
  EXPECT_EQ(OrientationLaw::fixed(1, 0, 0, 0).order_parameter(), std::nullopt);
  EXPECT_NEAR(OrientationLaw::cone(0.0).order_parameter().value(), 1.0, 1e-15);
  EXPECT_NEAR(OrientationLaw::cone(90.0).order_parameter().value(), 0.0, 1e-15);
  EXPECT_EQ(OrientationLaw::onsager(0.0).order_parameter(), 0.0);
  // Simpson's rule over cos(theta) from 0 to 1, by the laws' definitions.
  const auto mean = [](double from, const auto& density) {
    constexpr int n = 20000;
    double sum = 0.0, norm = 0.0;
    for (int k = 0; k <= n; ++k) {
      const double x = from + (1.0 - from) * k / n, weight = (k == 0 || k == n ? 1.0
                                                              : k % 2 == 1     ? 4.0
                                                                               : 2.0) *
                                                             density(x);
      sum += weight * (1.5 * x * x - 0.5);
      norm += weight;
    }
    return sum / norm;
  };
  for (const double degrees : {10.0, 30.0, 75.0}) {
    const double least = std::cos(degrees * std::numbers::pi / 180.0);
    EXPECT_NEAR(OrientationLaw::cone(degrees).order_parameter().value(), mean(least, [](double) { return 1.0; }),
                1e-12);
  }
  for (const double alpha : {1e-3, 0.1, 0.1249, 0.126, 1.0, 10.0, 100.0}) {
    const double exact =
        mean(0.0, [alpha](double x) { return std::exp(alpha * (x - 1.0)) + std::exp(-alpha * (x + 1.0)); });
    EXPECT_NEAR(OrientationLaw::onsager(alpha).order_parameter().value(), exact, 1e-10) << alpha;
  }
  EXPECT_NEAR(OrientationLaw::onsager(1e300).order_parameter().value(), 1.0, 1e-15);
}

}  // namespace
}  // namespace vex
