#include "engine/query/search/nearest_descent.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "engine/support/combinators.h"
#include "shapes/disc.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

struct Point {
  Vec3d w;
};

TEST(NearestSimplex, KeepsTheNearestPointOfItsPoints) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  std::array<int, 5> n_carriers{};
  for (int k = 0; k < 6000; ++k) {
    // Flat ones and needles, too.
    const double flat = k % 5 == 0 ? 0.0 : 1.0, thin = k % 7 == 0 ? 0.0 : 1.0;
    const double off = k % 2 == 0 ? 0.1 : 0.7;
    const Vec3d from{off * in(random), off * in(random), off * in(random)};
    NearestSimplex<double, Point> simplex;
    for (int n = 0; n < 12 && !simplex.is_around_origin(); ++n) {
      std::vector<Vec3d> points;
      for (int i = 0; i < simplex.size(); ++i) points.push_back(simplex.point(i).w);
      points.push_back(from + Vec3d{in(random), thin * in(random), flat * in(random)});
      const double before = n == 0 ? HUGE_VAL : norm(simplex.at());
      // A point in front of the plane through the nearest one leads nearer: the only ones that a descent adds.
      const bool is_ahead = n == 0 || dot(points.back(), simplex.at()) < 0.999 * simplex.square();
      const bool is_nearer = simplex.add({points.back()});
      if (!is_ahead) {
        ASSERT_LE(norm(simplex.at()), before) << k;
        continue;
      }
      ASSERT_TRUE(is_nearer) << k;
      // It is the nearest: no point is in front of the plane through it, across it.
      for (const Vec3d& p : points) ASSERT_GE(dot(p, simplex.at()), simplex.square() - 1e-12) << k;
      ++n_carriers.at(static_cast<std::size_t>(simplex.size()));
      double sum = 0.0;
      Vec3d at;
      for (int i = 0; i < simplex.size(); ++i) {
        ASSERT_GT(simplex.weight(i), 0.0);
        sum += simplex.weight(i);
        at = at + simplex.weight(i) * simplex.point(i).w;
      }
      ASSERT_NEAR(sum, 1.0, 1e-14);
      ASSERT_LE(norm(at - simplex.at()), 1e-14) << k;
      if (!simplex.is_around_origin() && norm(simplex.at()) > 1e-6) {
        const Vec3d normal = (1.0 / norm(simplex.normal())) * simplex.normal();
        ASSERT_GT(dot(normal, simplex.at()), (1.0 - 1e-6) * norm(simplex.at())) << k;
      }
    }
  }
  for (std::size_t n = 1; n <= 4; ++n) EXPECT_GT(n_carriers.at(n), 50) << n;
}

using DoubleDescent = NearestDescent<double, Point>;

// Between two bodies with the pose's rotation left out.
template <class A, class B>
DoubleDescent descent(const A& a, const B& b, const Vec3d& translation, int max_support_calls = 200,
                      DescentGoal goal = DescentGoal::nearest) {
  Transformd pose;
  pose.translation = translation;
  const Posed<B, double> placed(b, pose);
  struct Difference {
    MinkowskiDifference<A, Posed<B, double>> body;
    Point support(const Vec3d& dir) const { return {body.support(dir)}; }
  };
  const Vec3d first = (1.0 / norm(Vec3d{0.3, -0.5, 0.7})) * Vec3d{0.3, -0.5, 0.7};
  return descend_to_origin<double, Point>(
      Difference{{a, placed}}, first, {}, QueryError<double>{8.0, 1e-14}, [](double) { return 1e-13; }, 0.0, goal,
      max_support_calls);
}

void expect_distance(const DoubleDescent& found, double distance) {
  EXPECT_EQ(found.end, DoubleDescent::End::converged);
  EXPECT_LE(found.lower, distance);
  EXPECT_GE(found.upper, distance);
  EXPECT_LE(found.upper - found.lower, 1e-12);
}

TEST(NearestDescent, FindsTheDistance) {
  const DoubleDescent found = descent(Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), {0, 4, 0});
  expect_distance(found, 1.0);
  EXPECT_NEAR(found.normal.y, 1.0, 1e-6);
}

TEST(NearestDescent, StopsAtADirectionThatSeparatesWhereThatIsTheGoal) {
  const DoubleDescent found = descent(Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), {0, 4, 0}, 200, DescentGoal::separated);
  EXPECT_EQ(found.end, DoubleDescent::End::separated);
  EXPECT_GT(found.lower, 0.0);
  EXPECT_GT(found.normal.y, 0.0);
}

TEST(NearestDescent, TellsDiscsInOnePlaneApart) {
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-12}) {
    const DoubleDescent found = descent(Disc(1.0), Disc(0.25), {0.75 + 0.6 * gap, 1.0 + 0.8 * gap, 0});
    ASSERT_LE(found.lower, gap);
    ASSERT_GE(found.upper, gap);
    ASSERT_GT(found.lower, 0.0) << gap;
  }
}

TEST(NearestDescent, EndsWhereTheBodiesMeet) {
  const DoubleDescent inside = descent(Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), {0.5, 0.5, 0.5});
  EXPECT_EQ(inside.end, DoubleDescent::End::around_origin);
  const DoubleDescent flat = descent(Disc(1.0), Disc(0.25), {0.3, 0.2, 0});
  EXPECT_EQ(flat.end, DoubleDescent::End::touching);
}

TEST(NearestDescent, SaysThatItWasGivenUp) {
  const DoubleDescent found = descent(Ellipsoid(1, 2, 3), Ellipsoid(3, 1, 1), {0, 3.0001, 0}, 2);
  EXPECT_EQ(found.end, DoubleDescent::End::capped);
  EXPECT_LE(found.lower, 0.0001);
  EXPECT_GE(found.upper, 0.0001);
}

}  // namespace
}  // namespace vex
