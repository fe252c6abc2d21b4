#include "engine/query/nearest_point.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "engine/support/combinators.h"
#include "shapes/disc.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

// The least |sum of weight_i point_i|, by stepping between pairs of points: slow, and sure (Frank and Wolfe's away
// steps).
double distance_by_steps(const std::vector<Vec3d>& points) {
  std::vector<double> weights(points.size(), 1.0 / static_cast<double>(points.size()));
  Vec3d at{};
  for (const Vec3d& p : points) at = at + weights[0] * p;
  for (int step = 0; step < 20000; ++step) {
    std::size_t to = 0, from = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dot(points[i], at) < dot(points[to], at)) to = i;
      if (weights[i] > 0.0 && (from == points.size() || dot(points[i], at) > dot(points[from], at))) from = i;
    }
    const Vec3d e = points[to] - points[from];
    if (!(dot(e, e) > 0.0)) break;
    const double s = std::min(std::max(-dot(at, e) / dot(e, e), 0.0), weights[from]);
    if (s == 0.0) break;
    weights[from] -= s;
    weights[to] += s;
    at = at + s * e;
  }
  return norm(at);
}

TEST(NearestPoint, IsTheNearestOfEverySimplex) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  std::array<int, 5> n_carriers{};
  for (int k = 0; k < 6000; ++k) {
    std::vector<Vec3d> points(1 + random() % 4);
    // Flat ones and needles, too.
    const double flat = k % 5 == 0 ? 0.0 : 1.0, thin = k % 7 == 0 ? 0.0 : 1.0;
    const double off = k % 2 == 0 ? 0.1 : 0.7;
    const Vec3d from{off * in(random), off * in(random), off * in(random)};
    for (Vec3d& p : points) p = from + Vec3d{in(random), thin * in(random), flat * in(random)};
    const NearestPoint<double> found = nearest_point<double>(points);
    ++n_carriers.at(found.carriers.size());
    ASSERT_NEAR(norm(found.at), distance_by_steps(points), 1e-6) << k;
    if (found.carriers.size() < 4 && norm(found.at) > 1e-6) {
      // Nothing is nearer: all points are on the far side of the plane through it.
      const Vec3d normal = (1.0 / norm(found.normal)) * found.normal;
      for (const Vec3d& p : points) ASSERT_GE(dot(normal, p), norm(found.at) - 1e-9) << k;
    }
  }
  for (int n = 1; n <= 4; ++n) EXPECT_GT(n_carriers.at(static_cast<std::size_t>(n)), 50) << n;
}

// Between two bodies with the pose's rotation left out.
template <class A, class B>
Descent<double> descent(const A& a, const B& b, const Vec3d& translation, int max_support_calls = 200) {
  Transformd pose;
  pose.translation = translation;
  const Posed<B, double> placed(b, pose);
  return descend<double>(MinkowskiDifference(a, placed), Vec3d{0.3, -0.5, 0.7}, {8.0, 1e-14}, max_support_calls);
}

TEST(Descent, FindsTheDistance) {
  const Descent<double> found = descent(Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), {0, 4, 0});
  EXPECT_EQ(found.end, Descent<double>::End::disjoint);
  EXPECT_GT(found.separating_dir.y, 0.0);
}

TEST(Descent, TellsDiscsInOnePlaneApart) {
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-12}) {
    const Descent<double> found = descent(Disc(1.0), Disc(0.25), {0.75 + 0.25 * gap, 1.0 + gap, 0});
    ASSERT_EQ(found.end, Descent<double>::End::disjoint) << gap;
  }
}

TEST(Descent, EndsWhereTheBodiesMeet) {
  const Descent<double> inside = descent(Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), {0.5, 0.5, 0.5});
  EXPECT_EQ(inside.end, Descent<double>::End::ended);
  EXPECT_LT(norm(inside.nearest), 1e-12);
  const Descent<double> flat = descent(Disc(1.0), Disc(0.25), {0.3, 0.2, 0});
  EXPECT_EQ(flat.end, Descent<double>::End::ended);
  EXPECT_LT(norm(flat.nearest), 1e-12);
}

TEST(Descent, SaysThatItWasGivenUp) {
  EXPECT_EQ(descent(Ellipsoid(1, 2, 3), Ellipsoid(3, 1, 1), {0, 2.9999, 0}, 2).end, Descent<double>::End::capped);
}

}  // namespace
}  // namespace vex
