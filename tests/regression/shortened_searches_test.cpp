// Found 2026-11 by an independent referee: distances with few `max_support_calls` whose points and normal were 6e-9 and
// more off, and nothing said so.
//
// Cause. A search that is cut short may have proven its lower bound along another direction than that of the nearest
// points it has seen. The bounds were near enough, so the answer was not called rough, and its normal showed less than
// the distance. Now the normal of such an answer is measured, too. Later the points of others were found to be 4e-9 of
// where they belong, along a normal that shows the depth: whether they are opposite each other is asked as well. And of
// searches that were asked for few digits (`relative_gap`) nothing was measured: up to 193 of 1000 answers, an
// ellipsoid and a dodecahedron, were not as promised. Segments that nearly touch were answered without a search, as
// near as was asked, and what their normal shows was taken for the distance: the verdict then moved a bound, and the
// answer was wrong by ten times what was promised.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"
#include "tests/referees/query_strata.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(ShortenedSearches, AreRoughOrKeepWhatIsPromised) {
  int n_fine = 0, n_rough = 0;
  for (const QueryStratum& stratum : query_strata()) {
    if (stratum.name != "ordinary" && stratum.name != "thin" && stratum.name != "touching") continue;
    std::mt19937_64 random(9);
    for (int k = 0; k < 60; ++k) {
      const QueryScene at = stratum.scene(random, k);
      for (const int n_calls : {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 20, 30}) {
        const SeparationSettings settings{.max_support_calls = n_calls};
        for (const auto& query : {distance, signed_distance, penetration_depth}) {
          const Separation found = query(at.a, at.b, at.pose, settings, nullptr);
          EXPECT_LE(found.lower, found.upper);
          if (found.is_rough) {
            ++n_rough;
            continue;
          }
          ++n_fine;
          const CertificateCheck check =
              check_certificate(at.a, at.b, at.pose, found, certify(at.a, at.b, at.pose, found));
          EXPECT_TRUE(check.is_proven) << check.fault << " " << n_calls << " " << at.text();
        }
      }
    }
  }
  EXPECT_GT(n_fine, 1000);
  EXPECT_GT(n_rough, 1000);
}

TEST(ShortenedSearches, OfFewDigitsAreRoughOrKeepWhatIsPromised) {
  int n_fine = 0, n_rough = 0;
  const auto ask = [&](const QueryScene& at, double relative_gap) {
    const SeparationSettings settings{.relative_gap = relative_gap};
    for (const auto& query : {distance, signed_distance, penetration_depth}) {
      const Separation found = query(at.a, at.b, at.pose, settings, nullptr);
      EXPECT_LE(found.lower, found.upper);
      (found.is_rough ? n_rough : n_fine) += 1;
      if (found.is_rough || found.verdict.outcome == Outcome::undecided) continue;
      const CertificateCheck check = check_certificate(at.a, at.b, at.pose, found, certify(at.a, at.b, at.pose, found));
      EXPECT_TRUE(check.is_proven) << check.fault << " " << relative_gap << " " << at.text();
    }
  };
  for (const double relative_gap : {2e-12, 1e-8, 1e-6, 1e-3, 0.1, 0.5}) {
    for (const QueryStratum& stratum : query_strata()) {
      if (stratum.name != "ordinary" && stratum.name != "thin" && stratum.name != "touching") continue;
      std::mt19937_64 random(10);
      for (int k = 0; k < 40; ++k) ask(stratum.scene(random, k), relative_gap);
    }
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 30; ++k) {
      Transformd pose = random_rotation(random);
      pose.translation = {normal(random), normal(random), normal(random)};
      const auto between = [&](const char* a, const char* b) {
        return QueryScene{a, b, parse_shape(a), parse_shape(b), pose, {}, {}};
      };
      ask(between("ellipsoid:0.5,1.1,1.2", "dodecahedron:0.3"), relative_gap);
      ask(between("box:1,2,3", "box:1,1,1"), relative_gap);
    }
  }
  EXPECT_GT(n_fine, 900);
  EXPECT_GT(n_rough, 90);
}

TEST(ShortenedSearches, AreRoughWherePointsAreNotOppositeEachOther) {
  const ConvexBody a = parse_shape("needle:2", 1.0, kQueriedSizes).body;
  const ConvexBody b = parse_shape("ellipsoid:1,1,1e-6", 1.0, kQueriedSizes).body;
  const Transformd pose{{-0x1.2bc88a17f748ep-1, -0x1.ac86aeedf9c94p-3, -0x1.90fea6baf3132p-1},
                        {0x1.9a89763a1d911p-1, -0x1.2ab46fedb49fp-2, -0x1.0b03f5b04276ap-1},
                        {-0x1.e8cf07a1052b4p-4, -0x1.dddef9ca7ea12p-1, 0x1.5ab2d1f2ae62cp-2},
                        {-0x1.5945a3e7dabf6p-2, 0x1.b41625c1ae8fdp-3, 0x1.1895fd7bd86d6p-1}};
  int n_fine = 0;
  for (int n_calls = 1; n_calls <= 64; ++n_calls) {
    const Separation found = penetration_depth(a, b, pose, {.max_support_calls = n_calls});
    EXPECT_TRUE(found.is_rough || n_calls != 12);
    if (found.is_rough) continue;
    ++n_fine;
    const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found));
    EXPECT_TRUE(check.is_proven) << check.fault << " " << n_calls;
  }
  EXPECT_GT(n_fine, 10);
}

// Of who asks for a tenth: bounds that the verdict has cut at 0, and points of a simplex that is apart by more.
TEST(ShortenedSearches, AreRoughWhereTheVerdictMovesTheValueFromItsPoints) {
  const ConvexBody a = parse_shape("hemisphere:1").body, b = parse_shape("capsule:1,0.001").body;
  const Transformd pose{{0.067137189398920452, -0.92080550122754945, 0.38420024298364885},
                        {-0.67303208855730723, -0.32606321067269961, -0.66386036966970674},
                        {0.73655984520730056, -0.21400937258655772, -0.64162261717718894},
                        {0.5294546640768909, -1.016253380803638, 0.32068265098730103}};
  for (const double gap : {0.05, 0.1, 0.2}) {
    const Separation found = signed_distance(a, b, pose, {.relative_gap = gap});
    EXPECT_EQ(found.verdict.outcome, Outcome::overlap);
    const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
    const double promised = gap * (std::fabs(found.signed_distance) + a.circumradius() + b.circumradius());
    EXPECT_TRUE(found.is_rough || norm(off) <= promised * (1.0 + 1e-12)) << gap;
  }
}

TEST(ShortenedSearches, OfSegmentsShowWhatTheySay) {
  const ConvexBody needle = parse_shape("needle:2").body;
  for (const double angle : {1e-6, 1e-7, 1e-8, 1e-9}) {
    for (const double along : {0.0, 0.5, -0.8}) {
      for (const double across : {1e-17, 1e-15, 1e-13}) {
        const Pose pose(Transformd{{1, 0, angle}, {0, 1, 0}, {-angle, 0, 1}, {along * angle, across, -1.0}});
        for (const double gap : {1e-7, 1e-5, 1e-3, 0.1}) {
          const Separation found = signed_distance(needle, needle, pose, {.relative_gap = gap});
          const CertificateCheck check =
              check_certificate(needle, needle, pose, found, certify(needle, needle, pose, found));
          EXPECT_TRUE(found.is_rough || check.is_proven) << check.fault << ' ' << angle << ' ' << along << ' ' << gap;
        }
      }
    }
  }
}

// `max_distance` is of `distance` alone, where it is what a lower bound has to be above.
TEST(ShortenedSearches, HeedMaxDistanceOfDistancesAlone) {
  std::mt19937_64 random(12);
  const ConvexBody a = parse_shape("ellipsoid:1,2,3").body, b = parse_shape("ellipsoid:0.5,1,1.5").body;
  int n_ended = 0;
  for (int k = 0; k < 500; ++k) {
    Transformd pose = random_rotation(random);
    const Vec3d dir = random_direction(random);
    pose.translation = ((4.5 + 2.0 * random_in_unit_interval(random)) / norm(dir)) * dir;
    const Separation found = signed_distance(a, b, pose, {.relative_gap = 1e-3});
    if (!(found.signed_distance > 0.05)) continue;
    const double most = found.signed_distance - 2e-3;
    const Separation same = signed_distance(a, b, pose, {.relative_gap = 1e-3, .max_distance = most});
    EXPECT_EQ(same.lower, found.lower);
    EXPECT_EQ(same.is_rough, found.is_rough);
    EXPECT_FALSE(found.is_rough);
    const Separation near = distance(a, b, pose, {.relative_gap = 1e-3, .max_distance = 0.9 * most});
    n_ended += near.lower > 0.9 * most ? 1 : 0;
  }
  EXPECT_GT(n_ended, 100);
}

// Also of sizes that are answered by twice the precision, and of points that are off by less than was asked for.
TEST(ShortenedSearches, AreRoughOnlyNextToContactWhateverTheSize) {
  std::mt19937_64 random(13);
  for (const char* const of_a : {"ellipsoid:1,2,3", "icosahedron:1", "cylinder:1,0.5"}) {
    for (const double scale : {1e-60, 1e-30, 1e48}) {
      const ConvexBody a = parse_shape(of_a, scale, kQueriedSizes).body,
                       b = parse_shape("ellipsoid:0.5,1,1.5", scale, kQueriedSizes).body;
      const double radii = a.circumradius() + b.circumradius();
      for (int k = 0; k < 60; ++k) {
        Transformd pose = random_rotation(random);
        const Vec3d dir = random_direction(random);
        pose.translation = (radii * (0.5 + 0.8 * random_in_unit_interval(random)) / norm(dir)) * dir;
        const Separation found = signed_distance(a, b, pose, {.relative_gap = 1e-3});
        EXPECT_LE(found.upper - found.lower, 1e-3 * (std::fabs(found.signed_distance) + radii));
        EXPECT_TRUE(!found.is_rough || std::fabs(found.signed_distance) <= 2e-3 * radii) << of_a << ' ' << scale;
      }
    }
  }
  const ConvexBody box = parse_shape("box:0.2,1,3").body, needle = parse_shape("needle:1", 6.52374e+06).body;
  const Pose pose(Transformd{{-0x1.77ea9a15b2fb7p-2, 0x1.e21a16cc7058ap-3, -0x1.ccbfa7c223586p-1},
                             {0x1.41aebc5ea6afep-1, -0x1.4d2266f30adefp-1, -0x1.b4bddb3963a46p-2},
                             {-0x1.5f313b89c39f2p-1, -0x1.71a5b2641cb33p-1, 0x1.74919676db6e6p-4},
                             {-0x1.4e83a6f792f4cp-2, -0x1.c6179b22a97f8p+4, 0x1.b054a9942ef0cp+0}});
  const Separation found = signed_distance(box, needle, pose, {.relative_gap = 9.52107e-10});
  EXPECT_FALSE(found.is_rough);
  const CertificateCheck check = check_certificate(box, needle, pose, found, certify(box, needle, pose, found));
  EXPECT_TRUE(check.is_proven) << check.fault;
}

}  // namespace
}  // namespace vex
