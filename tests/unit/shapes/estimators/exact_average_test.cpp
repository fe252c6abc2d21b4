// The excluded volume at a fixed orientation against closed forms (docs and REFERENCE: boxes, capsules, cylinders,
// simplices, ellipsoids, parallel bodies), and its mean over each law.
#include "shapes/estimators/exact_average.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"
#include "shapes/estimators/axis_moments.h"
#include "shapes/estimators/ellipsoid_excluded_volume.h"
#include "shapes/estimators/legendre_average.h"
#include "shapes/formula.h"
#include "shapes/rounded.h"
#include "tests/referees/bodies.h"
#include "tests/referees/normal_integral.h"

namespace vex {
namespace {

constexpr std::array<double, OrientationLaw::kMaxDimension> kAnyPoint{};  // of laws of one orientation

constexpr double kPi = std::numbers::pi;

// Enough for these tests, and a sixteenth of what is taken unless told.
ExactAverageSettings quick() {
  ExactAverageSettings settings;
  settings.log2_n_points = 11;
  return settings;
}

// So many standard errors at most: five of some hundred estimates from 32 randomisations each.
constexpr double kMostErrors = 5.0;

ExactAverage average_of(const std::string& a, const std::string& b, const OrientationLaw& law,
                        const ExactAverageSettings& settings = quick()) {
  return exact_average(parse_shape(a), parse_shape(b), law, settings);
}

void expect_average(const ExactAverage& found, double truth, double largest_relative_error) {
  EXPECT_LE(std::fabs(found.excluded_volume - truth), kMostErrors * found.error)
      << found.excluded_volume << " +- " << found.error << ", not " << truth;
  EXPECT_GT(found.error, 0.0);
  EXPECT_LE(found.error, largest_relative_error * truth) << found.excluded_volume;
}

std::vector<OrientationLaw> random_orientations(int n) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal;
  std::vector<OrientationLaw> laws;
  for (int i = 0; i < n; ++i) {
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    laws.push_back(OrientationLaw::fixed(w, x, y, z));
  }
  return laws;
}

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix matrix_of(const OrientationLaw& law) {
  const Transformd r = law.rotation(std::span<const double>(kAnyPoint));
  return {{{r.row_x.x, r.row_x.y, r.row_x.z}, {r.row_y.x, r.row_y.y, r.row_y.z}, {r.row_z.x, r.row_z.y, r.row_z.z}}};
}

TEST(ExcludedVolumeAtAFixedOrientation, OfTwoBoxesIsTheSumOverPairsOfEdges) {
  const std::array<double, 3> a{0.7, 1.1, 2.3}, b{3.0, 0.2, 1.3};
  for (const OrientationLaw& law : random_orientations(50)) {
    const Matrix r = matrix_of(law);
    double truth = a[0] * a[1] * a[2] + b[0] * b[1] * b[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      for (std::size_t m = 0; m < 3; ++m) {
        const std::size_t n = (m + 1) % 3, p = (m + 2) % 3;
        truth += std::fabs(r[k][m]) * (a[i] * a[j] * b[m] + a[k] * b[n] * b[p]);
      }
    }
    const ExactAverage found = average_of("box:0.7,1.1,2.3", "box:3,0.2,1.3", law);
    EXPECT_NEAR(found.excluded_volume, truth, 1e-13 * truth) << law.name();
    EXPECT_LE(found.error, 2e-12 * truth);
  }
  EXPECT_NEAR(average_of("box:1,1,1", "box:1,1,1", OrientationLaw::aligned()).excluded_volume, 8.0, 1e-14);
}

// The series, odd degrees among them, against sums over normals at drawn orientations: they share no polynomial.
TEST(AverageOfLawsOfAnAxis, IsThatOfMixedVolumesAtDrawnOrientations) {
  const AxisLaw up = AxisLaw::table({{0.0, 0.6, 1.0}, {0.0, 0.3, 6.0}});
  const AxisLaw down = AxisLaw::table({{-1.0, -0.6, 0.0}, {6.0, 0.3, 0.0}});
  ExactAverageSettings drawn = quick();
  drawn.series = false;
  for (const OrientationLaw& law :
       {OrientationLaw::maier_saupe(5), OrientationLaw::maier_saupe(-4), OrientationLaw::both_by(up),
        OrientationLaw::each(up, down), OrientationLaw::each(AxisLaw::aligned(), AxisLaw::onsager(4)),
        OrientationLaw::each(AxisLaw::maier_saupe(3), AxisLaw::cone(50))}) {
    for (const auto& [a_text, b_text] : {std::pair{"cone:2,0.5", "cone:1,0.7"}}) {
      const Body a = parse_shape(a_text), b = parse_shape(b_text);
      const ExactAverage series = exact_average(a, b, law), sums = exact_average(a, b, law, drawn);
      EXPECT_LE(std::fabs(series.excluded_volume - sums.excluded_volume), series.error + 5.0 * sums.error)
          << law.name() << " " << a_text << ": " << series.excluded_volume << " and " << sums.excluded_volume;
      EXPECT_LE(series.error, 1e-6 * series.excluded_volume) << law.name();
      EXPECT_LE(sums.error, 1e-3 * sums.excluded_volume) << law.name();
    }
  }
  // Up and down is not up and up: odd degrees count, and by far more than either way is off.
  const Body cone = parse_shape("cone:2,0.5");
  EXPECT_NEAR(exact_average(cone, cone, OrientationLaw::each(up, up)).excluded_volume, 6.838, 1e-3);
  EXPECT_NEAR(exact_average(cone, cone, OrientationLaw::each(up, down)).excluded_volume, 6.644, 1e-3);
}

TEST(ExcludedVolumeAtAFixedOrientation, OfTwoCapsulesIsBalbergs) {
  const double length = 1.5, r = 0.4;
  for (const OrientationLaw& law : random_orientations(10)) {
    const double cos = matrix_of(law)[2][2];
    const double truth = 32.0 / 3.0 * kPi * r * r * r + 8.0 * kPi * length * r * r +
                         4.0 * length * length * r * std::sqrt(1.0 - cos * cos);
    expect_average(average_of("capsule:1.5,0.4", "capsule:1.5,0.4", law), truth, 1e-6);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfTwoCylindersIsOnsagers) {
  const double l1 = 2.0, d1 = 1.0, l2 = 0.7, d2 = 1.6;
  for (const OrientationLaw& law : random_orientations(10)) {
    const double cos = std::fabs(matrix_of(law)[2][2]), sin = std::sqrt(1.0 - cos * cos);
    const double truth =
        kPi / 4.0 * (d1 * d2 * (d1 + d2) * sin + d1 * d1 * l1 + d2 * d2 * l2 + (d1 * d1 * l2 + d2 * d2 * l1) * cos) +
        (l1 + l2) * d1 * d2 * boost::math::ellint_2(sin) + (d1 + d2) * l1 * l2 * sin;
    expect_average(average_of("cylinder:2,0.5", "cylinder:0.7,0.8", law), truth, 1e-6);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfASimplexWithItselfIsTwentyVolumes) {
  const Body simplex = parse_shape("tetrahedron:1.3");
  const ExactAverage found = exact_average(simplex, simplex, OrientationLaw::aligned());
  EXPECT_NEAR(found.excluded_volume / simplex.measures.volume, 20.0, 1e-12);
  EXPECT_LE(found.error, 1e-10);
}

TEST(ExcludedVolumeAtAFixedOrientation, OfBodiesThatAreSymmetricAboutTheirCentreIsEightVolumesWhereAligned) {
  for (const char* text : {"box:0.2,1,3", "ellipsoid:1,2,3", "capsule:1,0.25", "cylinder:1,0.5", "octahedron:1",
                           "dodecahedron:0.5", "icosahedron:0.7", "sphere:0.6", "rounded:0.2,plate:1,0.8"}) {
    const Body body = parse_shape(text);
    expect_average(exact_average(body, body, OrientationLaw::aligned(), quick()), 8.0 * body.measures.volume, 1e-6);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfTwoEllipsoidsIsTheIntegralOfTheirHeights) {
  const Body a = parse_shape("ellipsoid:0.8,1,1.7"), b = parse_shape("ellipsoid:1.5,0.9,1.2");
  for (const OrientationLaw& law : random_orientations(5)) {
    const Transformd r = law.rotation(std::span<const double>(kAnyPoint));
    const double truth =
        a.measures.volume + b.measures.volume +
        integral_over(a.normals.area(),
                      [&](const Vec3d& n) { return dot(r.direction_to_b(n), b.body.support(r.direction_to_b(n))); }) +
        integral_over(b.normals.area(), [&](const Vec3d& n) { return dot(r(n), a.body.support(r(n))); });
    EXPECT_NEAR(ellipsoid_excluded_volume({0.8, 1, 1.7}, {1.5, 0.9, 1.2}, r), truth, 1e-12 * truth);
    const ExactAverage found = exact_average(a, b, law);
    EXPECT_NEAR(found.excluded_volume, truth, 1e-12 * truth);
    EXPECT_LE(found.error, 2e-12 * truth);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfEllipsoidsThinAsADiscOrANeedleIsTheirs) {
  const OrientationLaw law = OrientationLaw::fixed(0.3, 0.5, -0.2, 0.7);
  const ExactAverage thin = average_of("ellipsoid:1e-7,1e-7,1", "ellipsoid:1,1,1e-7", law);
  // The disc swept along the needle's length, which is not quite an ellipse's: pi * 4/3 of |cos|.
  const double cos = std::fabs(matrix_of(law)[2][2]);
  EXPECT_NEAR(thin.excluded_volume, 2.0 * kPi * cos, 1e-5);
}

TEST(ExcludedVolumeAtAFixedOrientation, OfABodyAndABallIsItsParallelBodysVolume) {
  const OrientationLaw law = OrientationLaw::fixed(0.3, 0.5, -0.2, 0.7);
  for (const char* text : kTestBodies) {
    const Body body = parse_shape(text), ball = parse_shape("sphere:0.6");
    const double truth = parallel_body_measures(body.measures, 0.6).volume;
    expect_average(exact_average(body, ball, law, quick()), truth, 2e-5);
    expect_average(exact_average(ball, body, law, quick()), truth, 2e-5);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfARoundedBodyIsThatOfTheCoreAndTheBall) {
  // |A + rB1 + (-RC)| by Steiner's formula for A + (-RC): with balls on both sides only the sum of the radii counts.
  const OrientationLaw law = OrientationLaw::fixed(0.3, 0.5, -0.2, 0.7);
  const double one = average_of("rounded:0.5,box:1,2,3", "box:0.5,1,1", law).excluded_volume;
  const double other = average_of("box:1,2,3", "rounded:0.5,box:0.5,1,1", law).excluded_volume;
  const double shared = average_of("rounded:0.2,box:1,2,3", "rounded:0.3,box:0.5,1,1", law).excluded_volume;
  EXPECT_NEAR(one, other, 1e-5 * one);
  EXPECT_NEAR(one, shared, 1e-5 * one);
}

TEST(ExcludedVolumeAtAFixedOrientation, DoesNotDependOnWhichBodyStands) {
  for (const NamedPair& pair :
       {NamedPair{"cone:1,0.5", "tetrahedron:1.3"}, NamedPair{"hemisphere:0.8", "cylinder:0.1,1"},
        NamedPair{"frustum:0.5,0.2,0.9", "rounded:0.1,tetrahedron:1"}, NamedPair{"ellipsoid:1,2,3", "cone:0.2,1"}}) {
    const ExactAverage one = average_of(pair.a, pair.b, OrientationLaw::fixed(0.3, 0.5, -0.2, 0.7));
    const ExactAverage other = average_of(pair.b, pair.a, OrientationLaw::fixed(0.3, -0.5, 0.2, -0.7));
    EXPECT_NEAR(one.excluded_volume, other.excluded_volume, 5.0 * (one.error + other.error)) << test_name(pair);
    EXPECT_LE(one.error, 1e-5 * one.excluded_volume);
  }
}

TEST(ExcludedVolumeAtAFixedOrientation, OfNeedlesIsNothingAndOfFlatBodiesItsSweep) {
  const OrientationLaw law = OrientationLaw::fixed(0.3, 0.5, -0.2, 0.7);
  const ExactAverage none = average_of("needle:2", "needle:1", law);
  EXPECT_EQ(none.excluded_volume, 0.0);
  EXPECT_LE(none.error, 1e-14);
  const double truth = kPi * 0.49 * 2.0 * std::fabs(matrix_of(law)[2][2]);
  EXPECT_NEAR(average_of("needle:2", "disc:0.7", law).excluded_volume, truth, 1e-13);
}

TEST(AverageOverUniformRotations, IsKiharasFormulaForEveryPair) {
  ExactAverageSettings settings = quick();
  settings.log2_n_points = 9;  // under sanitizers a pair takes a second
  for (const NamedPair& pair : unordered_pairs()) {
    const Body a = parse_shape(pair.a), b = parse_shape(pair.b);
    const double truth = average_excluded_volume(a.measures, b.measures);
    SCOPED_TRACE(test_name(pair));
    expect_average(exact_average(a, b, OrientationLaw::isotropic(), settings), truth, 1e-3);
  }
}

TEST(AverageOverUniformRotations, IsThatOfOnsagersLawWithoutOrder) {
  // The same rotations, through all that other laws need: normals on curved parts, faces that are picked.
  ExactAverageSettings settings = quick();
  settings.log2_n_points = 8;
  settings.series = false;
  double largest_off = 0.0;
  for (const NamedPair& pair : unordered_pairs()) {
    const Body a = parse_shape(pair.a), b = parse_shape(pair.b);
    const double truth = average_excluded_volume(a.measures, b.measures);
    SCOPED_TRACE(test_name(pair));
    const ExactAverage found = exact_average(a, b, OrientationLaw::onsager(0.0), settings);
    expect_average(found, truth, 5e-3);
    largest_off = std::max(largest_off, std::fabs(found.excluded_volume - truth) / found.error);
  }
  EXPECT_GT(largest_off, 1.5) << "the stated errors are too large to tell anything";
}

struct MeanSine {
  OrientationLaw law;
  double value;
};

TEST(AverageOverALaw, OfCapsulesFollowsFromTheMeanSine) {
  const double length = 1.5, r = 0.4;
  for (const MeanSine& known :
       {MeanSine{OrientationLaw::isotropic(), kPi / 4.0}, MeanSine{OrientationLaw::cone(10), .15674751},
        MeanSine{OrientationLaw::cone(30), .44088106}, MeanSine{OrientationLaw::cone(60), .71470601},
        MeanSine{OrientationLaw::cone(75), .77095325}, MeanSine{OrientationLaw::onsager(1), .78357786},
        MeanSine{OrientationLaw::onsager(5), .65087646}, MeanSine{OrientationLaw::onsager(10), .50912456},
        MeanSine{OrientationLaw::onsager(30), .31356589}, MeanSine{OrientationLaw::angle(30), .5},
        MeanSine{OrientationLaw::angle(135), std::sqrt(.5)}}) {
    const double truth =
        32.0 / 3.0 * kPi * r * r * r + 8.0 * kPi * length * r * r + 4.0 * length * length * r * known.value;
    SCOPED_TRACE(known.law.name());
    ExactAverageSettings settings = quick();
    for (const bool series : {false, true}) {
      settings.series = series;
      ExactAverage found = average_of("capsule:1.5,0.4", "capsule:1.5,0.4", known.law, settings);
      found.error += 1e-8;  // what the table's digits leave
      expect_average(found, truth, 1e-4);
    }
  }
}

TEST(AverageOverALaw, IsTheSameFromTheSeriesAndFromRandomPoints) {
  ExactAverageSettings settings = quick();
  settings.log2_n_points = 8;
  settings.series = false;
  for (const NamedPair& pair : unordered_pairs()) {
    const Body a = parse_shape(pair.a), b = parse_shape(pair.b);
    const std::optional<SeriesAverage> series = legendre_average(a, b, OrientationLaw::onsager(5.0));
    ASSERT_TRUE(series.has_value());
    SCOPED_TRACE(test_name(pair));
    EXPECT_LE(series->error, 2e-11 * series->excluded_volume);
    expect_average(exact_average(a, b, OrientationLaw::onsager(5.0), settings), series->excluded_volume, 1e-2);
  }
}

TEST(AverageOverALaw, OfEveryWidthOfTheConeIsTheSameFromTheSeries) {
  const Body box = parse_shape("box:0.2,1,3"), cylinder = parse_shape("cylinder:1,0.5");
  ExactAverageSettings settings = quick();
  settings.series = false;
  for (const double degrees : {15.0, 30.0, 60.0, 89.0}) {
    const std::optional<SeriesAverage> series = legendre_average(box, cylinder, OrientationLaw::cone(degrees));
    ASSERT_TRUE(series.has_value());
    EXPECT_LE(series->error, 1e-6 * series->excluded_volume);
    expect_average(exact_average(box, cylinder, OrientationLaw::cone(degrees), settings), series->excluded_volume,
                   2e-4);
  }
  EXPECT_NEAR(legendre_average(box, cylinder, OrientationLaw::cone(90))->excluded_volume,
              average_excluded_volume(box.measures, cylinder.measures), 1e-10);
  EXPECT_NEAR(legendre_average(box, cylinder, OrientationLaw::onsager(0))->excluded_volume,
              average_excluded_volume(box.measures, cylinder.measures), 1e-10);
}

TEST(LegendreAverage, WithoutOrderIsTheFormulaToElevenDigits) {
  // Its first term alone: what its quadrature makes of S and M.
  std::vector<std::string> bodies(kTestBodies.begin(), kTestBodies.end());
  bodies.insert(bodies.end(), {"ellipsoid:0.02,0.5,1.9", "ellipsoid:1,1,0.011", "rounded:0.1,ellipsoid:1,2,3"});
  const Body other = parse_shape("cone:1,0.5");
  for (const std::string& text : bodies) {
    const Body body = parse_shape(text);
    const std::optional<SeriesAverage> series = legendre_average(body, other, OrientationLaw::onsager(0.0));
    ASSERT_TRUE(series.has_value()) << text;
    const double truth = average_excluded_volume(body.measures, other.measures);
    EXPECT_NEAR(series->excluded_volume, truth, series->error) << text;
    EXPECT_LE(series->error, 2e-11 * truth) << text;
  }
}

/// Those of the highest degrees were 5e-6, by too few nodes where P_l waves fastest: every sum took 2048 degrees.
/// The recursion of 2048 steps rounds to 5e-13.
TEST(AxisMoments, OfASmoothLawFallToRounding) {
  for (const double strength : {-2.0, 3.0, 50.0, 900.0, -900.0}) {
    const AxisMoments moments = axis_moments(AxisLaw::maier_saupe(strength)).value();
    for (std::size_t l = 600; l < moments.by_degree.size(); ++l)
      ASSERT_NEAR(moments.by_degree[l], 0.0, 5e-13) << strength << " " << l;
  }
}

TEST(LegendreAverage, IsNothingForLawsAndBodiesItIsNotMadeFor) {
  const Body box = parse_shape("box:1,1,1"), ellipsoid = parse_shape("ellipsoid:1,2,300");
  EXPECT_FALSE(legendre_average(box, box, OrientationLaw::isotropic()).has_value());
  EXPECT_FALSE(legendre_average(box, box, OrientationLaw::aligned()).has_value());
  EXPECT_FALSE(legendre_average(box, box, OrientationLaw::cone(0)).has_value());
  EXPECT_FALSE(legendre_average(box, box, OrientationLaw::onsager(1e6)).has_value());
  EXPECT_FALSE(legendre_average(box, ellipsoid, OrientationLaw::onsager(5)).has_value());
}

TEST(LegendreAverage, AboutOtherAxesIsThatOfTheTurnedBody) {
  const Body cone = parse_shape("cone:1,0.5");
  const auto average = [&cone](const std::string& body, const OrientationLaw& law) {
    return legendre_average(parse_shape(body), cone, law);
  };
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, askew{1, -2, 2};
  const OrientationLaw law = OrientationLaw::onsager(4.0);
  struct Same {
    const char *body, *turned;
    Vec3d axis;
  };
  for (const Same& same :
       {Same{"box:3,2,1", "box:2,1,3", x}, Same{"box:3,2,1", "box:1,3,2", y},
        Same{"ellipsoid:3,2,1", "ellipsoid:2,1,3", x}, Same{"ellipsoid:3,2,1", "ellipsoid:3,1,2", y},
        Same{"ellipsoid:1,1,2", "ellipsoid:1,2,1", x}, Same{"hemisphere:1", "hemisphere:1", z},
        Same{"sphere:1", "sphere:1", askew}, Same{"rounded:0.2,box:3,2,1", "rounded:0.2,box:2,1,3", x}}) {
    SCOPED_TRACE(same.body);
    const std::optional<SeriesAverage> found = average(same.body, law.about(same.axis, z));
    ASSERT_TRUE(found.has_value());
    const std::optional<SeriesAverage> truth = average(same.turned, law);
    ASSERT_TRUE(truth.has_value());
    EXPECT_NEAR(found->excluded_volume, truth->excluded_volume, 3.0 * found->error);
  }
  EXPECT_FALSE(average("ellipsoid:3,2,1", law.about(askew, z)).has_value());
  // Bodies with every kind of part, odd degrees too: one law tells up from down.
  ExactAverageSettings settings = quick();
  settings.series = false;
  double largest_off = 0.0;
  const AxisLaw up = AxisLaw::table({{-1.0, 0.3, 1.0}, {0.1, 0.2, 2.0}});
  const OrientationLaw of_each = OrientationLaw::each(up, up);
  for (const std::string text : {"box:3,2,1", "tetrahedron:1", "cylinder:1,0.5", "cone:2,0.5", "capsule:1,0.5",
                                 "hemisphere:1", "disc:1", "frustum:1,0.7,0.3", "ellipsoid:1,1,2", "spindle:4,1"}) {
    SCOPED_TRACE(text);
    const Body body = parse_shape(text);
    for (const OrientationLaw& one : {law, of_each}) {
      const OrientationLaw about = one.about(askew, Vec3d{0, 0, -1});
      const std::optional<SeriesAverage> series = legendre_average(body, cone, about);
      ASSERT_TRUE(series.has_value());
      const ExactAverage found = exact_average(body, cone, about, settings);
      expect_average(found, series->excluded_volume, 1e-2);
      largest_off = std::max(largest_off, std::fabs(found.excluded_volume - series->excluded_volume) / found.error);
      EXPECT_GT(std::fabs(legendre_average(body, cone, one)->excluded_volume - series->excluded_volume), 1e-6);
    }
  }
  EXPECT_GT(largest_off, 0.5) << "the stated errors are too large to tell anything";
}

TEST(AverageOverALaw, OfANeedleAndADiscFollowsFromTheMeanCosine) {
  // A cone of 90 degrees is all directions: |cos gamma| is 1/2 on average.
  ExactAverageSettings settings = quick();
  settings.seed = 2;
  const ExactAverage one = average_of("needle:1", "disc:1", OrientationLaw::cone(90), settings);
  expect_average(one, kPi / 2.0, 2e-4);
}

TEST(AverageOverALaw, OfAMeshIsThatOfTheNamedBody) {
  const Body polyhedron = load(std::string(VEX_SAMPLE_BODIES) + "/icosahedron.obj");
  // The same size; its floats are good to 1e-7.
  const double edge = std::cbrt(polyhedron.measures.volume / (5.0 / 12.0 * (3.0 + std::sqrt(5.0))));
  const Body named = parse_shape("icosahedron:1", edge), other = parse_shape("rounded:0.1,box:1,2,3");
  for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::onsager(5.0)}) {
    const ExactAverage of_mesh = exact_average(polyhedron, other, law, quick()),
                       of_named = exact_average(named, other, law, quick());
    EXPECT_NEAR(of_mesh.excluded_volume, of_named.excluded_volume,
                5.0 * (of_mesh.error + of_named.error) + 1e-6 * of_named.excluded_volume)
        << law.name();
  }
}

TEST(AverageOverALaw, IsReproducible) {
  ExactAverageSettings settings = quick();
  settings.series = false;
  const ExactAverage one = average_of("cylinder:1,0.5", "box:1,2,3", OrientationLaw::onsager(5.0), settings);
  const ExactAverage again = average_of("cylinder:1,0.5", "box:1,2,3", OrientationLaw::onsager(5.0), settings);
  settings.seed = 99;
  const ExactAverage other = average_of("cylinder:1,0.5", "box:1,2,3", OrientationLaw::onsager(5.0), settings);
  EXPECT_EQ(one.excluded_volume, again.excluded_volume);
  EXPECT_EQ(one.error, again.error);
  EXPECT_NE(one.excluded_volume, other.excluded_volume);
  EXPECT_NEAR(one.excluded_volume, other.excluded_volume, 5.0 * (one.error + other.error));
}

TEST(AverageOverALaw, EndsWhereInterrupted) {
  const std::atomic<int> interrupt = 1;
  ExactAverageSettings settings = quick();
  settings.interrupt = &interrupt;
  settings.series = false;
  const ExactAverage found = average_of("cylinder:1,0.5", "box:1,2,3", OrientationLaw::onsager(5.0), settings);
  EXPECT_TRUE(std::isinf(found.error));
}

TEST(AverageOverALaw, RefusesABodyWithoutItsNormals) {
  Body box = parse_shape("box:1,1,1");
  box.normals = {};
  EXPECT_THROW(exact_average(box, parse_shape("box:1,1,1"), OrientationLaw::aligned()), UsageError);
  const Body cube = parse_shape("box:1,1,1");
  for (const ExactAverageSettings& wrong :
       {ExactAverageSettings{.n_randomisations = 1}, ExactAverageSettings{.n_randomisations = -5},
        ExactAverageSettings{.log2_n_points = -1}, ExactAverageSettings{.log2_n_points = 64},
        ExactAverageSettings{.largest_cost = NAN}}) {
    EXPECT_THROW(exact_average(cube, cube, OrientationLaw::aligned(), wrong), UsageError);
  }
}

}  // namespace
}  // namespace vex
