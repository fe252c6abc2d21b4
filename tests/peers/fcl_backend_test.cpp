// FCL with its own shapes: the frames and sizes are the engine's, and every body that it has a shape for is taken.
#include "apps/peers/fcl_backend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(FclBackend, TakesItsOwnShapesAndPolytopes) {
  const std::set<std::string> own = {"sphere", "box", "ellipsoid", "capsule", "cylinder", "cone", "plate"};
  std::size_t n_taken = 0;
  for (const char* text : kTestBodies) {
    const Body shape = parse_shape(text);
    const bool is_solid_polytope = !vertices_of(shape.body).empty() && shape.measures.volume > 0.0;
    EXPECT_EQ(fcl_backend().takes(shape.body, shape.body), own.contains(shape.kind) || is_solid_polytope) << text;
    n_taken += fcl_backend().takes(shape.body, shape.body) ? 1U : 0U;
  }
  EXPECT_GE(n_taken, own.size() + 4);
}

TEST(FclBackend, HasEveryBodyWhereTheEngineHasIt) {
  // A small sphere just outside and just inside the surface, along 200 directions: a frame that is shifted or upside
  // down, or a size taken for its half, would show.
  const ConvexBody probe = parse_shape("sphere:0.001").body;
  std::mt19937_64 random(61);
  for (const char* text : kTestBodies) {
    const ConvexBody body = parse_shape(text).body;
    if (!fcl_backend().takes(body, probe) || body.inradius() == 0.0) continue;
    const std::unique_ptr<OverlapBackend> fcl = fcl_backend().make(body, probe);
    for (int k = 0; k < 200; ++k) {
      const Vec3d dir = random_direction(random);
      const Vec3d unit_dir = (1.0 / norm(dir)) * dir;
      const Vec3d surface = body.support(unit_dir);
      const Transformd outside{.translation = surface + 0.00101 * unit_dir};
      const Transformd inside{.translation = surface + 0.00099 * unit_dir};
      ASSERT_EQ(fcl->decide(outside).outcome, Outcome::disjoint) << text;
      ASSERT_EQ(fcl->decide(inside).outcome, Outcome::overlap) << text;
    }
  }
}

}  // namespace
}  // namespace vex
