// Found 2026-11 by a fresh reader of the certificates, of hulls of size 1 up to 1e13 from the origins of their own
// frames: depths with bounds .4 apart after 16 400 support calls, that nothing said to be rough; and contact manifolds
// with two corners where there are four, or with points that are no numbers.
//
// Cause. Where rounding makes faces of its own the hull of a depth grew to its cap, which was taken for the end, and
// twice the precision was not asked. Manifolds merged what is nearer than 2^20 roundings of coordinates, though
// differences of coordinates that are near each other are not rounded at all: at 1e7 that is a tenth of the body. Now
// double precision is not believed where its rounding alone is wider than what is asked for, and manifolds know lengths
// as well as differences do.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/query/contact_manifold.h"
#include "engine/query/separation.h"
#include "shapes/polytope.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/query_strata.h"

namespace vex {
namespace {

QueryStratum displaced() {
  for (const QueryStratum& stratum : query_strata()) {
    if (stratum.name == "displaced") return stratum;
  }
  throw std::logic_error("no such stratum");
}

TEST(DisplacedBodies, HaveNearBoundsSoon) {
  const QueryStratum stratum = displaced();
  std::mt19937_64 random(3);
  for (int k = 0; k < 3000; ++k) {
    const QueryScene at = stratum.scene(random, k);
    const Separation found = signed_distance(at.a, at.b, at.pose);
    const double size = at.a.circumradius() + at.b.circumradius() + std::fabs(found.signed_distance);
    EXPECT_LE(found.upper - found.lower, 1e-12 * size) << at.text();
    EXPECT_FALSE(found.is_rough) << at.text();
    EXPECT_LT(found.n_support_calls, 400) << at.text();
  }
}

TEST(DisplacedBodies, AreRoughWhereASearchIsCutShort) {
  const QueryStratum stratum = displaced();
  std::mt19937_64 random(4);
  int n_rough = 0;
  for (int k = 0; k < 300; ++k) {
    const QueryScene at = stratum.scene(random, k);
    SeparationSettings few;
    few.max_support_calls = 3;
    const Separation found = signed_distance(at.a, at.b, at.pose, few);
    const double size = at.a.circumradius() + at.b.circumradius() + std::fabs(found.signed_distance);
    EXPECT_EQ(found.is_rough, found.has_witnesses && !(found.upper - found.lower <= 1e-12 * size)) << at.text();
    n_rough += found.is_rough ? 1 : 0;
  }
  EXPECT_GT(n_rough, 100);
}

// The middle of a square of contacts, and its corners one after the other.
void expect_square(const ContactManifold& found, const Vec3d& middle, double side, double tolerance) {
  ASSERT_EQ(found.contacts.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3d p = found.contacts[k].point_a, next = found.contacts[(k + 1) % 4].point_a;
    EXPECT_NEAR(norm(p - middle), side / std::sqrt(2.0), tolerance);
    EXPECT_NEAR(norm(next - p), side, tolerance);
  }
}

TEST(DisplacedBodies, KeepTheCornersOfTheirContacts) {
  std::mt19937_64 random(5);
  for (int exponent = 0; exponent <= 12; ++exponent) {
    const double far = std::pow(10.0, exponent), rounding = 0x1p-50 * far;
    for (int k = 0; k < 20; ++k) {
      // Turned in the plane of contact, and not at all.
      const double angle = k % 2 == 0 ? 0.0 : 0.3 * k;
      const Transformd turn{
          {std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}, {}};
      const Vec3d at_a = far * random_direction(random), at_b = far * random_direction(random);
      const auto cube_about = [&](const Vec3d& middle) {
        std::vector<Vec3d> vertices = box_vertices(1, 1, 1);
        for (Vec3d& v : vertices) v = turn(v) + middle;
        return ConvexBody(Polytope(vertices, middle, 0.0));
      };
      const Vec3d step{0, 0, 0.75};
      const ConvexBody a = cube_about(at_a), b = cube_about(at_b);
      const ContactManifold found = contact_manifold(a, b, Transformd{.translation = (at_a - at_b) + step}, 0.0,
                                                     std::fmax(0.01, 16.0 * rounding));
      SCOPED_TRACE(testing::Message() << "at " << far << ", turned by " << angle);
      expect_square(found, at_a + Vec3d{0, 0, 0.5}, 1.0, 1e-9 + 16.0 * rounding);
    }
  }
}

TEST(DisplacedBodies, HaveContactsThatAreNumbers) {
  const QueryStratum stratum = displaced();
  std::mt19937_64 random(6);
  for (int k = 0; k < 4000; ++k) {
    const QueryScene at = stratum.scene(random, k);
    const ContactManifold found = contact_manifold(at.a, at.b, at.pose);
    const double size = at.a.circumradius() + at.b.circumradius();
    for (const ContactManifold::Contact& contact : found.contacts) {
      ASSERT_TRUE(is_finite(contact.point_a) && is_finite(contact.point_b)) << at.text();
      ASSERT_LE(norm(contact.point_b - contact.point_a), 1.1 * size) << at.text();
    }
  }
}

}  // namespace
}  // namespace vex
