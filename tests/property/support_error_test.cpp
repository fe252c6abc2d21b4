// What `support_error` promises (E2), against closed forms in 50 digits: the support point lies within it of the body,
// and no point of the body is farther along the direction by more than it times the direction's length. Directions of
// every length that a query uses, and those where a body's rims, faces and edges tie.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <functional>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
struct Point {
  Real x, y, z;
};

Point exactly(const Vec3d& p) { return {p.x, p.y, p.z}; }
Real inner(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real length(const Real& x, const Real& y, const Real& z = 0) { return sqrt(Real(x * x + y * y + z * z)); }
Real positive(const Real& x) { return x > 0 ? x : Real(0); }

/// A body as a formula: its support function, and how far outside it a point is (0 inside; an upper bound is fine).
struct Formula {
  std::string text;  // as parse_shape reads it
  std::function<Real(const Point& dir)> support_function;
  std::function<Real(const Point& point)> outside;
};

/// The distance of a point of the half plane (rho, z) from a segment.
Real to_segment(const std::array<Real, 2>& p, const std::array<Real, 2>& a, const std::array<Real, 2>& b) {
  const Real ex = b[0] - a[0], ez = b[1] - a[1], sq = ex * ex + ez * ez;
  Real t = sq > 0 ? Real(((p[0] - a[0]) * ex + (p[1] - a[1]) * ez) / sq) : Real(0);
  t = t < 0 ? Real(0) : t > 1 ? Real(1) : t;
  return length(p[0] - a[0] - t * ex, p[1] - a[1] - t * ez);
}

/// The body of revolution between the discs of radius `lower` at -h/2 and `upper` at h/2.
Formula revolved(const std::string& text, double height, double lower, double upper) {
  const Real z0 = -Real(height) / 2, z1 = Real(height) / 2, p = lower, q = upper;
  const auto support_function = [=](const Point& d) {
    const Real across = length(d.x, d.y);
    return std::max(Real(p * across + z0 * d.z), Real(q * across + z1 * d.z));
  };
  const auto outside = [=](const Point& point) {
    const std::array<Real, 2> at{length(point.x, point.y), point.z};
    const bool between = at[1] >= z0 && at[1] <= z1;
    const Real radius = height > 0 ? Real(p + (q - p) * (at[1] - z0) / (z1 - z0)) : p;
    if (between && at[0] <= radius) return Real(0);
    return std::min(
        {to_segment(at, {0, z0}, {p, z0}), to_segment(at, {p, z0}, {q, z1}), to_segment(at, {0, z1}, {q, z1})});
  };
  return {text, support_function, outside};
}

Formula hemisphere(const std::string& text, double radius) {
  const Real r = radius;
  return {text, [=](const Point& d) { return Real(r * (d.z > 0 ? length(d.x, d.y, d.z) : length(d.x, d.y))); },
          [=](const Point& p) {
            if (p.z >= 0) return positive(length(p.x, p.y, p.z) - r);
            return length(positive(length(p.x, p.y) - r), p.z);
          }};
}

/// All points within `radius` of a box of these half edges, of which some may be 0.
Formula rounded_box(const std::string& text, double radius, double a, double b, double c) {
  const Real r = radius, x = a, y = b, z = c;
  return {text,
          [=](const Point& d) { return Real(r * length(d.x, d.y, d.z) + x * abs(d.x) + y * abs(d.y) + z * abs(d.z)); },
          [=](const Point& p) {
            return positive(length(positive(abs(p.x) - x), positive(abs(p.y) - y), positive(abs(p.z) - z)) - r);
          }};
}

Formula ellipsoid(const std::string& text, double a, double b, double c) {
  const Real x = a, y = b, z = c, most = std::max({a, b, c});
  return {text, [=](const Point& d) { return length(x * d.x, y * d.y, z * d.z); },
          [=](const Point& p) { return Real(most * positive(length(p.x / x, p.y / y, p.z / z) - 1)); }};
}

std::vector<Formula> formulas() {
  return {rounded_box("sphere:0.6", 0.6, 0, 0, 0),
          rounded_box("box:0.2,1,3", 0, 0.1, 0.5, 1.5),
          ellipsoid("ellipsoid:1,2,3", 1, 2, 3),
          ellipsoid("ellipsoid:1e-6,1,1e6", 1e-6, 1, 1e6),
          rounded_box("capsule:1,0.25", 0.25, 0, 0, 0.5),
          revolved("cylinder:1,0.5", 1, 0.5, 0.5),
          revolved("cylinder:1e-9,0.7", 1e-9, 0.7, 0.7),
          revolved("cone:1,0.5", 1, 0.5, 0),
          revolved("cone:1e-8,0.9", 1e-8, 0.9, 0),
          revolved("cone:1e8,0.3", 1e8, 0.3, 0),
          revolved("frustum:1,0.7,0.3", 1, 0.7, 0.3),
          revolved("frustum:0.1,0.3,0.9", 0.1, 0.3, 0.9),
          revolved("frustum:1,0.7,0.6999999999999999", 1, 0.7, 0.6999999999999999),
          hemisphere("hemisphere:0.8", 0.8),
          revolved("disc:0.7", 0, 0.7, 0.7),
          rounded_box("plate:1,1.3", 0, 0.5, 0.65, 0),
          rounded_box("needle:2", 0, 0, 0, 1),
          rounded_box("rounded:0.2,plate:1,0.8", 0.2, 0.5, 0.4, 0),
          rounded_box("rounded:1e-7,box:3,2,1", 1e-7, 1.5, 1, 0.5)};
}

TEST(SupportErrors, EveryKindOfBodyHasItsFormulaHere) {
  const std::vector<Formula> all = formulas();
  for (const NamedShape& shape : named_shapes()) {
    const std::string prefix = std::string(shape.name) + ":";
    // Vertices of a Polytope: polytope_test.
    const bool is_polyhedron = shape.parameters == "E" || shape.parameters == "N,A,H";
    EXPECT_TRUE(is_polyhedron ||
                std::ranges::any_of(all, [&](const Formula& formula) { return formula.text.rfind(prefix, 0) == 0; }))
        << "what " << shape.name << " claims of its rounding is not tested";
  }
}

class SupportError : public testing::TestWithParam<Formula> {
 protected:
  const Formula& formula_ = GetParam();
  const ConvexBody body_ = parse_shape(formula_.text).body;

  void expect_kept(const Vec3d& dir) {
    const Point d = exactly(dir), p = exactly(body_.support(dir));
    const Real error = body_.support_error();
    const Real outside = formula_.outside(p);
    ASSERT_LE(outside, error) << formula_.text << " along " << dir.x << " " << dir.y << " " << dir.z;
    const Real shortfall = (formula_.support_function(d) - inner(d, p)) / length(d.x, d.y, d.z);
    ASSERT_LE(shortfall, error) << formula_.text << " along " << dir.x << " " << dir.y << " " << dir.z;
  }
};

TEST_P(SupportError, IsNeverExceeded) {
  std::mt19937_64 random(71);
  for (int k = 0; k < 1500; ++k) {
    const Vec3d dir = random_direction(random);
    expect_kept(dir);
    expect_kept(0x1p-99 * dir);
    expect_kept(0x1p99 * dir);
    // Nearly along an axis, down to where a square vanishes.
    const double small = std::ldexp(1.0, -static_cast<int>(random() % 1000));
    expect_kept({small * dir.x, small * dir.y, dir.z});
    expect_kept({dir.x, dir.y, small * dir.z});
    expect_kept({small * dir.x, dir.y, dir.z});
  }
  for (const double x : {-1.0, -0.0, 0.0, 1.0}) {
    for (const double y : {-1.0, -0.0, 0.0, 1.0}) {
      for (const double z : {-1.0, -0.0, 0.0, 1.0}) {
        if (x != 0.0 || y != 0.0 || z != 0.0) expect_kept({x, y, z});
      }
    }
  }
}

TEST_P(SupportError, NorWhereTwoRimsTie) {
  // The directions across the mantle of a frustum of these sizes; for other bodies, directions like any other.
  std::mt19937_64 random(73);
  const Vec3d top = body_.support(Vec3d{1e-3, 0, 1}), bottom = body_.support(Vec3d{1e-3, 0, -1});
  const double rise = top.z - bottom.z, run = bottom.x - top.x;
  for (int k = 0; k < 1500 && (rise != 0.0 || run != 0.0); ++k) {
    const Vec3d around = random_direction(random);
    const double across = std::sqrt(around.x * around.x + around.y * around.y);
    const double nudge = 1.0 + 0x1p-50 * (static_cast<double>(random() % 64) - 32.0);
    expect_kept({around.x / across * rise, around.y / across * rise, run * nudge});
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, SupportError, testing::ValuesIn(formulas()), [](const auto& formula) {
  std::string name = formula.param.text;
  for (char& c : name) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) c = '_';
  }
  return name;
});

}  // namespace
}  // namespace vex
