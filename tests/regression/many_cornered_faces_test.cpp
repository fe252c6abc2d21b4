// Found 2026-11 by independent referees: contacts of a box on a prism of 400 sides took 0.45 s, of 1000 sides 6 s.
//
// Cause. For each contact each triangle of the face's outline looked for its three corners among all of them: the cube
// of their number. Corners of the outline are found once now, the triangle by bisection, and the face with fewer sides
// clips the other.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/query/first_contact.h"
#include "engine/query/manifold_certificate.h"
#include "shapes/box.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

ConvexBody prism(int n_sides) {
  std::vector<Vec3d> vertices;
  for (int k = 0; k < n_sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n_sides;
    for (const double z : {-0.5, 0.5}) vertices.push_back({std::cos(angle), std::sin(angle), z});
  }
  return Polytope(vertices, {}, 0.4);
}

TEST(ManyCorneredFaces, OfAPrismUnderABoxTouchAtTheBoxesCorners) {
  for (const int n_sides : {3, 4, 5, 12, 400, 1000, 5000}) {
    const ConvexBody below = prism(n_sides), box = Box(0.5, 0.5, 1.0);
    Transformd pose;
    pose.row_x = {0.8, -0.6, 0.0};
    pose.row_y = {0.6, 0.8, 0.0};
    pose.translation = {0.01, 0.02, 1.0 - 1e-3};
    const ContactManifold found = contact_manifold(below, box, pose);
    ASSERT_EQ(found.contacts.size(), 4U) << n_sides;
    for (const ContactManifold::Contact& contact : found.contacts) {
      EXPECT_NEAR(contact.signed_distance, -1e-3, 1e-12);
      EXPECT_NEAR(contact.point_a.z, 0.5, 1e-12);
      EXPECT_NEAR(contact.point_b.z, 0.5 - 1e-3, 1e-12);
      const double x = contact.point_b.x - 0.01, y = contact.point_b.y - 0.02;
      EXPECT_NEAR(std::fabs(0.8 * x + 0.6 * y), 0.25, 1e-12);
      EXPECT_NEAR(std::fabs(0.8 * y - 0.6 * x), 0.25, 1e-12);
    }
  }
}

TEST(ManyCorneredFaces, OfTwoPrismsTouchAlongWhatTheyHaveInCommon) {
  for (const int n_sides : {12, 400, 1000}) {
    const ConvexBody body = prism(n_sides);
    const ContactManifold found = contact_manifold(body, body, Transformd{.translation = {0.3, 0.0, 1.0}});
    ASSERT_GE(found.contacts.size(), static_cast<std::size_t>(n_sides / 2)) << n_sides;
    for (const ContactManifold::Contact& contact : found.contacts) {
      EXPECT_NEAR(contact.signed_distance, 0.0, 1e-12);
      const Vec3d& p = contact.point_a;
      EXPECT_LE(std::hypot(p.x, p.y), 1.0 + 1e-12);
      EXPECT_LE(std::hypot(p.x - 0.3, p.y), 1.0 + 1e-12);
      // At the rim of one of them.
      const double inner = std::cos(std::numbers::pi / n_sides) - 1e-12;
      EXPECT_TRUE(std::hypot(p.x, p.y) >= inner || std::hypot(p.x - 0.3, p.y) >= inner);
    }
  }
}

// Later, two shallow faces of many corners took milliseconds: for each contact all corners of both were asked for the
// one farthest above a triangle, some fifteen times, and each side of one outline all corners of the other.
ConvexBody shallow_dome(int n_corners, double radius, double yaw) {
  const auto height = [&](double off) { return 0.5 + radius * (std::sqrt(1.0 - off * off / (radius * radius)) - 1.0); };
  std::vector<Vec3d> vertices;
  const auto add = [&](double off, double angle) {
    for (const double side : {-1.0, 1.0}) {
      vertices.push_back({off * std::cos(angle), off * std::sin(angle), side * height(off)});
    }
  };
  const int n_rim = n_corners / 2, n_inside = n_corners - n_rim;
  for (int k = 0; k < n_rim; ++k) add(1.0, 2.0 * std::numbers::pi * k / n_rim + yaw);
  for (int k = 0; k < n_inside; ++k) add(0.99 * std::sqrt((k + 0.5) / n_inside), 2.399963 * k + yaw);
  return Polytope(vertices, {}, 0.3);
}

TEST(ManyCorneredFaces, ThatAreShallowAreProven) {
  for (const int n_corners : {20, 100, 500}) {
    for (const double radius : {150.0, 1e4, 1e6, 1e9}) {
      const ConvexBody a = shallow_dome(n_corners, radius, 0.0), b = shallow_dome(n_corners, radius, 0.1);
      for (const double gap : {0.0, 1e-3, -1e-3}) {
        Transformd pose;
        pose.row_x = {0.8, -0.6, 0.0};
        pose.row_y = {0.6, 0.8, 0.0};
        pose.translation = {0.1, 0.05, 1.0 + gap};
        const ContactManifold found = contact_manifold(a, b, pose, 0.03);
        EXPECT_GT(found.contacts.size(), static_cast<std::size_t>(n_corners / 5)) << n_corners << " " << radius;
        const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found), 0.03);
        EXPECT_TRUE(check.is_proven) << check.fault << " " << n_corners << " " << radius << " " << gap;
      }
    }
  }
}

// Found 2026-11 by timing: shallow faces of 500 corners still took 1.9 ms.
//
// Cause. At a place within rounding of a corner of the face triangles about the corner took turns, each of them hardly
// below the next one's corner, until as many were tried as the face has corners, twice. Now a search ends where nothing
// has been gained for some steps, and begins from what a walk from the last place's triangle comes to.
TEST(ManyCorneredFaces, ThatAreShallowTouchWhereRaysMeetThem) {
  for (const int n_corners : {100, 500, 1000}) {
    for (const double radius : {150.0, 1e4}) {
      const ConvexBody a = shallow_dome(n_corners, radius, 0.0), b = shallow_dome(n_corners, radius, 0.1);
      Transformd pose;
      pose.row_x = {0.8, -0.6, 0.0};
      pose.row_y = {0.6, 0.8, 0.0};
      pose.translation = {0.1, 0.05, 1.0 + 1e-3};
      const ContactManifold found = contact_manifold(a, b, pose, 0.03);
      ASSERT_GT(found.contacts.size(), static_cast<std::size_t>(n_corners / 5));
      const Vec3d& normal = found.separation.normal;
      for (const ContactManifold::Contact& contact : found.contacts) {
        // A little inside: a ray along the rim may miss.
        const Vec3d to_middle = 1e-9 * (found.separation.point_a - contact.point_a);
        const FirstContact of_a = cast_ray(a, (contact.point_a + to_middle) + normal, -normal);
        ASSERT_EQ(of_a.verdict.outcome, Outcome::overlap) << n_corners << " " << radius;
        EXPECT_NEAR(of_a.time, 1.0, 1e-9) << n_corners << " " << radius;
        const Transformd& a_from_b = pose;
        const Vec3d from = (contact.point_b + to_middle) - normal - a_from_b.translation;
        const FirstContact of_b = cast_ray(b, a_from_b.direction_to_b(from), a_from_b.direction_to_b(normal));
        ASSERT_EQ(of_b.verdict.outcome, Outcome::overlap) << n_corners << " " << radius;
        EXPECT_NEAR(of_b.time, 1.0, 1e-9) << n_corners << " " << radius;
      }
    }
  }
}

}  // namespace
}  // namespace vex
