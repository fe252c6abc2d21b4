#include "engine/query/contact_manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/numeric/pose_algebra.h"
#include "engine/query/search/planar_polygon.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kQuarter = 0.25 * std::numbers::pi;

Transformd turned_about_z(double angle, const Vec3d& translation) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}, translation};
}
Transformd turned_about_x(double angle, const Vec3d& translation) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{1.0, 0.0, 0.0}, {0.0, c, -s}, {0.0, s, c}, translation};
}
Transformd product(const Transformd& p, const Transformd& q) {
  const auto column = [&](double x, double y, double z) {
    return Vec3d{dot(p.row_x, {x, y, z}), dot(p.row_y, {x, y, z}), dot(p.row_z, {x, y, z})};
  };
  const Vec3d x = column(q.row_x.x, q.row_y.x, q.row_z.x), y = column(q.row_x.y, q.row_y.y, q.row_z.y),
              z = column(q.row_x.z, q.row_y.z, q.row_z.z);
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, p(q.translation)};
}

// What holds of every manifold: opposite each other, along the normal, by the distance; counter-clockwise against it;
// none nearer than the separation.
void expect_is_sound(const ContactManifold& manifold, double tolerance) {
  const Vec3d normal = manifold.separation.normal;
  const auto& contacts = manifold.contacts;
  ASSERT_FALSE(contacts.empty());
  double least = HUGE_VAL;
  for (const ContactManifold::Contact& c : contacts) {
    const Vec3d across = (c.point_b - c.point_a) - c.signed_distance * normal;
    EXPECT_LE(norm(across), tolerance);
    least = std::min(least, c.signed_distance);
  }
  EXPECT_NEAR(least, manifold.separation.signed_distance, tolerance);
  for (std::size_t k = 0; k < contacts.size() && contacts.size() > 2; ++k) {
    const Vec3d& p = contacts[k].point_a;
    const Vec3d& q = contacts[(k + 1) % contacts.size()].point_a;
    const Vec3d& r = contacts[(k + 2) % contacts.size()].point_a;
    EXPECT_GT(dot(normal, cross(q - p, r - q)), 0.0);
  }
}

bool has_contact_at(const ContactManifold& manifold, const Vec3d& point_a, double tolerance) {
  return std::ranges::any_of(manifold.contacts, [&](const auto& c) { return norm(c.point_a - point_a) <= tolerance; });
}

double area_of(const ContactManifold& manifold) {
  Vec3d sum;
  const auto& contacts = manifold.contacts;
  for (std::size_t k = 1; k + 1 < contacts.size(); ++k) {
    sum = sum + cross(contacts[k].point_a - contacts[0].point_a, contacts[k + 1].point_a - contacts[0].point_a);
  }
  return 0.5 * dot(sum, manifold.separation.normal);
}

const ConvexBody& cube() {
  static const ConvexBody kCube = Box(1.0, 1.0, 1.0);
  return kCube;
}
const ConvexBody& slab() {
  static const ConvexBody kSlab = Box(4.0, 4.0, 1.0);
  return kSlab;
}

TEST(ContactManifold, OfCubesFaceOnFaceIsTheRectangleTheyShare) {
  for (const double depth : {0.0, 0x1p-40, 0x1p-4}) {
    const ContactManifold manifold = contact_manifold(cube(), cube(), turned_about_z(0.0, {0.25, 0.5, 1.0 - depth}));
    expect_is_sound(manifold, 1e-14);
    ASSERT_EQ(manifold.contacts.size(), 4u);
    for (const double x : {-0.25, 0.5}) {
      for (const double y : {0.0, 0.5}) EXPECT_TRUE(has_contact_at(manifold, {x, y, 0.5}, 1e-14));
    }
    for (const auto& c : manifold.contacts) EXPECT_NEAR(c.signed_distance, -depth, 1e-15);
  }
}

TEST(ContactManifold, OfTheSameFaceIsThatFace) {
  const ContactManifold manifold = contact_manifold(cube(), cube(), turned_about_z(0.0, {0.0, 0.0, 1.0}));
  expect_is_sound(manifold, 1e-14);
  EXPECT_EQ(manifold.contacts.size(), 4u);
  EXPECT_NEAR(area_of(manifold), 1.0, 1e-14);
}

TEST(ContactManifold, OfCubesTurnedByHalfARightAngleIsAnOctagon) {
  const ContactManifold manifold = contact_manifold(cube(), cube(), turned_about_z(kQuarter, {0.0, 0.0, 0.99}));
  expect_is_sound(manifold, 1e-14);
  EXPECT_EQ(manifold.contacts.size(), 8u);
  EXPECT_NEAR(area_of(manifold), 2.0 * (std::numbers::sqrt2 - 1.0), 1e-14);
}

TEST(ContactManifold, OfBodiesThatAreApartIsGivenUpToTheMargin) {
  const Transformd pose = turned_about_z(0.3, {0.0, 0.0, 1.01});
  EXPECT_TRUE(contact_manifold(cube(), cube(), pose).contacts.empty());
  EXPECT_TRUE(contact_manifold(cube(), cube(), pose, 0.0099).contacts.empty());
  const ContactManifold manifold = contact_manifold(cube(), cube(), pose, 0.0101);
  expect_is_sound(manifold, 1e-14);
  EXPECT_EQ(manifold.contacts.size(), 8u);
  for (const auto& c : manifold.contacts) EXPECT_NEAR(c.signed_distance, 0.01, 1e-14);
}

TEST(ContactManifold, OfAnEdgeOnAFaceIsTheEdge) {
  const Transformd pose = turned_about_x(kQuarter, {0.0, 0.0, 0.5 + std::sqrt(0.5) - 0.01});
  const ContactManifold manifold = contact_manifold(slab(), cube(), pose);
  expect_is_sound(manifold, 1e-13);
  ASSERT_EQ(manifold.contacts.size(), 2u);
  EXPECT_TRUE(has_contact_at(manifold, {-0.5, 0.0, 0.5}, 1e-13));
  EXPECT_TRUE(has_contact_at(manifold, {0.5, 0.0, 0.5}, 1e-13));
  // Half of it beyond the rim.
  Transformd at_rim = pose;
  at_rim.translation.x = 2.0;
  const ContactManifold half = contact_manifold(slab(), cube(), at_rim);
  ASSERT_EQ(half.contacts.size(), 2u);
  EXPECT_TRUE(has_contact_at(half, {1.5, 0.0, 0.5}, 1e-13));
  EXPECT_TRUE(has_contact_at(half, {2.0, 0.0, 0.5}, 1e-13));
}

TEST(ContactManifold, OfACornerOnAFaceIsOnePoint) {
  std::mt19937_64 random(1);
  int n_one = 0;
  for (int k = 0; k < 100; ++k) {
    Transformd pose = random_rotation(random);
    const Vec3d lowest = pose(cube().support(-pose.direction_to_b({0.0, 0.0, 1.0})));
    pose.translation = {0.1, 0.2, 0.5 - lowest.z - 0.001};
    const ContactManifold manifold = contact_manifold(slab(), cube(), pose);
    expect_is_sound(manifold, 1e-12);
    if (manifold.contacts.size() == 1) ++n_one;
    EXPECT_TRUE(has_contact_at(manifold, {0.1 + lowest.x, 0.2 + lowest.y, 0.5}, 1e-12));
  }
  EXPECT_GT(n_one, 80);
}

TEST(ContactManifold, OfTwoEdgesIsWhereTheyCrossAndOfParallelOnesWhatTheyShare) {
  const Transformd edge_up = inverse(turned_about_x(kQuarter, {}));
  const double s = std::sqrt(0.5), height = 2.0 * s - 0.01;
  const Transformd across{{s, 0.0, s}, {0.0, 1.0, 0.0}, {-s, 0.0, s}, {0.1, 0.2, height}};
  const ContactManifold one = contact_manifold(cube(), cube(), product(edge_up, across));
  expect_is_sound(one, 1e-13);
  ASSERT_EQ(one.contacts.size(), 1u);
  EXPECT_NEAR(one.contacts[0].signed_distance, -0.01, 1e-13);
  EXPECT_TRUE(has_contact_at(one, {0.1, 0.5, 0.5}, 1e-13));
  // The other edge 90 degrees sharp, so that edge on edge is the shortest way out.
  const ConvexBody wedge = parse_shape("octahedron:1").body;
  const Transformd edge_down = turned_about_z(kQuarter, {});
  const ContactManifold two =
      contact_manifold(wedge, wedge, product(edge_down, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.8, 0.8, 0.0}}), 1.0);
  expect_is_sound(two, 1e-12);
}

TEST(ContactManifold, OfTiltedFacesIsAPolygonWithinTheFeatureAngleAndAnEdgeWithout) {
  const double depth = 0.01;
  for (const double tilt : {0.002, 0.005, 0.009}) {
    const double lowest = 0.5 * (std::cos(tilt) + std::sin(tilt));
    const Transformd pose = turned_about_x(tilt, {0.0, 0.0, 0.5 + lowest - depth});
    const ContactManifold face = contact_manifold(slab(), cube(), pose);
    expect_is_sound(face, 1e-13);
    ASSERT_EQ(face.contacts.size(), 4u);
    // B's own corners, and below them A.
    for (const auto& c : face.contacts) {
      EXPECT_NEAR(c.point_a.z, 0.5, 1e-14);
      EXPECT_NEAR(c.signed_distance, c.point_a.y < 0.0 ? -depth : std::sin(tilt) - depth, 1e-13);
    }
    EXPECT_EQ(contact_manifold(slab(), cube(), pose, 0.0, 0.9 * tilt).contacts.size(), 2u);
  }
  const double tilt = 0.02, lowest = 0.5 * (std::cos(tilt) + std::sin(tilt));
  EXPECT_EQ(contact_manifold(slab(), cube(), turned_about_x(tilt, {0.0, 0.0, 0.5 + lowest - depth})).contacts.size(),
            2u);
}

// About any axis in the plane; and they are the same four as of the box that is not tilted.
TEST(ContactManifold, OfABoxTiltedByAHundredthKeepsItsFourContactsWithinAMargin) {
  const auto names_of = [](const ContactManifold& manifold) {
    std::vector<std::pair<FeatureId, FeatureId>> names;
    for (const auto& c : manifold.contacts) names.emplace_back(c.feature_a, c.feature_b);
    std::ranges::sort(names);
    return names;
  };
  const auto upright = names_of(contact_manifold(slab(), cube(), turned_about_z(0.0, {0.1, 0.2, 1.0})));
  ASSERT_EQ(upright.size(), 4u);
  for (int k = 0; k < 32; ++k) {
    const Transformd yaw = turned_about_z(0.2 * k, {});
    Transformd pose = product(yaw, product(turned_about_x(0.01, {}), inverse(yaw)));
    const Vec3d lowest = pose(cube().support(-pose.direction_to_b({0.0, 0.0, 1.0})));
    pose.translation = {0.1, 0.2, 0.5 - lowest.z - 1e-3};
    const ContactManifold manifold = contact_manifold(slab(), cube(), pose, 0.02);
    expect_is_sound(manifold, 1e-13);
    EXPECT_EQ(names_of(manifold), upright) << k;
  }
}

TEST(ContactManifold, OfAFaceTiltedBothWaysIsTheFaceOrAnEdgeOrACorner) {
  const Transformd about_y{{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {}};  // a quarter turn about z
  const auto contacts = [&](double tilt_x, double tilt_y) {
    Transformd pose = product(turned_about_x(tilt_x, {}), product(about_y, turned_about_x(tilt_y, {})));
    const Vec3d lowest = pose(cube().support(-pose.direction_to_b({0.0, 0.0, 1.0})));
    pose.translation.z = 0.5 - lowest.z - 0.05;
    const ContactManifold manifold = contact_manifold(slab(), cube(), pose);
    expect_is_sound(manifold, 1e-13);
    return manifold.contacts.size();
  };
  EXPECT_EQ(contacts(0.004, 0.007), 4u);
  EXPECT_EQ(contacts(0.007, 0.007), 4u) << "0.0099 together";
  EXPECT_EQ(contacts(0.008, 0.02), 2u);
  EXPECT_EQ(contacts(0.02, 0.008), 2u);
  EXPECT_EQ(contacts(0.02, 0.03), 1u);
}

TEST(ContactManifold, LeavesOutCornersThatAreFartherThanTheMargin) {
  const double tilt = 0.009, lowest = 0.5 * (std::cos(tilt) + std::sin(tilt));
  const Transformd pose = turned_about_x(tilt, {0.0, 0.0, 0.5 + lowest - 0.001});
  EXPECT_EQ(contact_manifold(slab(), cube(), pose).contacts.size(), 2u);
  EXPECT_EQ(contact_manifold(slab(), cube(), pose, 0.007).contacts.size(), 2u);
  EXPECT_EQ(contact_manifold(slab(), cube(), pose, 0.009).contacts.size(), 4u);
}

TEST(ContactManifold, OfDodecahedraFaceOnFaceIsTheirPentagonsCommonPart) {
  const ConvexBody body = parse_shape("dodecahedron:0.5").body;
  const std::vector<Vec3d> vertices = vertices_of(body);
  // A face: the five vertices farthest along its normal, which is that of an icosahedron's vertex.
  const double phi = std::numbers::phi;
  const Vec3d normal = (1.0 / std::hypot(1.0, phi)) * Vec3d{0.0, 1.0, phi};
  double height = -HUGE_VAL;
  for (const Vec3d& v : vertices) height = std::max(height, dot(normal, v));
  const auto n_in_face =
      std::ranges::count_if(vertices, [&](const Vec3d& v) { return dot(normal, v) > height - 1e-12; });
  const Vec3d axis = n_in_face == 5 ? normal : (1.0 / std::hypot(1.0, phi)) * Vec3d{0.0, phi, 1.0};
  height = -HUGE_VAL;
  for (const Vec3d& v : vertices) height = std::max(height, dot(axis, v));
  // Faces are opposite each other turned by a tenth of a turn: ten corners, at a shift fewer.
  const ContactManifold decagon = contact_manifold(body, body, turned_about_z(0.0, (2.0 * height - 0.001) * axis));
  expect_is_sound(decagon, 1e-12);
  EXPECT_EQ(decagon.contacts.size(), 10u);
  const Vec3d aside = (1.0 / norm(cross(axis, Vec3d{1, 2, 3}))) * cross(axis, Vec3d{1, 2, 3});
  const ContactManifold shifted =
      contact_manifold(body, body, turned_about_z(0.0, (2.0 * height - 0.001) * axis + 0.2 * aside));
  expect_is_sound(shifted, 1e-12);
  EXPECT_GE(shifted.contacts.size(), 3u);
  EXPECT_LT(area_of(shifted), area_of(decagon));
}

TEST(ContactManifold, OfRoundedPolytopesIsThatOfTheirCoresLessTheRadii) {
  const ConvexBody rounded_cube = parse_shape("rounded:0.125,box:1,1,1").body;
  const ContactManifold manifold =
      contact_manifold(rounded_cube, rounded_cube, turned_about_z(kQuarter, {0.0, 0.0, 1.2}));
  expect_is_sound(manifold, 1e-14);
  EXPECT_EQ(manifold.contacts.size(), 8u);
  for (const auto& c : manifold.contacts) {
    EXPECT_NEAR(c.signed_distance, -0.05, 1e-14);
    EXPECT_NEAR(c.point_a.z, 0.625, 1e-14);
  }
  // A capsule that lies.
  const Transformd lying{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 0.74}};
  const ContactManifold line = contact_manifold(slab(), parse_shape("capsule:1,0.25").body, lying);
  expect_is_sound(line, 1e-14);
  EXPECT_EQ(line.contacts.size(), 2u);
}

TEST(ContactManifold, OfBodiesThatBendAwayIsTheSeparationsPoint) {
  for (const char* name : {"sphere:1", "ellipsoid:1,2,1", "egg:1,2,1", "cone:2,0.5"}) {
    const Transformd upside_down{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0.1, 0.2, 1.47}};
    const ContactManifold manifold = contact_manifold(slab(), parse_shape(name).body, upside_down);
    ASSERT_EQ(manifold.contacts.size(), 1u);
    EXPECT_NEAR(manifold.contacts[0].signed_distance, manifold.separation.signed_distance, 1e-14);
    EXPECT_NEAR(manifold.contacts[0].point_a.z, 0.5, 1e-12);
  }
}

TEST(ContactManifold, OfFlatBodiesIsThatOfTheirFaces) {
  const ConvexBody plate = parse_shape("plate:1,1").body;
  const ContactManifold manifold = contact_manifold(plate, plate, turned_about_z(kQuarter, {0.0, 0.0, 0.01}), 0.02);
  expect_is_sound(manifold, 1e-14);
  EXPECT_EQ(manifold.contacts.size(), 8u);
}

// Of all polytopes, in contact and nearly, seen from either body.
TEST(ContactManifold, OfSwappedBodiesIsTheSame) {
  std::mt19937_64 random(2);
  int n_manifolds = 0, n_several = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    if (!a.exact_form()->is_rounded_polytope() || !b.exact_form()->is_rounded_polytope()) continue;
    for (int k = 0; k < 20; ++k) {
      Transformd pose = k % 2 == 0 ? random_rotation(random) : Transformd{};
      const Vec3d dir = k % 2 == 1 ? Vec3d{0.0, 0.0, 1.0} : random_direction(random);
      const double far = a.circumradius() + b.circumradius();
      const Vec3d turned_centre = pose(b.centre());
      pose.translation = (a.centre() - turned_centre) + (2.0 * far / norm(dir)) * dir;
      const Separation apart = distance(a, b, pose);
      if (!apart.has_witnesses) continue;
      pose.translation = pose.translation - (apart.signed_distance + 0.001) * apart.normal;
      const ContactManifold manifold = contact_manifold(a, b, pose, 0.01);
      const ContactManifold other = contact_manifold(b, a, inverse(pose), 0.01);
      const double reach = a.reach() + b.reach() + norm_1(pose.translation);
      expect_is_sound(manifold, 1e-11 * reach);
      expect_is_sound(other, 1e-11 * reach);
      // Where the shortest way out is one.
      const Vec3d& n = other.separation.normal;
      if (norm(manifold.separation.normal + Vec3d{dot(pose.row_x, n), dot(pose.row_y, n), dot(pose.row_z, n)}) > 1e-9) {
        continue;
      }
      ++n_manifolds;
      if (manifold.contacts.size() > 1) ++n_several;
      ASSERT_EQ(manifold.contacts.size(), other.contacts.size()) << pair.a << " " << pair.b << " " << k;
      for (const auto& c : other.contacts) {
        EXPECT_TRUE(has_contact_at(manifold, pose(c.point_b), 1e-6 * reach)) << pair.a << " " << pair.b << " " << k;
      }
    }
  }
  EXPECT_GT(n_manifolds, 400);
  EXPECT_GT(n_several, 0.15 * n_manifolds);
  EXPECT_LT(n_several, 0.7 * n_manifolds);
}

// Edges at 0.0023 radians: on a mean line between them contacts would be off both.
TEST(ContactManifold, OfNearlyParallelEdgesIsOnBothEdges) {
  const ConvexBody plate = parse_shape("box:1,2,0.1").body;
  const Transformd pose{{0.99999832743031491, -0.0016511840829067153, 0.00078659245928191124},
                        {0.0016524952239314072, 0.99999724161439019, -0.0016691384441795403},
                        {-0.00078383423472539392, 0.0016704354927113221, 0.99999829762312953},
                        {0.99861120575760831, -0.13485713527898743, 0.1010519263102696}};
  const Transformd back = inverse(pose);
  const Vec3d half{0.5, 1.0, 0.05};
  // On an edge of the box that is along y.
  const auto off_edge = [&](const Vec3d& p) {
    return std::hypot(std::fabs(p.x) - half.x, std::fabs(p.z) - half.z, std::fmax(std::fabs(p.y) - half.y, 0.0));
  };
  for (const double margin : {1e-9, 1e-3}) {
    const ContactManifold manifold = contact_manifold(plate, plate, pose, margin);
    ASSERT_EQ(manifold.contacts.size(), 2u);
    EXPECT_GT(norm(manifold.contacts[0].point_a - manifold.contacts[1].point_a), 1.8);
    for (const auto& c : manifold.contacts) {
      EXPECT_LE(off_edge(c.point_a), 1e-14);
      EXPECT_LE(off_edge(back(c.point_b)), 1e-14);
      EXPECT_NEAR(dot(c.point_b - c.point_a, manifold.separation.normal), c.signed_distance, 1e-15);
      EXPECT_NEAR(c.signed_distance, manifold.separation.signed_distance, 1e-14);
      EXPECT_LE(norm(c.point_b - c.point_a), 0.0024 * 2.0);
    }
  }
}

TEST(ContactManifold, OfCurvedBodiesHasTheDistanceOfItsPoints) {
  std::mt19937_64 random(4);
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    for (int k = 0; k < 4; ++k) {
      Transformd pose = random_rotation(random);
      pose.translation = (0.3 * (a.circumradius() + b.circumradius())) * random_direction(random);
      const ContactManifold manifold = contact_manifold(a, b, pose);
      for (const auto& c : manifold.contacts) {
        EXPECT_NEAR(c.signed_distance, dot(c.point_b - c.point_a, manifold.separation.normal),
                    1e-14 * (a.reach() + b.reach()));
      }
    }
  }
  const ConvexBody ball = parse_shape("sphere:0.5").body;
  const ContactManifold touching = contact_manifold(ball, ball, turned_about_z(0.0, {0.0, 0.0, 1.0}));
  ASSERT_EQ(touching.contacts.size(), 1u);
  EXPECT_EQ(touching.contacts[0].signed_distance, 0.0);
  EXPECT_FALSE(std::signbit(touching.contacts[0].signed_distance));
}

// The upper sides of two squares cross so near to a corner of one of them that to any use they do there.
TEST(ContactManifold, HasNoTwoCornersInOnePlace) {
  const auto contacts = [](double angle, double from_corner) {
    const double up = from_corner * std::tan(angle) - (0.5 / std::cos(angle) - 0.5);
    const ContactManifold manifold = contact_manifold(cube(), cube(), turned_about_z(angle, {0.5, up, 1.0 - 0x1p-10}));
    expect_is_sound(manifold, 1e-14);
    return manifold.contacts;
  };
  for (const double angle : {1e-5, 1e-4, 1e-3, 0.01, 0.1}) {
    for (const double from_corner : {0.0, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
      const auto found = contacts(angle, from_corner);
      EXPECT_EQ(found.size(), 4u) << angle << " " << from_corner;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_GT(norm(found[k].point_a - found[(k + 1) % found.size()].point_a), 0x1p-27);
      }
    }
    EXPECT_EQ(contacts(angle, 1e-6).size(), 5u);
  }
}

std::vector<PlanarPoint> hull_of(const std::vector<PlanarPoint>& points) {
  PlanarMemory memory;
  std::vector<PlanarPoint> hull;
  planar_hull(points, 1e-12, memory, hull);
  return hull;
}

TEST(PlanarHull, OfPointsOnALineIsItsEndsAndOfOnePlaceAPoint) {
  EXPECT_EQ(hull_of({{0.0, 0.0}, {1.0, 1.0}, {0.5, 0.5}, {0.25, 0.25 + 1e-15}}).size(), 2u);
  EXPECT_EQ(hull_of({{1.0, 2.0}, {1.0, 2.0}, {1.0 + 1e-15, 2.0}}).size(), 1u);
  EXPECT_EQ(hull_of({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.5, 0.0}, {1.0, 1.0}, {0.5, 0.5}}).size(), 4u);
}

TEST(PlanarHull, HasEveryPointToTheLeftOfItsSides) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 200; ++k) {
    std::vector<PlanarPoint> points;
    for (int i = 0; i < 3 + k % 30; ++i) {
      const Vec3d p = random_direction(random);
      // Also on a coarse grid, where many are the same or on a line.
      points.push_back(k % 2 == 0 ? PlanarPoint{p.x, p.y} : PlanarPoint{std::round(3.0 * p.x), std::round(3.0 * p.y)});
    }
    const std::vector<PlanarPoint> hull = hull_of(points);
    for (std::size_t i = 0; i < hull.size() && hull.size() > 2; ++i) {
      const PlanarPoint &p = hull[i], &q = hull[(i + 1) % hull.size()];
      for (const PlanarPoint& x : points) EXPECT_GE(turn(q - p, x - p), -1e-11);
    }
  }
}

}  // namespace
}  // namespace vex
