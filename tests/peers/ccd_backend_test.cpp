// libccd beside the engine near contact, where they differ: exact arithmetic is the referee, and sides with the engine.
#include "apps/peers/ccd_backend.h"

#include <gtest/gtest.h>

#include "apps/referees/exact_overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/contact.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

TEST(CcdBackend, WhereItContradictsTheEngineExactArithmeticSidesWithTheEngine) {
  // Cubes a hair apart or overlapping: libccd's GJK calls most of the separated ones overlapping.
  std::mt19937_64 random(41);
  const TestPolytope cube = test_box(1, 1, 1);
  const std::unique_ptr<OverlapBackend> gjk = gjk_backend().make(cube.body, cube.body);
  const std::unique_ptr<OverlapBackend> ccd = ccd_gjk_backend().make(cube.body, cube.body);
  int n_disputed = 0;
  for (int k = 0; k < 8; ++k) {
    Transformd pose = random_rotation(random);
    const Vec3d dir = random_direction(random);
    pose.translation = (exact::contact_along(cube, cube, pose, dir).apart * (1 + 1e-10)) * dir;
    const Verdict ours = gjk->decide(pose), theirs = ccd->decide(pose);
    ASSERT_EQ(ours.outcome, Outcome::disjoint);
    ASSERT_FALSE(exact::overlap(cube.vertices, exact::placed(cube.vertices, pose)));
    n_disputed += theirs.outcome == Outcome::overlap ? 1 : 0;
  }
  EXPECT_GE(n_disputed, 4) << "the stratum must show the peer's fault, or this test shows nothing";
}

TEST(CcdBackend, NeverHangs) {
  // Bodies so large that libccd's tolerance of 1e-12 is far below their rounding: alone, its portal refinement has no
  // way out.
  std::mt19937_64 random(43);
  for (const BackendKind& kind : {ccd_gjk_backend(), ccd_mpr_backend()}) {
    for (const char* text : {"ellipsoid:1e9,3e9,2e9", "box:1e9,1e9,1e9", "capsule:1e12,1e9", "sphere:1e-9"}) {
      const ConvexBody body = parse_shape(text).body;
      const std::unique_ptr<OverlapBackend> backend = kind.make(body, body);
      const Domain domain = ball_domain(body, body);
      for (int k = 0; k < 300; ++k) {
        Transformd pose = random_pose(random, domain, body);
        if (k % 3 == 0) pose.translation = (k % 2 == 0 ? 1.0 : 1e-3) * Vec3d{domain.radius, 0, 0};
        const Verdict verdict = backend->decide(pose);
        ASSERT_EQ(verdict.by, DecidedBy::peer);
      }
    }
  }
}

}  // namespace
}  // namespace vex
