// Manifolds of curved bodies, held against what the bodies are: points on them by their exact forms, gaps along the
// normal, no contact deeper than the depth, areas and lengths as geometry has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/numeric/pose_algebra.h"
#include "engine/query/contact_manifold.h"
#include "engine/support/combinators.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
// Of a disc of radius 1 what the polygon of sixteen corners has.
const double kAreaOfCorners = 8.0 * std::sin(kHalfTurn / 8.0);

ConvexBody body_of(const char* text) { return parse_shape(text).body; }
const ConvexBody& wide_table() {
  static const ConvexBody kWideTable = Box(6.0, 6.0, 1.0);
  return kWideTable;
}

Transformd turned_by(double about_x, double about_z, const Vec3d& translation) {
  const double c = std::cos(about_x), s = std::sin(about_x), k = std::cos(about_z), l = std::sin(about_z);
  return {{k, -l * c, l * s}, {l, k * c, -k * s}, {0.0, s, c}, translation};
}
// At this height above the slab, negative in it, however it is turned.
Transformd above_table(const ConvexBody& body, Transformd pose, double gap) {
  const Vec3d lowest = pose(body.support(pose.direction_to_b({0.0, 0.0, -1.0})));
  pose.translation.z += 0.5 + gap - lowest.z;
  return pose;
}

ContactManifold four_of(const ConvexBody& a, const ConvexBody& b, const Pose& pose, double margin) {
  ManifoldMemory memory;
  ContactManifold manifold;
  contact_manifold(a, b, pose, {.margin = margin, .four_at_most = true}, memory, manifold);
  return manifold;
}

double patch_area(const ContactManifold& manifold) {
  Vec3d sum;
  const auto& contacts = manifold.contacts;
  for (std::size_t k = 1; k + 1 < contacts.size(); ++k) {
    sum = sum + cross(contacts[k].point_a - contacts[0].point_a, contacts[k + 1].point_a - contacts[0].point_a);
  }
  return 0.5 * dot(sum, manifold.separation.normal);
}
double least_distance(const ContactManifold& manifold) {
  double least = HUGE_VAL;
  for (const auto& c : manifold.contacts) least = std::min(least, c.signed_distance);
  return least;
}

// Whether a point is farther out of a body, in the body's frame, than this; by its support function alone, in many
// directions: of a point outside by more than a little some of them tells.
double least_excess(const ConvexBody& body, const Vec3d& point) {
  double most = -HUGE_VAL;
  const auto ask = [&](const Vec3d& dir) { most = std::max(most, dot(dir, point - body.support(dir)) / norm(dir)); };
  for (int k = 0; k < 400; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / 400, r = std::sqrt(1.0 - z * z), angle = 2.399963 * k;
    ask({r * std::cos(angle), r * std::sin(angle), z});
  }
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (x != 0.0 || y != 0.0 || z != 0.0) ask({x, y, z});
      }
    }
  }
  ask({point.x, point.y, 0.0});
  return most;
}

// What holds of every manifold, judged by supports: the points in their bodies, and no farther below their surface
// along the normal than the feature angle allows; opposite each other, apart by what is said; a convex polygon; nothing
// deeper than the depth, and something as deep.
void expect_is_sound(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, const ContactManifold& manifold,
                     double margin, const std::string& what) {
  const Vec3d normal = manifold.separation.normal;
  const Transformd back = inverse(pose);
  const double size = a.circumradius() + b.circumradius(), tolerance = 4e-9 * size;
  const double slope = std::tan(0.0101);
  const auto& contacts = manifold.contacts;
  ASSERT_FALSE(contacts.empty()) << what;
  for (const ContactManifold::Contact& c : contacts) {
    const Vec3d off = (c.point_b - c.point_a) - c.signed_distance * normal;
    EXPECT_LE(norm(off), tolerance + (contacts.size() == 2 ? 2.0 * slope * size : 0.0)) << what;
    EXPECT_NEAR(dot(c.point_b - c.point_a, normal), c.signed_distance, tolerance) << what;
    EXPECT_LE(least_excess(a, c.point_a), tolerance) << what;
    EXPECT_LE(least_excess(b, back(c.point_b)), tolerance) << what;
    const double below_a = dot(normal, a.support(normal) - c.point_a);
    const double below_b = -dot(normal, pose(b.support(pose.direction_to_b(-normal))) - c.point_b);
    EXPECT_LE(below_a, tolerance + 2.0 * slope * a.circumradius()) << what;
    EXPECT_LE(below_b, tolerance + 2.0 * slope * b.circumradius()) << what;
    EXPECT_GE(c.signed_distance, manifold.separation.lower - tolerance) << what;
    EXPECT_LE(c.signed_distance, std::max(margin, manifold.separation.upper) + tolerance) << what;
  }
  EXPECT_NEAR(least_distance(manifold), manifold.separation.signed_distance, tolerance) << what;
  for (std::size_t k = 0; k < contacts.size() && contacts.size() > 2; ++k) {
    const Vec3d& p = contacts[k].point_a;
    const Vec3d& q = contacts[(k + 1) % contacts.size()].point_a;
    const Vec3d& r = contacts[(k + 2) % contacts.size()].point_a;
    EXPECT_GT(dot(normal, cross(q - p, r - q)), -tolerance * size) << what;
  }
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      EXPECT_FALSE(contacts[j].feature_a == contacts[k].feature_a && contacts[j].feature_b == contacts[k].feature_b)
          << what << ": two contacts of one name";
    }
  }
}

TEST(CurvedManifold, ACoinOnItsEdgeStandsOnTheTwoEndsOfItsLine) {
  for (const double thickness : {0.5, 0.1, 0.05, 0.02, 0.01, 0.003}) {
    SCOPED_TRACE(thickness);
    const ConvexBody coin = Cylinder(thickness, 1.0), rounded = Inflated<Cylinder>(Cylinder(thickness, 1.0), 0.01);
    for (const ConvexBody* const body : {&coin, &rounded}) {
      for (const double roll : {0.0, 0.3, 2.0}) {
        // Its axis along the slab, in some direction.
        const Transformd pose = above_table(*body, turned_by(0.5 * kHalfTurn, roll, {0.1, 0.2, 0.0}), -1e-4);
        const ContactManifold found = contact_manifold(wide_table(), *body, pose, 1e-3);
        expect_is_sound(wide_table(), *body, pose, found, 1e-3, "coin");
        ASSERT_EQ(found.contacts.size(), 2u);
        EXPECT_NEAR(norm(found.contacts[0].point_b - found.contacts[1].point_b), thickness, 1e-6 + 1e-5 * thickness);
        for (const auto& c : found.contacts) EXPECT_NEAR(c.signed_distance, -1e-4, 1e-8);
      }
    }
  }
}

TEST(CurvedManifold, OfACylinderOnItsCapIsThePolygonOfSixteenCorners) {
  const ConvexBody can = Cylinder(1.0, 0.5);
  for (const double gap : {-1e-3, 0.0, 1e-3}) {
    for (const double yaw : {0.0, 0.3, 2.0}) {
      const Transformd pose = above_table(can, turned_by(0.0, yaw, {0.3, -0.2, 0.0}), gap);
      const ContactManifold found = contact_manifold(wide_table(), can, pose, 0.01);
      expect_is_sound(wide_table(), can, pose, found, 0.01, "cap");
      ASSERT_EQ(found.contacts.size(), 16u);
      EXPECT_NEAR(patch_area(found), 0.25 * kAreaOfCorners, 1e-9);
      EXPECT_GT(patch_area(found), 0.974 * kHalfTurn * 0.25);
      for (const auto& c : found.contacts) {
        EXPECT_NEAR(c.signed_distance, gap, 1e-9);
        EXPECT_NEAR(std::hypot(c.point_b.x - 0.3, c.point_b.y + 0.2), 0.5, 1e-12) << "on the rim";
        EXPECT_EQ(kind_of(c.feature_b), FeatureKind::vertex);
        EXPECT_EQ(kind_of(c.feature_a), FeatureKind::face);
      }
      const ContactManifold four = four_of(wide_table(), can, pose, 0.01);
      ASSERT_EQ(four.contacts.size(), 4u);
      EXPECT_NEAR(patch_area(four), 0.5, 1e-9) << "a square in the disc";
    }
  }
}

TEST(CurvedManifold, OfACylinderOnItsSideIsTheLineOnWhichItLies) {
  const ConvexBody can = Cylinder(1.0, 0.5);
  for (const double yaw : {0.0, 0.3, 2.0}) {
    const Transformd pose = above_table(can, turned_by(0.5 * kHalfTurn, yaw, {0.3, -0.2, 0.0}), -1e-3);
    const ContactManifold found = contact_manifold(wide_table(), can, pose);
    expect_is_sound(wide_table(), can, pose, found, 0.0, "side");
    ASSERT_EQ(found.contacts.size(), 2u);
    EXPECT_NEAR(norm(found.contacts[0].point_b - found.contacts[1].point_b), 1.0, 1e-9);
    for (const auto& c : found.contacts) EXPECT_NEAR(c.signed_distance, -1e-3, 1e-9);
  }
  // Half of it over the rim of the slab: the line ends there.
  const Transformd over = above_table(can, turned_by(0.5 * kHalfTurn, 0.0, {0.0, 3.0, 0.0}), -1e-3);
  const ContactManifold half = contact_manifold(wide_table(), can, over);
  ASSERT_EQ(half.contacts.size(), 2u);
  EXPECT_NEAR(norm(half.contacts[0].point_a - half.contacts[1].point_a), 0.5, 1e-8);
}

// The tilt turns no corner: each of the sixteen is the same point of the body.
TEST(CurvedManifold, OfATiltedCylinderHasTheSamePointsOfTheBody) {
  const ConvexBody can = Cylinder(1.0, 0.5);
  std::vector<Vec3d> upright(16);
  for (const double tilt : {0.0, 1e-9, 1e-6, 1e-3, 0.005, 0.0099}) {
    const Transformd pose = above_table(can, turned_by(tilt, 0.7, {0.3, -0.2, 0.0}), -1e-4);
    const ContactManifold found = contact_manifold(wide_table(), can, pose, 0.02);
    expect_is_sound(wide_table(), can, pose, found, 0.02, "tilted cap");
    ASSERT_GE(found.contacts.size(), 16u);
    const Transformd back = inverse(pose);
    std::size_t n_corners = 0;
    for (const auto& c : found.contacts) {
      const FeatureId corner = c.feature_b;
      if (corner >= 16) continue;  // the deepest point
      ++n_corners;
      const Vec3d at = back(c.point_b);
      if (tilt == 0.0) upright[corner] = at;
      EXPECT_LE(norm(at - upright[corner]), 2e-8) << tilt;
    }
    EXPECT_GE(n_corners, 14u);
  }
  // Beyond the feature angle it stands on its rim.
  const Transformd pose = above_table(can, turned_by(0.02, 0.7, {0.3, -0.2, 0.0}), -1e-4);
  EXPECT_EQ(contact_manifold(wide_table(), can, pose, 0.05).contacts.size(), 1u);
}

TEST(CurvedManifold, OfTwoCapsIsAboutTheirCommonPart) {
  const ConvexBody can = Cylinder(1.0, 0.5);
  for (const double shift : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    const Transformd pose = turned_by(0.0, 0.4, {shift, 0.0, 0.999});
    const ContactManifold found = contact_manifold(can, can, pose, 0.01);
    expect_is_sound(can, can, pose, found, 0.01, "two caps");
    const double half = std::acos(shift);
    const double lens = 2.0 * 0.25 * (half - shift * std::sqrt(1.0 - shift * shift));
    EXPECT_LE(patch_area(found), lens + 1e-9);
    EXPECT_GE(patch_area(found), (shift < 0.6 ? 0.93 : 0.0) * lens) << shift;
  }
  // A thin lens: the polygons of sixteen corners hardly meet, and the deepest point is there all the same.
  const Transformd apart = turned_by(0.0, 0.0, {0.9999, 0.0, 0.99999});
  const ContactManifold thin = contact_manifold(can, can, apart);
  expect_is_sound(can, can, apart, thin, 0.0, "a thin lens");
}

TEST(CurvedManifold, OfBodiesThatLieOrStandHasEnoughPointsToBeStable) {
  struct Row {
    const char* body;
    double about_x;
    std::size_t least, most;
  };
  const double lying = 0.5 * kHalfTurn;
  const Row rows[] = {{"cylinder:1,0.5", 0.0, 16, 16},
                      {"cylinder:1,0.5", lying, 2, 2},
                      {"cone:1,0.5", 0.0, 16, 16},
                      {"cone:1,0.5", lying + std::atan(0.5), 2, 2},
                      {"frustum:1,0.5,0.25", 0.0, 16, 16},
                      {"frustum:1,0.5,0.25", kHalfTurn, 16, 16},
                      {"frustum:1,0.5,0.25", lying + std::atan(0.25), 2, 2},
                      {"hemisphere:0.5", 0.0, 16, 16},
                      {"hemisphere:0.5", kHalfTurn, 1, 1},
                      {"disc:0.5", 0.0, 16, 16},
                      {"disc:0.5", lying, 1, 1},
                      {"capsule:1,0.25", lying, 2, 2},
                      {"capsule:1,0.25", 0.0, 1, 1},
                      {"rounded:0.1,cylinder:1,0.5", 0.0, 16, 16},
                      {"rounded:0.1,cylinder:1,0.5", lying, 2, 2},
                      {"rounded:0.1,cone:1,0.5", 0.0, 16, 16},
                      {"rounded:0.1,disc:0.5", 0.0, 16, 16},
                      {"rounded:0.1,box:1,1,1", 0.0, 4, 4},
                      {"box:1,1,1", 0.01, 4, 4},
                      {"ellipsoid:0.5,0.6,0.7", 0.3, 1, 1}};
  for (const Row& row : rows) {
    const ConvexBody body = body_of(row.body);
    const Transformd pose = above_table(body, turned_by(row.about_x, 0.4, {0.1, 0.2, 0.0}), -1e-4);
    const ContactManifold found = contact_manifold(wide_table(), body, pose, 0.02);
    expect_is_sound(wide_table(), body, pose, found, 0.02, row.body);
    EXPECT_GE(found.contacts.size(), row.least) << row.body << " " << row.about_x;
    EXPECT_LE(found.contacts.size(), row.most) << row.body << " " << row.about_x;
    // Seen from the other body.
    const Transformd back = inverse(pose);
    const ContactManifold other = contact_manifold(body, wide_table(), back, 0.02);
    expect_is_sound(body, wide_table(), back, other, 0.02, row.body);
    EXPECT_EQ(other.contacts.size(), found.contacts.size()) << row.body << " from the other side";
  }
}

// A box without an exact form, as a body of one's own: its corners come from its support mapping.
class OwnBox {
 public:
  Vec3d support(const Vec3d& dir) const {
    return {std::copysign(0.5, dir.x), std::copysign(0.5, dir.y), std::copysign(0.5, dir.z)};
  }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 0.8661; }
  double inradius() const { return 0.5; }
};

TEST(CurvedManifold, OfABodyOfOnesOwnIsFoundByItsSupportMappingAlone) {
  const ConvexBody own{OwnBox()}, box = Box(1.0, 1.0, 1.0);
  for (const double tilt : {0.0, 0.004, 0.25 * kHalfTurn}) {
    const Transformd pose = above_table(box, turned_by(tilt, 0.4, {0.1, 0.2, 0.0}), -1e-4);
    const ContactManifold found = contact_manifold(wide_table(), own, pose, 0.02);
    const ContactManifold truth = contact_manifold(wide_table(), box, pose, 0.02);
    expect_is_sound(wide_table(), own, pose, found, 0.02, "own");
    ASSERT_EQ(found.contacts.size(), truth.contacts.size()) << tilt;
    for (const auto& c : truth.contacts) {
      EXPECT_TRUE(
          std::ranges::any_of(found.contacts, [&](const auto& o) { return norm(o.point_b - c.point_b) < 1e-7; }));
    }
  }
}

// All bodies, upon each other as they fall.
// Their faces bend so that the middle is the deepest, and corners may be clear of the slab.
TEST(CurvedManifold, OfABodyThatIsDeepestInItsMiddleIsAsDeepAsTheSeparation) {
  for (const char* text : {"superball:3,0.5", "superball:4,0.5", "superball:10,0.5", "superellipsoid:1,1,1,4,4",
                           "ellipsoid:1,1,0.001", "rounded:0.01,superball:4,0.5"}) {
    const ConvexBody body = body_of(text);
    const double height = body.support({0.0, 0.0, 1.0}).z + 0.5;
    for (const double depth : {1e-5, 1e-4, 1e-3}) {
      const Transformd pose{.translation = {0.3, 0.2, height - depth}};
      for (const bool four : {false, true}) {
        ManifoldMemory memory;
        ContactManifold manifold;
        contact_manifold(wide_table(), body, pose, {.margin = 0.02, .four_at_most = four}, memory, manifold);
        const double bound = 0x1p-10 * 0.01 * (wide_table().circumradius() + body.circumradius());
        double deepest = HUGE_VAL;
        for (const auto& contact : manifold.contacts) deepest = std::fmin(deepest, contact.signed_distance);
        EXPECT_LE(deepest, manifold.separation.signed_distance + 1.01 * bound) << text << ", depth " << depth;
        EXPECT_LT(deepest, 0.0) << text << ", depth " << depth;
      }
    }
  }
}

TEST(CurvedManifold, OfAnAngleAboveARightOneIsRefused) {
  const ConvexBody box = body_of("box:1,1,1");
  for (const double angle : {-0.1, 1.6, 3.2, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(contact_manifold(box, box, Transformd{.translation = {0.1, 0.2, 0.999}}, 0.0, angle), UsageError);
  }
}

TEST(CurvedManifold, OfAnyTwoBodiesIsSound) {
  std::mt19937_64 random(7);
  int n_manifolds = 0, n_several = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = body_of(pair.a.c_str()), b = body_of(pair.b.c_str());
    for (int k = 0; k < 8; ++k) {
      Transformd pose = k % 2 == 0 ? random_rotation(random) : Transformd{};
      const Vec3d dir = k % 2 == 1 ? Vec3d{0.0, 0.0, 1.0} : random_direction(random);
      const double far = a.circumradius() + b.circumradius();
      const Vec3d turned_centre = pose(b.centre());
      pose.translation = (a.centre() - turned_centre) + (2.0 * far / norm(dir)) * dir;
      const Separation apart = distance(a, b, pose);
      if (!apart.has_witnesses) continue;
      pose.translation = pose.translation - (apart.signed_distance + (k % 4 < 2 ? 0.001 : -0.001)) * apart.normal;
      const ContactManifold manifold = contact_manifold(a, b, pose, 0.01);
      if (manifold.separation.is_rough) continue;
      expect_is_sound(a, b, pose, manifold, 0.01, pair.a + " " + pair.b + " " + std::to_string(k));
      ++n_manifolds;
      n_several += manifold.contacts.size() > 1 ? 1 : 0;
      const ContactManifold four = four_of(a, b, pose, 0.01);
      ASSERT_LE(four.contacts.size(), 4u);
      EXPECT_NEAR(least_distance(four), manifold.separation.signed_distance, 1e-4 * far);
      if (manifold.contacts.size() > 2) {
        EXPECT_GE(patch_area(four), 0.318 * patch_area(manifold) - 1e-12) << pair.a << " " << pair.b;
      }
    }
  }
  EXPECT_GT(n_manifolds, 1000);
  EXPECT_GT(n_several, n_manifolds / 5);
}

}  // namespace
}  // namespace vex
