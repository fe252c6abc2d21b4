// The first meeting of two polytopes is what all subsets of their differences' points say, in rational numbers.
#include "engine/query/exact/first_meeting.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "engine/numeric/quaternion.h"
#include "engine/query/first_contact.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exactly(double x) { return Rational(x); }

/// The unique x of the columns' combination that is (0, 0, 0, 1); none where the columns are dependent, or where there
/// is no such combination.
std::optional<std::vector<Rational>> solution(const std::vector<std::array<Rational, 4>>& columns) {
  const std::size_t n = columns.size();
  std::vector<std::vector<Rational>> rows(4, std::vector<Rational>(n + 1));
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < n; ++k) rows[r][k] = columns[k][r];
    rows[r][n] = r == 3 ? 1 : 0;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < 4 && rows[pivot][k] == 0) ++pivot;
    if (pivot == 4) return std::nullopt;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == k || rows[r][k] == 0) continue;
      const Rational factor = rows[r][k] / rows[k][k];
      for (std::size_t c = k; c <= n; ++c) rows[r][c] -= factor * rows[k][c];
    }
  }
  for (std::size_t r = n; r < 4; ++r) {
    if (rows[r][n] != 0) return std::nullopt;
  }
  std::vector<Rational> x(n);
  for (std::size_t k = 0; k < n; ++k) x[k] = rows[k][n] / rows[k][k];
  return x;
}

/// A least t >= 0 is one of a basic solution: of at most three points and the time, or of four points at time 0.
std::optional<Rational> least_time(const std::vector<std::array<Rational, 3>>& points,
                                   const std::array<Rational, 3>& motion) {
  std::optional<Rational> least;
  const auto consider = [&](const std::vector<std::size_t>& set, bool with_time) {
    std::vector<std::array<Rational, 4>> columns;
    for (const std::size_t i : set) columns.push_back({points[i][0], points[i][1], points[i][2], Rational(1)});
    if (with_time) columns.push_back({-motion[0], -motion[1], -motion[2], Rational(0)});
    const std::optional<std::vector<Rational>> x = solution(columns);
    if (!x) return;
    for (const Rational& value : *x) {
      if (value < 0) return;
    }
    const Rational time = with_time ? x->back() : Rational(0);
    if (!least || time < *least) least = time;
  };
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    consider({i}, true);
    for (std::size_t j = i + 1; j < n; ++j) {
      consider({i, j}, true);
      for (std::size_t k = j + 1; k < n; ++k) {
        consider({i, j, k}, true);
        for (std::size_t l = k + 1; l < n; ++l) consider({i, j, k, l}, false);
      }
    }
  }
  return least;
}

ConvexBody hull_of(const std::vector<Vec3d>& vertices) {
  Vec3d centre;
  for (const Vec3d& v : vertices) centre = centre + (1.0 / static_cast<double>(vertices.size())) * v;
  return Polytope(vertices, centre, 0.0);
}

TEST(FirstMeeting, IsThatOfAllSubsets) {
  std::mt19937_64 random(5);
  int n_hits = 0, n_misses = 0, n_at_once = 0;
  for (int k = 0; k < 320; ++k) {
    // Few whole coordinates: flat bodies, motions along faces and edges, contacts of corners, and all that at once.
    const int range = 1 + static_cast<int>(random() % 3);
    const double unit = std::ldexp(1.0, static_cast<int>(random() % 100) - 50);
    const auto whole = [&] {
      return unit * static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * range + 1)) - range);
    };
    const auto vertices = [&](double from) {
      std::vector<Vec3d> all;
      const std::size_t n = 1 + random() % 4;
      for (std::size_t i = 0; i < n; ++i) all.push_back({whole() + from * unit, whole(), whole()});
      return all;
    };
    const std::vector<Vec3d> a = vertices(0.0), b = vertices(static_cast<double>(random() % 4));
    Vec3d motion{whole() / unit, whole() / unit, whole() / unit};
    if (!(norm_1(motion) > 0.0)) motion = {-1.0, 0.0, 0.0};
    std::vector<std::array<Rational, 3>> points;
    for (const Vec3d& p : a) {
      for (const Vec3d& q : b) {
        points.push_back({exactly(p.x) - exactly(q.x), exactly(p.y) - exactly(q.y), exactly(p.z) - exactly(q.z)});
      }
    }
    const std::optional<Rational> truth = least_time(points, {exactly(motion.x), exactly(motion.y), exactly(motion.z)});
    const std::optional<PlacedForms> forms = placed_forms(hull_of(a), hull_of(b), {});
    ASSERT_TRUE(forms.has_value());
    const FirstMeeting found = first_meeting(*forms, motion);
    ASSERT_EQ(found.is_hit, truth.has_value()) << k;
    // What the cast says of it, by any stage.
    const FirstContact cast = linear_cast(hull_of(a), hull_of(b), Transformd{}, motion);
    ASSERT_EQ(cast.verdict.outcome, truth ? Outcome::overlap : Outcome::disjoint) << k;
    if (!truth) {
      ++n_misses;
      continue;
    }
    ASSERT_LE(exactly(found.lower), *truth) << k;
    ASSERT_GE(exactly(found.upper), *truth) << k;
    ASSERT_LE(found.upper, found.lower * (1.0 + 0x1p-48)) << k;
    ASSERT_LE(exactly(cast.lower), *truth) << k;
    ASSERT_GE(exactly(cast.upper), *truth) << k;
    ++(*truth == 0 ? n_at_once : n_hits);
  }
  EXPECT_GT(n_hits, 15);
  EXPECT_GT(n_misses, 15);
  EXPECT_GT(n_at_once, 5);
}

// Coordinates of all digits, and a motion that passes a corner, an edge or a face by a last place or meets it: where
// B's corner would come to, it is moved back by what the doubles allow.
TEST(FirstMeeting, IsRightByALastPlace) {
  std::mt19937_64 random(6);
  const auto number = [&random] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
  int n_hits = 0, n_misses = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<Vec3d> a;
    for (int i = 0; i < 4; ++i) a.push_back({number(), number(), number()});
    const Vec3d motion{number(), number(), -1.0};
    // Onto a corner, or a point of an edge.
    const double share = k % 2 == 0 ? 0.0 : 0.5 * (1.0 + number());
    const Vec3d target = a[0] + share * (a[1] - a[0]);
    const std::vector<Vec3d> b = {target - 3.0 * motion};
    std::vector<std::array<Rational, 3>> points;
    for (const Vec3d& p : a) {
      points.push_back(
          {exactly(p.x) - exactly(b[0].x), exactly(p.y) - exactly(b[0].y), exactly(p.z) - exactly(b[0].z)});
    }
    const std::optional<Rational> truth = least_time(points, {exactly(motion.x), exactly(motion.y), exactly(motion.z)});
    const FirstContact cast = linear_cast(hull_of(a), hull_of(b), Transformd{}, motion);
    ASSERT_EQ(cast.verdict.outcome, truth ? Outcome::overlap : Outcome::disjoint) << k;
    if (truth) {
      ASSERT_LE(exactly(cast.lower), *truth) << k;
      ASSERT_GE(exactly(cast.upper), *truth) << k;
    }
    ++(truth ? n_hits : n_misses);
  }
  EXPECT_GT(n_hits, 20);
  EXPECT_GT(n_misses, 20);
}

// Casts of plain, flat and thin polytopes anywhere, at a place of a lattice, or above each other by next to nothing;
// and motions across, along axes, and at each other.
TEST(FirstMeeting, IsWhatCastsSay) {
  std::mt19937_64 random(8);
  const auto number = [&random] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
  std::vector<ConvexBody> bodies;
  for (const char* const text : {"box:1,1,1", "box:1,1,1e-9", "box:1,1e-12,1", "plate:1,1", "needle:2", "tetrahedron:1",
                                 "dodecahedron:1", "octahedron:1", "box:1000,1,1e-3"}) {
    bodies.push_back(parse_shape(text, 1.0, kQueriedSizes).body);
  }
  const auto step = [&random] { return static_cast<double>(static_cast<int>(random() % 3) - 1); };
  int n_hits = 0, n_misses = 0;
  for (int k = 0; k < 8000; ++k) {
    const ConvexBody &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
    const double size = a.circumradius() + b.circumradius();
    Transformd pose;
    const int kind = k % 4;
    if (kind == 0) pose = rotation_from_quaternion(number(), number(), number(), number());
    pose.translation = {1.2 * size * number(), 1.2 * size * number(), 1.2 * size * number()};
    if (kind == 1) pose.translation = {0.5 * step(), step(), 1.5 * step()};
    if (kind == 2) {
      const double above = a.support({0.0, 0.0, 1.0}).z - b.support({0.0, 0.0, -1.0}).z;
      pose.translation = {0.3 * number(), 0.3 * number(), above + std::exp2(-60.0 * std::fabs(number()))};
    }
    Vec3d motion{number(), number(), number()};
    if (k % 3 == 0) motion = {step(), step(), step()};
    if (k % 3 == 1) motion = 0.1 * size * motion - pose.translation;
    if (!(norm_1(motion) > 0.0)) motion = {0.0, 0.0, -1.0};
    if (overlap(a, b, pose).outcome != Outcome::disjoint) continue;
    const FirstContact cast = linear_cast(a, b, pose, motion);
    const FirstMeeting exact = first_meeting(placed_forms(a, b, pose).value(), motion);
    ASSERT_EQ(cast.verdict.outcome, exact.is_hit ? Outcome::overlap : Outcome::disjoint) << k;
    ++(exact.is_hit ? n_hits : n_misses);
    if (!exact.is_hit) continue;
    ASSERT_LE(cast.lower, exact.upper) << k;
    ASSERT_GE(cast.upper, exact.lower) << k;
  }
  EXPECT_GT(n_hits, 1000);
  EXPECT_GT(n_misses, 1000);
}

}  // namespace
}  // namespace vex
