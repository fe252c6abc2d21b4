// The examples of docs/queries.md, compiled and run: the test below holds the guide to this file, block by block.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// [headers]
#include "engine/numeric/eigen.h"
#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/separation.h"
#include "engine/query/separation_certificate.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
// [end]
#include "tests/docs/example_guide.h"

namespace {

TEST(QueryExamples, Overlap) {
  // [overlap]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), can = vex::Cylinder(1.0, 0.5);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of the can, in the box's frame
  pose.translation() = Eigen::Vector3d(0.0, 0.0, 1.25);
  const vex::Verdict verdict = vex::overlap(box, can, vex::from_eigen(pose));
  const bool are_apart = verdict.outcome == vex::Outcome::disjoint;  // proven; so is overlap; undecided is neither
  // [end]
  EXPECT_TRUE(are_apart);
}

TEST(QueryExamples, Distance) {
  // [distance]
  const vex::ConvexBody ball = vex::Sphere(0.5), egg = vex::Ellipsoid(1.0, 1.0, 2.0);
  const vex::Transformd pose{.translation = {3.0, 0.0, 0.0}};
  const vex::Separation found = vex::distance(ball, egg, pose);
  const double gap = found.signed_distance;  // between found.lower and found.upper: 1.5
  const vex::Vec3d from = found.point_a, to = found.point_b, direction = found.normal;
  // [end]
  EXPECT_NEAR(gap, 1.5, 1e-9);
  EXPECT_TRUE(found.lower <= 1.5 && 1.5 <= found.upper);
  EXPECT_NEAR(from.x, 0.5, 1e-9);
  EXPECT_NEAR(to.x, 2.0, 1e-9);
  EXPECT_NEAR(direction.x, 1.0, 1e-9);
}

TEST(QueryExamples, Depth) {
  // [depth]
  const vex::ConvexBody box = vex::Box(2.0, 2.0, 2.0);
  const vex::Transformd pose{.translation = {0.0, 0.0, 1.9}};
  const vex::Separation found = vex::penetration_depth(box, box, pose);
  const double depth = -found.signed_distance;      // 0.1
  const vex::Vec3d way_out = depth * found.normal;  // moves the second box into contact
  // [end]
  EXPECT_NEAR(depth, 0.1, 1e-15);
  EXPECT_NEAR(way_out.z, 0.1, 1e-15);
}

TEST(QueryExamples, SignedDistanceForSimulation) {
  const vex::ConvexBody a = vex::Cylinder(1.0, 0.5), b = vex::Cylinder(2.0, 0.25);
  // [signed]
  vex::WarmStart warm_start;  // one for each pair of bodies, kept from step to step
  std::vector<vex::Separation> steps;
  for (int k = 0; k < 100; ++k) {
    const vex::Transformd pose{.translation = {1.0 - 0.01 * k, 0.0, 0.0}};
    steps.push_back(vex::signed_distance(a, b, pose, {.relative_gap = 1e-3}, &warm_start));
  }  // continuous through contact; upper - lower tells what the approximation is worth
  // [end]
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double expected = 0.25 - 0.01 * static_cast<double>(k);
    EXPECT_LE(steps[k].lower, expected + 1e-12);
    EXPECT_GE(steps[k].upper, expected - 1e-12);
    EXPECT_LE(steps[k].upper - steps[k].lower, 4e-3);
  }
}

TEST(QueryExamples, Margin) {
  // [margin]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0);
  const vex::ConvexBody wide_box = vex::with_margin(box, 0.1);  // made once
  const vex::Transformd pose{.translation = {0.0, 0.0, 1.05}};
  const bool is_near = vex::overlap(wide_box, box, pose).outcome == vex::Outcome::overlap;  // is the gap at most 0.1?
  // [end]
  EXPECT_TRUE(is_near);
}

TEST(QueryExamples, RayCast) {
  // [ray]
  const vex::ConvexBody egg = vex::Ellipsoid(1.0, 1.0, 2.0);
  const vex::FirstContact hit = vex::cast_ray(egg, {0.0, 0.0, 5.0}, {0.0, 0.0, -2.0});
  const bool is_hit = hit.verdict.outcome == vex::Outcome::overlap;
  const double time = hit.time;  // 1.5: the point is origin + time * direction
  const vex::Vec3d out_of_the_egg = hit.normal;
  // [end]
  EXPECT_TRUE(is_hit);
  EXPECT_NEAR(time, 1.5, 1e-9);
  EXPECT_NEAR(out_of_the_egg.z, 1.0, 1e-6);
}

TEST(QueryExamples, LinearCast) {
  // [cast]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), ball = vex::Sphere(0.5);
  const vex::Transformd start{.translation = {5.0, 0.0, 0.0}};
  const vex::FirstContact hit = vex::linear_cast(box, ball, start, {-1.0, 0.0, 0.0});
  const double time = hit.time;  // 4, between hit.lower and hit.upper
  // [end]
  EXPECT_NEAR(time, 4.0, 1e-12);
}

TEST(QueryExamples, TimeOfImpact) {
  // [toi]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), bar = vex::Box(4.0, 0.1, 0.1);
  const vex::Transformd start{.translation = {0.0, 1.5, 0.0}};
  const vex::RigidMotion motion{.velocity = {}, .angular_velocity = {0.0, 0.0, 1.0}};  // radians per unit of time
  const vex::FirstContact hit = vex::time_of_impact(box, bar, start, motion);
  const vex::Transformd at_contact = vex::pose_at(start, motion, hit.time);
  // [end]
  EXPECT_EQ(hit.verdict.outcome, vex::Outcome::overlap);
  EXPECT_NEAR(vex::signed_distance(box, bar, at_contact).signed_distance, 0.0, 1e-9);
}

TEST(QueryExamples, TimeOfImpactOfTwo) {
  // [both]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), bar = vex::Box(4.0, 0.1, 0.1);
  const vex::Transformd start{.translation = {0.0, 3.0, 0.0}};
  const vex::RigidMotion of_box{.velocity = {0.0, 0.5, 0.0}, .angular_velocity = {0.0, 0.0, 0.2}};
  const vex::RigidMotion of_bar{.velocity = {}, .angular_velocity = {0.0, 0.0, 1.0}};
  const vex::FirstContact hit = vex::time_of_impact(box, bar, start, of_box, of_bar, 0.5);
  const bool is_free_until_then = hit.verdict.outcome == vex::Outcome::disjoint;
  // [end]
  EXPECT_TRUE(is_free_until_then);
}

TEST(QueryExamples, ContactManifold) {
  // [manifold]
  const vex::ConvexBody table = vex::Box(4.0, 4.0, 1.0), can = vex::Cylinder(1.0, 0.5);
  const vex::Transformd on_it{.translation = {0.5, 0.0, 0.999}};
  vex::ManifoldMemory memory;  // which a thread keeps: it grows no more once it has seen manifolds as large
  vex::ContactManifold touching;
  vex::contact_manifold(table, can, on_it, {.margin = 0.02, .four_at_most = true}, memory, touching);
  double deepest = 0.0;
  for (const auto& contact : touching.contacts) deepest = std::min(deepest, contact.signed_distance);
  // [end]
  EXPECT_EQ(touching.contacts.size(), 4u);
  EXPECT_NEAR(deepest, -0.001, 1e-9);
}

TEST(QueryExamples, Certificates) {
  // [certificate]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), can = vex::Cylinder(1.0, 0.5);
  const vex::Transformd pose{.translation = {0.0, 0.0, 1.25}};
  const vex::Separation found = vex::distance(box, can, pose);
  const vex::SeparationCertificate proof = vex::certify(box, can, pose, found);
  const bool is_proven = vex::check_certificate(box, can, pose, found, proof).is_proven;
  // [end]
  EXPECT_TRUE(is_proven);
}

// --- the guide

TEST(QueryGuide, HasOnlyExamplesThatAreCompiledAndAllOfThem) {
  const std::vector<std::string> compiled = vex::test::compiled_examples("tests/docs/query_examples.cpp");
  EXPECT_EQ(compiled.size(), 12u);
  EXPECT_EQ(vex::test::shown_examples("docs/queries.md"), compiled);
}

}  // namespace
