// V, S and M of the named bodies against the closed forms and values of the reference tables.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {
namespace {

constexpr double pi = std::numbers::pi;

void expect_measures(const std::string& text, double v, double s, double m) {
  const Measures found = parse_shape(text).measures;
  EXPECT_NEAR(found.volume, v, 1e-12 * v) << text;
  EXPECT_NEAR(found.surface_area, s, 1e-12 * s) << text;
  EXPECT_NEAR(found.integrated_mean_curvature, m, 1e-12 * m) << text;
}

TEST(Measures, OfSpheresBoxesAndCapsules) {
  expect_measures("sphere:2", 32 * pi / 3, 16 * pi, 8 * pi);
  expect_measures("box:1,2,3", 6, 22, 6 * pi);
  expect_measures("capsule:2,0.5", pi * 0.25 * 2 + pi / 6, 2 * pi * 0.5 * 2 + pi, 2 * pi + 2 * pi);
}

TEST(Measures, OfRoundBodiesWithEdges) {
  expect_measures("cylinder:2,0.5", pi / 2, 2.5 * pi, 2 * pi + pi * pi / 2);
  const double s = std::sqrt(10.0);  // slant height of the cone 3 high on a base of radius 1
  expect_measures("cone:3,1", pi, pi * (1 + s), 3 * pi + pi * (pi / 2 + std::atan(1.0 / 3)));
  const double alpha = std::atan(0.5);  // frustum 2 high, radii 2 and 1
  expect_measures("frustum:2,2,1", 14 * pi / 3, pi * (5 + 3 * std::sqrt(5.0)),
                  2 * pi + 2 * pi * (pi / 2 + alpha) + pi * (pi / 2 - alpha));
  const Measures upside_down = parse_shape("frustum:2,1,2").measures;
  EXPECT_NEAR(upside_down.integrated_mean_curvature, parse_shape("frustum:2,2,1").measures.integrated_mean_curvature,
              1e-13);
  expect_measures("frustum:2,0.5,0.5", pi / 2, 2.5 * pi, 2 * pi + pi * pi / 2);  // a cylinder
  expect_measures("hemisphere:2", 16 * pi / 3, 12 * pi, 2 * pi * (2 + pi / 2));
}

TEST(Measures, OfFlatBodiesCountBothSides) {
  expect_measures("disc:2", 0, 8 * pi, 2 * pi * pi);
  expect_measures("plate:2,3", 0, 12, 5 * pi);
  expect_measures("needle:3", 0, 0, 3 * pi);
}

TEST(Measures, OfRegularPolyhedra) {
  // ½ Σ edge · (π − dihedral), with the dihedral angles from tables.
  const double degree = pi / 180;
  expect_measures("tetrahedron:2", 8 / std::sqrt(72.0), 4 * std::sqrt(3.0), 6 * (180 - 70.528779365509308) * degree);
  expect_measures("octahedron:2", 8 * std::sqrt(2.0) / 3, 8 * std::sqrt(3.0), 12 * (180 - 109.47122063449069) * degree);
  expect_measures("dodecahedron:1", 7.6631189606246320, 20.645728807067603, 15 * (180 - 116.56505117707799) * degree);
  expect_measures("icosahedron:1", 2.1816949906249124, 8.6602540378443865, 15 * (180 - 138.18968510422140) * degree);
}

// Closed forms that cancel, in 50 digits.
using Digits50 = boost::multiprecision::cpp_bin_float_50;

void expect_digits(const std::string& text, const Digits50& v, const Digits50& s, const Digits50& m) {
  expect_measures(text, static_cast<double>(v), static_cast<double>(s), static_cast<double>(m));
}

TEST(Measures, OfBodiesOfCircularArcs) {
  const Digits50 exact_pi = boost::math::constants::pi<Digits50>();
  for (const double ratio : {1e-8, 1e-4, 0.01, 0.1, 0.5, 0.9, 0.99999999, 1.0}) {
    char lens[96], spindle[96], cut[96];
    std::snprintf(lens, sizeof lens, "lens:1.25,%.17g", 2.5 * ratio);
    std::snprintf(spindle, sizeof spindle, "spindle:2.5,%.17g", 1.25 * ratio);
    std::snprintf(cut, sizeof cut, "cut-sphere:1.25,%.17g,0.75", 1.25 * ratio);
    // h is what is less; the ball or arc of radius b has its middle c away.
    const Digits50 r = 1.25, h_lens = Digits50(2.5 * ratio) / 2, h_spindle = 1.25 * ratio;
    {
      const Digits50 h = h_lens, b = (r * r + h * h) / (2 * h), half_angle = asin(Digits50(r / b > 1 ? 1 : r / b));
      expect_digits(lens, 2 * exact_pi * h * h * (3 * b - h) / 3, 4 * exact_pi * b * h,
                    4 * exact_pi * h + exact_pi * r * (exact_pi - 2 * half_angle));
    }
    {
      const Digits50 h = h_spindle, b = (r * r + h * h) / (2 * h), c = b - h;
      const Digits50 a = asin(Digits50(r / b > 1 ? 1 : r / b));
      expect_digits(spindle, 2 * exact_pi * (r * (b * b + c * c) - r * r * r / 3 - c * (b * b * a + r * c)),
                    4 * exact_pi * b * (r - c * a), 2 * exact_pi * (2 * r - c * a));
    }
    {
      const Digits50 below = 1.25 * ratio, above = 0.75, cap_b = r - below, cap_t = r - above;
      const auto cap = [&](const Digits50& x) { return Digits50(exact_pi * x * x * (3 * r - x) / 3); };
      const Digits50 p = sqrt(Digits50(r * r - below * below)), q = sqrt(Digits50(r * r - above * above));
      expect_digits(cut, 4 * exact_pi * r * r * r / 3 - cap(cap_b) - cap(cap_t),
                    exact_pi * (4 * r * r - 2 * r * (cap_b + cap_t) + p * p + q * q),
                    exact_pi * (2 * (below + above) + p * acos(Digits50(below / r)) + q * acos(Digits50(above / r))));
    }
  }
  expect_measures("cut-sphere:2,2,2", 32 * pi / 3, 16 * pi, 8 * pi);
  expect_measures("egg:2,2,2", 32 * pi / 3, 16 * pi, 8 * pi);
  for (const double below : {1e-3, 0.7, 30.0}) {
    const Measures egg = parse_shape("egg:1," + std::to_string(below) + ",2").measures;
    const Measures p = parse_shape("ellipsoid:1,1," + std::to_string(below)).measures;
    const Measures q = parse_shape("ellipsoid:1,1,2").measures;
    EXPECT_NEAR(egg.volume, 2 * pi / 3 * (below + 2), 1e-14 * egg.volume);
    EXPECT_NEAR(egg.surface_area, 0.5 * (p.surface_area + q.surface_area), 1e-14 * egg.surface_area);
    EXPECT_NEAR(egg.integrated_mean_curvature, 0.5 * (p.integrated_mean_curvature + q.integrated_mean_curvature),
                1e-13);
  }
}

TEST(Measures, OfSuperellipsoidsAreThoseOfMpmath) {
  // superellipsoid_truth.py
  expect_measures("superball:0.75,1", 2.9427657258847144, 10.117514443002703, 11.391821969020966);
  expect_measures("superball:1.5,1", 5.6965835415098352, 15.727990725427815, 14.184614634544129);
  expect_measures("superball:4,1", 7.5167003621715319, 20.68461600574795, 16.860184075559684);
  expect_measures("superellipsoid:0.5,0.75,1,1.5,0.75", 1.4241458853774588, 6.5364702750509936, 9.3470437343707038);
  expect_measures("superellipsoid:1,1,5,3,1.25", 28.91541296891881, 63.329083641754067, 36.251344204111955);
  expect_measures("superellipsoid:1,2,3,0.625,6", 28.567161681623726, 61.015260536085535, 31.554110695296837);
}

TEST(Measures, OfSuperellipsoidsThatAreOtherBodies) {
  const auto are_alike = [](const std::string& text, const std::string& other) {
    const Measures m = parse_shape(other).measures;
    expect_measures(text, m.volume, m.surface_area, m.integrated_mean_curvature);
  };
  are_alike("superball:1,2", "sphere:2");
  are_alike("superellipsoid:1,2,3,1,1", "ellipsoid:1,2,3");
  are_alike("superellipsoid:0.03,2,1,1,1", "ellipsoid:0.03,2,1");
  are_alike("superellipsoid:1e30,2e30,3e30,1,1", "ellipsoid:1e30,2e30,3e30");
  are_alike("superball:0.5,1", "octahedron:1.4142135623730951");
  const double r = std::sqrt(0.5);  // a double pyramid on a square, 3 high each: twice the pyramid, without its base
  const Measures half = parse_shape("pyramid:4,1.4142135623730951,3").measures;
  const double slant = std::sqrt(9 + r * r);
  const Measures found = parse_shape("superellipsoid:1,1,3,0.5,0.5").measures;
  EXPECT_NEAR(found.volume, 2 * half.volume, 1e-12);
  EXPECT_NEAR(found.surface_area, 4 * std::sqrt(2.0) * slant, 1e-11);
  // Nearly a box, and nearly a cylinder: the mean width falls short by a multiple of 1/P.
  const Measures box = parse_shape("superellipsoid:1,2,3,1000,1000").measures, m = parse_shape("box:2,4,6").measures;
  EXPECT_LT(box.volume, m.volume);
  EXPECT_NEAR(box.volume, m.volume, 5e-3 * m.volume);
  EXPECT_NEAR(box.surface_area, m.surface_area, 5e-3 * m.surface_area);
  EXPECT_NEAR(box.integrated_mean_curvature, m.integrated_mean_curvature, 5e-3 * m.integrated_mean_curvature);
}

TEST(SolidMoments, OfSuperellipsoids) {
  const auto second = [](const char* text) { return parse_shape(text).moments->second; };
  const auto a = second("superellipsoid:1,2,3,1,1"), b = second("ellipsoid:1,2,3");
  const auto c = second("superball:0.5,1");             // of an octahedron with corners at 1 the moments are 2/15
  const auto d = second("superellipsoid:1,2,3,1,0.5");  // a double cone: pi a b c / 10 a^2 and pi a b c / 15 c^2
  const double pi_abc = 6 * pi;
  EXPECT_NEAR(a[0].x, b[0].x, 1e-13 * b[0].x);
  EXPECT_NEAR(a[1].y, b[1].y, 1e-13 * b[1].y);
  EXPECT_NEAR(a[2].z, b[2].z, 1e-13 * b[2].z);
  for (const double moment : {c[0].x, c[1].y, c[2].z}) EXPECT_NEAR(moment, 2.0 / 15, 1e-14);
  EXPECT_NEAR(d[0].x, pi_abc / 10, 1e-12);
  EXPECT_NEAR(d[1].y, pi_abc / 10 * 4, 1e-11);
  EXPECT_NEAR(d[2].z, pi_abc / 15 * 9, 1e-11);
}

/// Of a body about the z axis, by discs: from its support function alone, 400 000 normals of a meridian.
void expect_moments_by_discs(const std::string& text) {
  const Body body = parse_shape(text);
  constexpr int kNormals = 400'000;
  double volume = 0.0, first = 0.0, second = 0.0, across = 0.0;
  Vec3d before = body.body.support({1e-9, 0.0, -1.0});
  for (int k = 1; k < kNormals; ++k) {
    const double polar = pi * k / kNormals;
    const Vec3d at = body.body.support({std::sin(polar), 0.0, -std::cos(polar)});
    const double dz = at.z - before.z, x = 0.5 * (at.x + before.x), z = 0.5 * (at.z + before.z), disc = pi * x * x * dz;
    volume += disc;
    first += z * disc;
    second += z * z * disc;
    across += 0.25 * x * x * disc;
    before = at;
  }
  const double mean = first / volume;
  ASSERT_TRUE(body.moments.has_value());
  EXPECT_NEAR(body.moments->volume, volume, 1e-8 * volume) << text;
  EXPECT_NEAR(body.moments->centroid.z, mean, 1e-8) << text;
  EXPECT_NEAR(body.moments->second[0].x, across, 1e-8 * across) << text;
  EXPECT_NEAR(body.moments->second[1].y, across, 1e-8 * across) << text;
  EXPECT_NEAR(body.moments->second[2].z, second - mean * first, 1e-8 * second) << text;
}

TEST(SolidMoments, OfBodiesAboutAnAxisAreTheirDiscs) {
  for (const char* text : {"lens:0.9,0.7", "lens:1,0.1", "cut-sphere:0.8,0.3,0.6", "cut-sphere:1,1,0.2",
                           "spindle:1.8,0.5", "spindle:2,0.1", "egg:0.6,0.5,1.1", "hemisphere:0.8"}) {
    expect_moments_by_discs(text);
  }
}

TEST(Measures, OfPrismsAndPyramids) {
  expect_measures("prism:4,2,3", 12, 32, 7 * pi);  // a box
  for (const int n : {3, 5, 6, 50, 1000}) {
    for (const double h : {1e-6, 0.3, 2.0, 1e6}) {
      const double a = 0.7, apothem = a / (2 * std::tan(pi / n)), base = 0.5 * n * a * apothem;
      const double radius = a / (2 * std::sin(pi / n)), slant = std::hypot(h, apothem), lateral = std::hypot(h, radius);
      const auto text = [&](const char* name) {
        char of[96];
        std::snprintf(of, sizeof of, "%s:%d,%.17g,%.17g", name, n, a, h);
        return std::string(of);
      };
      expect_measures(text("prism"), base * h, 2 * base + n * a * h, pi * h + pi / 2 * n * a);
      // At the base the exterior angle has the tangent h / apothem from the other side; between two sides the normals
      // (h, apothem) / slant are turned by 2 pi / n about the axis.
      const double between = 2 * std::asin(h / slant * std::sin(pi / n));
      expect_measures(text("pyramid"), base * h / 3, base + 0.5 * n * a * slant,
                      0.5 * n * (a * (pi - std::atan2(h, apothem)) + lateral * between));
      // Normals (h, apothem - radius) / s of triangles: from one to the next, which looks down, and to the base.
      const double s = std::hypot(h, radius - apothem), down = (radius - apothem) / s, out = h / s;
      const double side = std::hypot(std::hypot(0.5 * a, radius - apothem), h);
      const double chord = 2 * std::hypot(out * std::sin(pi / (2 * n)), down), sum = 2 * out * std::cos(pi / (2 * n));
      const double step = 2 * std::atan2(chord, sum), to_base = std::atan2(out, down);
      // The section at half the height is regular, of 2n sides of a / 2 each.
      const double middle_area = 0.25 * n * a * a / (2 * std::tan(pi / (2 * n)));
      expect_measures(text("antiprism"), h / 6 * (2 * base + 4 * middle_area), 2 * base + n * a * s,
                      0.5 * (2 * n * side * step + 2 * n * a * to_base));
    }
  }
  EXPECT_NEAR(parse_shape("antiprism:3,1,0.81649658092772603").measures.volume, std::sqrt(2.0) / 3, 1e-14);
}

struct ArchimedeanValues {
  const char* name;
  std::size_t n_vertices, n_faces;
  double volume, surface_area, curvature;  // the last in degrees, of edges 1
};

TEST(Measures, OfArchimedeanSolids) {
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0), r5 = std::sqrt(5.0), degree = pi / 180;
  const auto angle = [&](double cosine) { return std::acos(cosine) / degree; };
  const double tetra = angle(1 / 3.0), octa = 180 - tetra, a = angle(-1 / r3), b = angle(-r2 / r3);
  const double dodeca = 180 - std::atan(2.0) / degree, icosa = angle(-r5 / 3);
  const double c = angle(-std::sqrt((5 + 2 * r5) / 15)), d = angle(-(r3 + r3 * r5) / 6);
  const double e = angle(-std::sqrt((5 + r5) / 10));
  const double pentagons = 3 * std::sqrt(25 + 10 * r5);
  const double t = 1.8392867552141612;  // the tribonacci constant
  const std::initializer_list<ArchimedeanValues> all = {
      {"truncated-tetrahedron", 12, 8, 23 * r2 / 12, 7 * r3, 6 * (180 - tetra) + 12 * (180 - octa)},
      {"cuboctahedron", 12, 14, 5 * r2 / 3, 6 + 2 * r3, 24 * (180 - a)},
      {"truncated-cube", 24, 14, (21 + 14 * r2) / 3, 12 + 12 * r2 + 2 * r3, 12 * 90.0 + 24 * (180 - a)},
      {"truncated-octahedron", 24, 14, 8 * r2, 6 + 12 * r3, 12 * (180 - octa) + 24 * (180 - a)},
      {"rhombicuboctahedron", 24, 26, (12 + 10 * r2) / 3, 18 + 2 * r3, 24 * 45.0 + 24 * (180 - b)},
      {"truncated-cuboctahedron", 48, 26, 22 + 14 * r2, 12 * (2 + r2 + r3), 24 * ((180 - b) + 45 + (180 - a))},
      {"snub-cube", 24, 38, (8 * t + 6) / (3 * std::sqrt(2 * (t * t - 3))), 6 + 8 * r3,
       36 * (180 - 153.2345877) + 24 * (180 - 142.9834301)},
      {"icosidodecahedron", 30, 32, (45 + 17 * r5) / 6, 5 * r3 + pentagons, 60 * (180 - c)},
      {"truncated-dodecahedron", 60, 32, 5 * (99 + 47 * r5) / 12, 5 * (r3 + 6 * std::sqrt(5 + 2 * r5)),
       30 * (180 - dodeca) + 60 * (180 - c)},
      {"truncated-icosahedron", 60, 32, (125 + 43 * r5) / 4, 30 * r3 + pentagons, 30 * (180 - icosa) + 60 * (180 - c)},
      {"rhombicosidodecahedron", 60, 62, (60 + 29 * r5) / 3, 30 + 5 * r3 + pentagons, 60 * ((180 - d) + (180 - e))},
      {"truncated-icosidodecahedron", 120, 62, 95 + 50 * r5, 30 * (1 + r3 + std::sqrt(5 + 2 * r5)),
       60 * ((180 - d) + (180 - e) + (180 - c))},
      {"snub-dodecahedron", 60, 92, 37.61664996273336, 20 * r3 + pentagons,
       90 * (180 - 164.1753661) + 60 * (180 - 152.9299202)}};
  for (const ArchimedeanValues& of : all) {
    const Body body = parse_shape(std::string(of.name) + ":1");
    EXPECT_EQ(vertices_of(body.body).size(), of.n_vertices) << of.name;
    EXPECT_EQ(body.n_faces, of.n_faces) << of.name;
    const bool is_snub = std::string_view(of.name).starts_with("snub");  // whose angles are known to seven digits
    const double m = 0.5 * of.curvature * degree;
    EXPECT_NEAR(body.measures.volume, of.volume, 1e-13 * of.volume) << of.name;
    EXPECT_NEAR(body.measures.surface_area, of.surface_area, 1e-13 * of.surface_area) << of.name;
    EXPECT_NEAR(body.measures.integrated_mean_curvature, m, (is_snub ? 2e-8 : 1e-13) * m) << of.name;
  }
}

TEST(Measures, OfRoundedBodiesAreSteiners) {
  expect_measures("rounded:0.5,needle:2", pi * 0.25 * 2 + pi / 6, 2 * pi * 0.5 * 2 + pi, 2 * pi + 2 * pi);
  expect_measures("rounded:0.5,sphere:1.5", 32 * pi / 3, 16 * pi, 8 * pi);
  expect_measures("rounded:1,box:1,2,3", 6 + 22 + 6 * pi + 4 * pi / 3, 22 + 12 * pi + 4 * pi, 10 * pi);
  expect_measures("rounded:1,plate:2,3", 12 + 5 * pi + 4 * pi / 3, 12 + 10 * pi + 4 * pi, 9 * pi);
}

TEST(Measures, OfEllipsoidsThatAreSpheroids) {
  // Closed forms of a spheroid with semi-axes a, a, c: S by asin or atanh of the eccentricity, M likewise.
  for (const double c : {0.01, 0.5, 0.999, 1.001, 2.0, 100.0}) {
    const double a = 1.0;
    double s = 0.0, m = 0.0;
    if (c > a) {
      const double e = std::sqrt(1 - a * a / (c * c));
      s = 2 * pi * a * a * (1 + c / (a * e) * std::asin(e));
      m = 2 * pi * (c + a * a / (c * e) * std::atanh(e));
    } else {
      const double e = std::sqrt(1 - c * c / (a * a));
      s = 2 * pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));
      m = 2 * pi * (c + a / e * std::asin(e));
    }
    const Measures found = parse_shape("ellipsoid:1,1," + std::to_string(c)).measures;
    EXPECT_NEAR(found.surface_area, s, 1e-10 * s) << c;
    EXPECT_NEAR(found.integrated_mean_curvature, m, 1e-10 * m) << c;
    EXPECT_NEAR(found.volume, 4 * pi / 3 * c, 1e-12 * c);
  }
}

TEST(Measures, DoNotDependOnTheOrderOfAxesAndScaleAsTheyShould) {
  const Measures one = parse_shape("ellipsoid:1,2,3").measures;
  for (const char* text : {"ellipsoid:1,3,2", "ellipsoid:2,1,3", "ellipsoid:3,2,1"}) {
    const Measures other = parse_shape(text).measures;
    EXPECT_NEAR(other.surface_area, one.surface_area, 1e-13 * one.surface_area);
    EXPECT_NEAR(other.integrated_mean_curvature, one.integrated_mean_curvature, 1e-13 * one.integrated_mean_curvature);
  }
  const Measures large = parse_shape("ellipsoid:1e30,2e30,3e30").measures;
  EXPECT_NEAR(large.surface_area, 1e60 * one.surface_area, 1e48 * one.surface_area);
  EXPECT_NEAR(large.integrated_mean_curvature, 1e30 * one.integrated_mean_curvature,
              1e18 * one.integrated_mean_curvature);
}

TEST(AverageExcludedVolume, OfIdenticalBodiesIsTheReferenceTable) {
  const auto reduced = [](const std::string& text) {
    const Measures m = parse_shape(text).measures;
    return average_excluded_volume(m, m) / m.volume;
  };
  const auto near = [](double value) { return 1e-9 * value; };
  for (const auto& [text, value] :
       std::initializer_list<std::pair<const char*, double>>{{"box:1,1,1", 11.0},
                                                             {"sphere:0.7", 8.0},
                                                             {"ellipsoid:1,2,3", 10.173618525},
                                                             {"ellipsoid:1,.5,.1", 21.463178620},
                                                             {"ellipsoid:1,1,3", 10.907497949},
                                                             {"ellipsoid:10,1,1", 26.382647049},
                                                             {"ellipsoid:1,100,1", 237.755981372},
                                                             {"capsule:1,.5", 9.2},
                                                             {"capsule:5,.5", 16.823529412},
                                                             {"capsule:100,.5", 206.675496689},
                                                             {"tetrahedron:1", 15.407431604},
                                                             {"octahedron:2", 10.637976081},
                                                             {"dodecahedron:3", 9.121016679},
                                                             {"icosahedron:.1", 8.915264469},
                                                             {"hemisphere:1", 10.034291735},
                                                             {"cylinder:.1,.5", 22.04955592},
                                                             {"cylinder:1,.5", 9.71238898},
                                                             {"cylinder:10,.5", 26.29867229},
                                                             {"cone:.1,.5", 49.62996171},
                                                             {"cone:1,.5", 11.79180112},
                                                             {"cone:10,.5", 36.09320230},
                                                             {"ellipsoid:1,32,1", 77.74058929613692},
                                                             {"ellipsoid:1,16,1", 40.28121631695408},
                                                             {"ellipsoid:8,1,1", 21.81043465534018},
                                                             {"ellipsoid:1,.25,.25", 12.95579781064419},
                                                             {"ellipsoid:.5,.5,1", 9.07697331038283}}) {
    EXPECT_NEAR(reduced(text), value, std::max(near(value), 6e-10)) << text;
  }
  // Boxes of unit volume, Table I: 2 (1 + M S / 4 pi).
  for (const auto& [k, value] : std::initializer_list<std::pair<double, double>>{{1e-6, 2000007.000002},
                                                                                 {0.01, 207.02},
                                                                                 {0.5, 12.0},
                                                                                 {0.8, 11.1},
                                                                                 {2, 12},
                                                                                 {8, 23.25},
                                                                                 {32, 71.0625},
                                                                                 {64, 135.03125}}) {
    const double l2 = std::cbrt(1.0 / k);
    char text[128];
    std::snprintf(text, sizeof text, "box:%.17g,%.17g,%.17g", k * l2, l2, l2);
    EXPECT_NEAR(reduced(text), value, near(value)) << k;
  }
}

TEST(AverageExcludedVolume, OfDifferentBodies) {
  const double radius = std::cbrt(3.0 / (4.0 * pi));
  char sphere[64];
  std::snprintf(sphere, sizeof sphere, "sphere:%.17g", radius);
  EXPECT_NEAR(average_excluded_volume(parse_shape(sphere).measures, parse_shape("box:1,1,1").measures), 9.34908484193,
              1e-9 * 9.35);
  const Measures capsule = parse_shape("capsule:1,0.25").measures;
  EXPECT_NEAR(average_excluded_volume(capsule, capsule), 2.87979326579, 1e-9 * 2.88);
}

}  // namespace
}  // namespace vex
