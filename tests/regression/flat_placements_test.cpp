// Found 2026-11 by a third reader: flat bodies in one plane, or in one but for rounding, and what lies flush.
//
// Causes. A difference without a volume was thickened and its hull grown, which stalled among points closer together
// than the thickness: discs 1e-6 beside a plate were undecided, once with the separating direction at hand, because
// only some of the directions that were looked at counted. Now every one counts, and a descent to the nearest point
// comes before the hull. - Witnesses were searched by another portal than the one that had proven the overlap, and were
// not always found. - The nearest point of a triangle was taken with weights that added up to more than 1, and the
// gap's upper bound was too low by as much. - Apex on apex, the hull grew to its cap, with all pairs of edges compared
// at every step: a second for a question of a microsecond. - The checker's margin counted lengths that are exact.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"
#include "shapes/cone.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

using TwelveNumbers = std::array<double, 12>;

struct Answer {
  Verdict verdict;
  OverlapCertificate certificate;
  bool is_proven = false;
};

ConvexBody body_of(const std::string& text, double scale = 1.0) { return parse_shape(text, scale, kQueriedSizes).body; }

Answer answer(const ConvexBody& a, const ConvexBody& b, const TwelveNumbers& x) {
  const Transformd pose{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, {x[9], x[10], x[11]}};
  Answer result;
  result.verdict = overlap(a, b, pose, &result.certificate);
  result.is_proven = result.verdict.outcome != Outcome::undecided &&
                     check_certificate(a, b, pose, result.verdict.outcome, result.certificate).is_proven;
  return result;
}

TEST(FlatPlacements, InOnePlaneAreToldApart) {
  struct Placement {
    const char *a, *b;
    TwelveNumbers pose;
  };
  for (const Placement& placement :
       {Placement{"disc:6.0794475113926013e-06", "plate:1,1", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0x1.0000f3494c827p-1, .5, 0}},
        Placement{"disc:6e-06", "plate:1,1", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5 + 6e-6 + 1e-9, 0.5, 0}},
        Placement{
            "disc:1e-05", "plate:1,1", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0x1.0000f83f9c7bap-1, 0x1.0000e1bfcc5fap-1, 0}},
        Placement{"plate:1,0.68045399475505342",
                  "disc:0.1",
                  {0x1.b09885c2c187cp-1, -0x1.11dec4d86c494p-1, -0x1.ae30d9318f248p-50, 0x1.11dec4d86c494p-1,
                   0x1.b09885c2c187cp-1, 0x1.f82b9046f42ap-56, 0x1.6742a3c9024dap-50, -0x1.d98848565672p-51, 1,
                   0x1.243430a3ff987p-1, 0x1.a4ccd893cecfep-2, 0x1.ddcaf480d38fap-54}},
        Placement{"disc:0.0049804445713921416",
                  "needle:1",
                  {1, 0, 0, 0, 0x1p-52, 0x1.ffffffffffffep-1, 0, -0x1.ffffffffffffep-1, 0x1p-52, -0x1.c4502ba68e9cap-11,
                   -0x1.0282edaf77f7fp-1, -0x1p-53}},
        Placement{"needle:1",
                  "disc:0.001",
                  {0x1p-52, 0, 0x1.ffffffffffffep-1, 0, 1, 0, -0x1.ffffffffffffep-1, 0, 0x1p-52, -0x1.0624dd2f1a9fcp-62,
                   0, 0x1.0083126e978d5p-1}}}) {
    const Answer found = answer(body_of(placement.a), body_of(placement.b), placement.pose);
    EXPECT_EQ(found.verdict.outcome, Outcome::disjoint) << placement.a << " " << placement.b;
    EXPECT_TRUE(found.is_proven) << placement.a << " " << placement.b;
  }
}

TEST(FlatPlacements, DiscsOverEachOtherAreBoundedTightly) {
  const Answer found = answer(body_of("disc:0.59839022160132271"), body_of("disc:1"),
                              {0x1p-52, 0x1.ffffffffffffep-1, 0, 0x1.ffffffffffffep-1, 0x1p-52, 0, 0, 0,
                               -0x1.ffffffffffffcp-1, 0x1.4100ca97e06a8p+0, -0x1.fb7f61d604939p-1, 0});
  EXPECT_EQ(found.verdict, Verdict::undecided(DecidedBy::double_double, UndecidedReason::rounding));
  EXPECT_LE(found.certificate.gap_lower, 0.0);
  EXPECT_GE(found.certificate.gap_upper, 0.0);
  EXPECT_LT(found.certificate.gap_upper - found.certificate.gap_lower, 1e-25);
}

TEST(FlatPlacements, OverlapsOfWhatLiesNearlyFlushHaveWitnesses) {
  struct Placement {
    const char *a, *b;
    double scale_b;
    TwelveNumbers pose;
  };
  for (const Placement& placement :
       {Placement{"cone:1.0000000000000001e-05,4.3332508048137398e-06",
                  "plate:0.0001094162431904975,9.9999999999999995e-07",
                  1,
                  {1, -0x1.bb2ec637ce328p-36, -0x1.e4e27c49485cp-35, 0x1.bb2ec63834dfap-36, 1, 0x1.b1abeb3ccac9cp-36,
                   0x1.e4e27c4930e5ep-35, -0x1.b1abeb3d33b76p-36, 1, -0x1.ea9b5ea136f4p-15, -0x1.603d0e457e0ebp-19,
                   -0x1.4f8b5891983f5p-18}},
        Placement{"hemisphere:0.80053262734004349",
                  "box:1,0.00074390562368011569,5.8868125459221489e-06",
                  1,
                  {1, -0x1.aafe2b02c1932p-34, -0x1.7a22fe113c0a9p-34, 0x1.aafe2b028bfd6p-34, 1, -0x1.2237edafd63f4p-35,
                   0x1.7a22fe11788cbp-34, 0x1.2237edae9ae46p-35, 1, 0x1.49cecdee6d8b2p+0, 0x1.1e23c03de6fa1p-3,
                   -0x1.8b0d31226d3c8p-19}},
        Placement{"hemisphere:1",
                  "box:0.0011997338270687333,0.0049707913115284883,1",
                  0x1.89e6a9d8cb55p+2,
                  {1, -0x1.160fd38a2dfd3p-34, -0x1.50981a3c98c16p-35, 0x1.160fd38a11135p-34, 1, -0x1.5fd91c72df13dp-35,
                   0x1.50981a3cf84c4p-35, 0x1.5fd91c7283ad5p-35, 1, 0x1.4236d784c71b5p-1, -0x1.9740977edc165p-1,
                   -0x1.89e6a9d8cb974p+1}}}) {
    const Answer found = answer(body_of(placement.a), body_of(placement.b, placement.scale_b), placement.pose);
    EXPECT_EQ(found.verdict.outcome, Outcome::overlap) << placement.a << " " << placement.b;
    EXPECT_TRUE(found.is_proven) << placement.a << " " << placement.b;
  }
}

TEST(FlatPlacements, ApexOnApexIsContactAtOnce) {
  for (const char* cone : {"cone:1,0.5", "cone:1,1e-12"}) {
    const Answer found = answer(body_of(cone), body_of(cone), {1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1});
    EXPECT_EQ(found.verdict, Verdict::undecided(DecidedBy::double_double, UndecidedReason::rounding)) << cone;
    EXPECT_LT(found.certificate.n_support_calls, 100) << cone;
  }
}

// Overlap's portal leaves a needle undecided that ends 4e-17 beside a disc, and the search for the distance does not:
// the certificate of the depth asked overlap alone for the sign, found nothing, and the checker refused the answer.
TEST(FlatPlacements, DepthsOfWhatOnlyADistanceTellsApartAreProven) {
  const ConvexBody needle = body_of("needle:2"), disc = body_of("disc:0.7");
  const Pose pose(Transformd{{-0x1p-53, -1, 0},
                             {-0x1p-54, 0, 0x1.ffffffffffffdp-1},
                             {-0x1.ffffffffffffep-1, -0x1p-53, 0x1p-54},
                             {0, 0, 0x1.000000004p+0}});
  const Separation found = penetration_depth(needle, disc, pose);
  EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
  SeparationCertificate certificate = certify(needle, disc, pose, found);
  EXPECT_EQ(check_certificate(needle, disc, pose, found, certificate).fault, "");
  // Touching bodies have no such direction, and what meets no hull around a ball.
  Separation wrong = found;
  wrong.verdict = Verdict::overlap(DecidedBy::gjk);
  wrong.lower = -HUGE_VAL, wrong.upper = 0.0;
  EXPECT_FALSE(check_certificate(needle, disc, pose, wrong, certificate).is_proven);
  certificate.dir = {};
  EXPECT_FALSE(check_certificate(needle, disc, pose, found, certificate).is_proven);
}

TEST(FlatPlacements, FarVerticesAreProvenToo) {
  // A square 2^200 from its origin, and what touches it there to 1e-13.
  const double far = 0x1p200;
  const ConvexBody square =
      Polytope(std::vector<Vec3d>{{far, 0, 0}, {far, 0, 1}, {far, 1, 0}, {far, 1, 1}}, {far, 0.5, 0.5}, 0.0);
  for (const ConvexBody& b : std::vector<ConvexBody>{Ellipsoid(0.5, 0.5, 0.25), Cone(1.0, 0.5)}) {
    for (const double gap : {-0.1, -1e-9, -1e-13, 1e-13, 1e-9}) {
      const Answer found = answer(square, b, {1, 0, 0, 0, 1, 0, 0, 0, 1, far, 1.5 + gap, 0.5});
      EXPECT_TRUE(found.verdict.outcome == Outcome::undecided || found.is_proven) << gap;
      EXPECT_NE(found.verdict.outcome, Outcome::undecided) << gap;
    }
  }
}

}  // namespace
}  // namespace vex
