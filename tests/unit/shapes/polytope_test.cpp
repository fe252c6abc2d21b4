#include "shapes/polytope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/numeric/errors.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

TEST(Polytope, SupportIsTheFarthestVertexBitForBit) {
  std::mt19937_64 random(1);
  const TestPolytope hull = test_point_hull(200, {3, 2, 1}, 7);
  for (int k = 0; k < 1000; ++k) {
    const Vec3d dir = random_direction(random);
    const Vec3d found = hull.body.support(dir);
    double most = -1e300;
    bool is_vertex = false;
    for (const Vec3d& v : hull.vertices) {
      most = std::max(most, dot(v, dir));
      is_vertex = is_vertex || (v.x == found.x && v.y == found.y && v.z == found.z);
    }
    EXPECT_TRUE(is_vertex);
    EXPECT_EQ(dot(found, dir), most);
  }
}

TEST(Polytope, OfVerticesThatTieTheFirstAnswers) {
  const std::vector<Vec3d> square = {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const Polytope polytope(square, {}, 0.0);
  EXPECT_EQ(polytope.support(Vec3d{1, 0, 0}).y, -1.0);
  EXPECT_EQ(polytope.support(Vec3d{0, 0, 1}).x, 1.0) << "all four tie";
}

TEST(Polytope, CircumradiusIsNeverTooSmall) {
  const TestPolytope hull = test_point_hull(500, {1, 1, 1}, 3);
  for (const Vec3d& v : hull.vertices) EXPECT_LE(norm(v), hull.body.circumradius());
  EXPECT_NEAR(hull.body.circumradius(), 1.0, 1e-14);
}

TEST(Polytope, RefusesWhatIsNoPolytope) {
  EXPECT_THROW(Polytope({}, {}, 0.0), InputError);
  const std::vector<Vec3d> bad = {{0, 0, 0}, {1, std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_THROW(Polytope(bad, {}, 0.0), InputError);
  const std::vector<Vec3d> infinite = {{std::numeric_limits<double>::infinity(), 0, 0}};
  EXPECT_THROW(Polytope(infinite, {}, 0.0), InputError);
}

}  // namespace
}  // namespace vex
