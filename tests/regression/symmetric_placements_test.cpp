// Found 2026-11 by two readers who tried to refute the exact verdicts: placements with the origin of A - B on an axis
// or in a plane of symmetry.
//
// Cause. All support points of a portal's search then lie in one plane with its start, from whichever inner point it
// starts, and no tetrahedron of them has the origin inside: an apex 3e-7 deep in a flat cone was undecided. A search
// for witnesses that starts at a support point had the origin on its first edge, and gave up silently: concentric
// bodies of ordinary sizes overlapped without a certificate. And one search of several that ran into its cap made
// touching bodies "given up", though their gap was known to 1e-26.
#include <gtest/gtest.h>

#include <string>

#include "engine/numeric/quaternion.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"

namespace vex {
namespace {

constexpr Transformd kStraight{};
constexpr Transformd kUpsideDown{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {}};
constexpr Transformd kOnItsSide{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};

struct Placement {
  std::string a, b;
  Transformd turn;
  Vec3d translation;
};

Verdict verdict_of(const Placement& placement, OverlapCertificate& certificate, bool& is_proven) {
  const ConvexBody a = parse_shape(placement.a, 1.0, kQueriedSizes).body;
  const ConvexBody b = parse_shape(placement.b, 1.0, kQueriedSizes).body;
  Transformd pose = placement.turn;
  pose.translation = placement.translation;
  const Verdict verdict = overlap(a, b, pose, &certificate);
  is_proven =
      verdict.outcome != Outcome::undecided && check_certificate(a, b, pose, verdict.outcome, certificate).is_proven;
  return verdict;
}

TEST(SymmetricPlacements, OverlapsAreFoundAndProven) {
  for (const Placement& placement :
       {Placement{"cone:1e-6,1", "cone:1,1e-6", kUpsideDown, {0, 0, 0.4999998}},
        Placement{"cone:1e-6,1", "cone:1e-6,1", kStraight, {1.999994, 0, 0}},
        Placement{"ellipsoid:1e6,1,1", "ellipsoid:1e6,1,1", kStraight, {1999999.999998, 0, 0}},
        Placement{"cylinder:2,1", "needle:2", kStraight, {}},
        Placement{"cone:2,1", "cone:2,1", kUpsideDown, {0, 0, -1.9}},
        Placement{"cone:1,1", "cone:1,1", kUpsideDown, {0, 0, 0.395}},
        Placement{"cone:0.1,1", "cone:0.1,1", kStraight, {1.3, 1.1, 0}},
        Placement{"cone:1e-6,1", "cone:1e-6,1", kStraight, {}},
        Placement{"cylinder:1e-6,1", "cylinder:1e-6,1", kStraight, {}},
        Placement{"cylinder:2,1e-6", "disc:1", kStraight, {}}, Placement{"disc:1", "cylinder:1e-6,1", kStraight, {}},
        Placement{"disc:1", "needle:0.002", kStraight, {}}, Placement{"disc:3", "needle:1", kStraight, {}},
        Placement{"needle:1", "disc:384116", rotation_from_quaternion(1, 1, 0, 0), {}},
        Placement{"cylinder:2,1e-6", "cylinder:2,1e-6", kStraight, {0, 0, 1.9}},
        Placement{"cone:1,63145.7", "frustum:1,635.403,72.5686", kStraight, {}},
        Placement{"cone:1e150,1e-150", "cone:1e-150,1e150", kStraight, {0, 1e-150, 0}}}) {
    OverlapCertificate certificate;
    bool is_proven = false;
    EXPECT_EQ(verdict_of(placement, certificate, is_proven).outcome, Outcome::overlap)
        << placement.a << " " << placement.b;
    EXPECT_TRUE(is_proven) << placement.a << " " << placement.b;
  }
}

TEST(SymmetricPlacements, ContactIsNotCalledGivenUp) {
  for (const Placement& placement :
       {Placement{"cylinder:2,1", "cylinder:2,1", kOnItsSide, {0, 2, -2}},
        Placement{"hemisphere:1", "disc:1", kOnItsSide, {0, 1, -1}},
        Placement{"disc:1", "disc:1", kOnItsSide, {0, 1, -1}}, Placement{"disc:1", "disc:1e-9", kStraight, {}},
        Placement{"disc:1", "plate:1,1", kStraight, {0.3, 0.2, 0}}}) {
    OverlapCertificate certificate;
    bool is_proven = false;
    const Verdict verdict = verdict_of(placement, certificate, is_proven);
    EXPECT_EQ(verdict.outcome, Outcome::undecided) << placement.a << " " << placement.b;
    EXPECT_EQ(verdict.reason, UndecidedReason::rounding) << placement.a << " " << placement.b;
    EXPECT_LE(certificate.gap_lower, 0.0);
    EXPECT_LT(certificate.gap_upper - certificate.gap_lower, 1e-15) << placement.a << " " << placement.b;
  }
}

TEST(SymmetricPlacements, FlatBodiesInOnePlaneAreToldApart) {
  OverlapCertificate certificate;
  bool is_proven = false;
  EXPECT_EQ(verdict_of({"disc:1", "disc:1", kStraight, {2.0 + 1e-9, 0, 0}}, certificate, is_proven).outcome,
            Outcome::disjoint);
  EXPECT_TRUE(is_proven);
}

TEST(SymmetricPlacements, TheLargestTranslationsAreNoException) {
  // Twice a length overflowed, and polytopes were undecided.
  for (const char* body : {"box:1,1,1", "sphere:1", "capsule:1,1", "plate:1,1", "cylinder:1,1", "ellipsoid:1,2,3"}) {
    OverlapCertificate certificate;
    bool is_proven = false;
    EXPECT_EQ(verdict_of({body, body, kStraight, {1.7e308, 0, 0}}, certificate, is_proven).outcome, Outcome::disjoint)
        << body;
    EXPECT_TRUE(is_proven) << body;
  }
}

TEST(SymmetricPlacements, SizesWhoseSquaresUnderflowAreNoException) {
  // The circumradius came out as 0, and with it the rounding bound: a third of such verdicts was wrong.
  const ConvexBody box = Box(1e-200, 1e-200, 1e-200);
  EXPECT_GT(box.circumradius(), 0.8e-200);
  for (const double x : {0.999e-200, 1.001e-200}) {
    Transformd pose;
    pose.translation = {x, 0.1e-200, 0.2e-200};
    EXPECT_EQ(overlap(box, box, pose).outcome, x < 1e-200 ? Outcome::overlap : Outcome::disjoint);
  }
}

}  // namespace
}  // namespace vex
