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
  int n_directions = 1500;  // fewer where a power of fifty digits is taken for each
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

/// What two balls share whose middles are c below and above: h thick above the plane of its rim, of radius r.
Formula lens(const std::string& text, double radius, double thickness) {
  const Real r = radius, h = Real(thickness) / 2, ball = (r * r + h * h) / (2 * h), c = ball - h;
  return {text,
          [=](const Point& d) {
            const Real across = length(d.x, d.y), all = length(d.x, d.y, d.z);
            return across * ball > r * all ? Real(r * across) : Real(ball * all - c * abs(d.z));
          },
          [=](const Point& p) {
            const Real across = length(p.x, p.y), z = abs(p.z) + c, from_middle = length(across, z);
            if (from_middle <= ball) return Real(0);
            return ball * z >= c * from_middle ? Real(from_middle - ball) : length(across - r, p.z);
          }};
}

Formula cut_sphere(const std::string& text, double radius, double below, double above) {
  const Real r = radius, b = below, t = above, p = sqrt(Real(r * r - b * b)), q = sqrt(Real(r * r - t * t));
  return {text,
          [=](const Point& d) {
            const Real across = length(d.x, d.y), all = length(d.x, d.y, d.z);
            if (r * d.z > t * all) return Real(q * across + t * d.z);
            if (-r * d.z > b * all) return Real(p * across - b * d.z);
            return Real(r * all);
          },
          [=](const Point& x) {
            const Real across = length(x.x, x.y), all = length(x.x, x.y, x.z);
            if (all > r && r * x.z <= t * all && -r * x.z <= b * all) return Real(all - r);
            if (x.z > t) return length(positive(across - q), x.z - t);
            if (-x.z > b) return length(positive(across - p), x.z + b);
            return Real(0);
          }};
}

/// The arc of a circle of radius `arc` about (-c, 0) in the half plane (rho, z), h the height of the tip.
Formula spindle(const std::string& text, double height, double radius) {
  const Real h = Real(height) / 2, r = radius, arc = (h * h + r * r) / (2 * r), c = arc - r;
  return {text,
          [=](const Point& d) {
            const Real across = length(d.x, d.y), all = length(d.x, d.y, d.z);
            return abs(d.z) * arc > h * all ? Real(h * abs(d.z)) : Real(arc * all - c * across);
          },
          [=](const Point& p) {
            const Real across = length(p.x, p.y) + c, from_middle = length(across, p.z);
            if (from_middle <= arc) return Real(0);
            return arc * across >= c * from_middle ? Real(from_middle - arc) : length(across - c, abs(p.z) - h);
          }};
}

Formula egg(const std::string& text, double radius, double below, double above) {
  const Formula lower = ellipsoid("", radius, radius, below), upper = ellipsoid("", radius, radius, above);
  return {text, [=](const Point& d) { return d.z > 0 ? upper.support_function(d) : lower.support_function(d); },
          [=](const Point& p) { return p.z > 0 ? upper.outside(p) : lower.outside(p); }};
}

/// (u^p + v^p)^(1/p), of p = infinity the larger of the two; one over p is given.
Real power_norm(const Real& u, const Real& v, const Real& inverse) {
  const Real largest = std::max(u, v), least = std::min(u, v);
  if (largest == 0 || least == 0 || inverse == 0) return largest;
  return largest * pow(Real(1 + pow(Real(least / largest), Real(1 / inverse))), inverse);
}

/// Its support function is the dual norm of the direction.
Formula superellipsoid(const std::string& text, double a, double b, double c, double across, double along) {
  const Real x = a, y = b, z = c, p = 1 / (2 * Real(across)), q = 1 / (2 * Real(along)), most = std::max({a, b, c});
  return {
      text,
      [=](const Point& d) { return power_norm(power_norm(x * abs(d.x), y * abs(d.y), 1 - p), z * abs(d.z), 1 - q); },
      [=](const Point& at) {
        const Real gauge = power_norm(power_norm(abs(at.x) / x, abs(at.y) / y, p), abs(at.z) / z, q);
        return Real(2 * most * positive(gauge - 1));
      },
      60};
}
Formula superball(const std::string& text, double exponent, double radius) {
  return superellipsoid(text, radius, radius, radius, exponent, exponent);
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
          lens("lens:0.9,0.7", 0.9, 0.7),
          lens("lens:1,1e-8", 1, 1e-8),
          lens("lens:1,2", 1, 2),
          lens("lens:1,1.9999999999999", 1, 1.9999999999999),
          cut_sphere("cut-sphere:0.8,0.3,0.6", 0.8, 0.3, 0.6),
          cut_sphere("cut-sphere:1,1e-9,0.99999999999", 1, 1e-9, 0.99999999999),
          cut_sphere("cut-sphere:1,1,1e-3", 1, 1, 1e-3),
          spindle("spindle:1.8,0.5", 1.8, 0.5),
          spindle("spindle:2,1e-8", 2, 1e-8),
          spindle("spindle:2,1", 2, 1),
          spindle("spindle:2,0.9999999999", 2, 0.9999999999),
          egg("egg:0.6,0.5,1.1", 0.6, 0.5, 1.1),
          egg("egg:1,1e-6,1e3", 1, 1e-6, 1e3),
          superball("superball:0.7,0.8", 0.7, 0.8),
          superball("superball:4,0.6", 4, 0.6),
          superball("superball:0.5,1", 0.5, 1),
          superball("superball:0.5000001,1", 0.5000001, 1),
          superball("superball:1000,1", 1000, 1),
          superellipsoid("superellipsoid:0.5,0.7,0.9,1.5,0.75", 0.5, 0.7, 0.9, 1.5, 0.75),
          superellipsoid("superellipsoid:1e-3,1,1e2,0.6,30", 1e-3, 1, 1e2, 0.6, 30),
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
  for (int k = 0; k < formula_.n_directions; ++k) {
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
  for (int k = 0; k < formula_.n_directions && (rise != 0.0 || run != 0.0); ++k) {
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
