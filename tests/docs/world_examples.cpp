// The examples of docs/worlds.md, compiled and run: the test below holds the guide to this file, block by block.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

// [headers]
#include "engine/query/half_space.h"
#include "engine/query/half_space_certificate.h"
#include "engine/query/plane_contacts.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cylinder.h"
#include "shapes/scaled.h"
#include "shapes/sphere.h"
// [end]
#include "tests/docs/example_guide.h"

namespace {

TEST(WorldExamples, Poses) {
  // [poses]
  const vex::Pose world_from_arm = vex::pose_of({1.0, 0.0, 0.0, 1.0}, {2.0, 0.0, 0.0});  // quaternion w, x, y, z; place
  const vex::Pose arm_from_hand = vex::Transformd{.translation = {0.0, 0.0, 0.5}};
  const vex::Pose world_from_hand = world_from_arm * arm_from_hand;
  const vex::Pose hand_from_world = vex::inverse(world_from_hand);
  const vex::Pose half_way = vex::interpolated(world_from_arm, world_from_hand, 0.5);
  // [end]
  EXPECT_NEAR(world_from_hand.a_from_b().translation.z, 0.5, 1e-15);
  EXPECT_NEAR(hand_from_world.a_from_b().translation.y, 2.0, 1e-15);
  EXPECT_NEAR(half_way.a_from_b().translation.z, 0.25, 1e-15);
}

TEST(WorldExamples, TwoPoses) {
  // [two poses]
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0), can = vex::Cylinder(1.0, 0.5);
  const vex::Pose at_box = vex::Transformd{.translation = {1e6, 0.0, 0.0}};
  const vex::Pose at_can = vex::Transformd{.translation = {1e6, 0.0, 1.25}};
  const vex::Separation found = vex::signed_distance(box, at_box, can, at_can);  // 0.25; normal and points in the world
  const double error = vex::relative_pose_error(at_box, at_can, can.reach());    // 1e-14, a million from the origin
  const bool are_apart_as_given = found.lower > error;
  const vex::FirstContact hit = vex::cast_ray(box, at_box, {1e6, 0.0, 5.0}, {0.0, 0.0, -1.0});  // at 4.5
  // [end]
  EXPECT_NEAR(found.signed_distance, 0.25, 1e-14);
  EXPECT_LT(error, 5e-14);
  EXPECT_TRUE(are_apart_as_given);
  EXPECT_NEAR(hit.time, 4.5, 1e-14);
}

TEST(WorldExamples, Floor) {
  // [floor]
  const vex::HalfSpace floor({0.0, 0.0, 1.0}, 0.0);  // z <= 0
  const vex::ConvexBody can = vex::Cylinder(1.0, 0.5);
  const vex::Pose above = vex::Transformd{.translation = {0.0, 0.0, 2.0}};
  const double height = vex::signed_distance(floor, can, above).signed_distance;  // 1.5
  const vex::FirstContact fall = vex::linear_cast(floor, can, above, {0.0, 0.0, -3.0});
  const vex::Pose on_floor = vex::Transformd{.translation = {0.0, 0.0, 0.499}};
  const vex::PlaneContacts points(can);  // once for a body
  std::vector<vex::PlaneContact> contacts;
  points.find(floor, on_floor, 0.01, contacts);  // four, on the rim of the cap
  // [end]
  EXPECT_NEAR(height, 1.5, 1e-15);
  EXPECT_NEAR(fall.time, 0.5, 1e-15);
  EXPECT_EQ(contacts.size(), 4u);
}

TEST(WorldExamples, Landing) {
  // [landing]
  const vex::HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const vex::ConvexBody can = vex::Cylinder(1.0, 0.5);
  const vex::Pose above = vex::Transformd{.translation = {0.0, 0.0, 2.0}};
  const vex::RigidMotion falling{.velocity = {0.0, 0.0, -3.0}, .angular_velocity = {2.0, 0.0, 0.0}};
  const vex::FirstContact landing = vex::time_of_impact(floor, can, above, falling);
  const vex::HalfSpaceCertificate proof = vex::certify(floor, can, above, falling, landing);
  const bool is_proven = vex::check_certificate(floor, can, above, falling, landing, proof).is_proven;
  // [end]
  EXPECT_TRUE(is_proven);
  EXPECT_LT(landing.upper - landing.lower, 1e-12);
}

TEST(WorldExamples, Compound) {
  // [compound]
  const vex::Compound dumbbell({{vex::Capsule(2.0, 0.1), vex::Pose()},
                                {vex::Sphere(0.5), vex::Transformd{.translation = {0.0, 0.0, 1.0}}},
                                {vex::Sphere(0.5), vex::Transformd{.translation = {0.0, 0.0, -1.0}}}});
  const vex::ConvexBody ball = vex::Sphere(0.3);
  const vex::Pose beside = vex::Transformd{.translation = {1.0, 0.0, 0.0}};
  const vex::CompoundVerdict verdict = vex::overlap(dumbbell, ball, beside);
  const vex::CompoundSeparation gap = vex::distance(dumbbell, ball, beside);
  const vex::CompoundContact hit = vex::linear_cast(dumbbell, ball, beside, {-1.0, 0.0, 0.0});
  // [end]
  EXPECT_EQ(verdict.verdict.outcome, vex::Outcome::disjoint);
  EXPECT_NEAR(gap.separation.signed_distance, 0.6, 1e-9);
  EXPECT_NEAR(hit.contact.time, 0.6, 1e-9);
}

TEST(WorldExamples, Mesh) {
  const std::vector<std::array<vex::Vec3d, 3>> triangles = {{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}}},
                                                            {{{-9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}}};
  std::vector<vex::Pose> poses = {vex::Transformd{.translation = {0.0, 0.0, 0.4}},
                                  vex::Transformd{.translation = {0.0, 0.0, 0.6}}};
  // [mesh]
  const vex::Compound ground = vex::compound_of_triangles(triangles);  // or vex::read_triangles(path)
  const vex::ConvexBody box = vex::Box(1.0, 1.0, 1.0);
  std::vector<vex::CompoundVerdict> verdicts(poses.size());
  vex::overlap(ground, box, poses, verdicts, 2);  // two threads
  // [end]
  EXPECT_EQ(verdicts[0].verdict.outcome, vex::Outcome::overlap);
  EXPECT_EQ(verdicts[1].verdict.outcome, vex::Outcome::disjoint);
}

TEST(WorldExamples, Scaled) {
  // [scaled]
  const vex::Body flat_can = vex::scaled(vex::Cylinder(1.0, 0.5), {1.0, 2.0, 0.1});
  const vex::Body twin = vex::mirrored(flat_can);
  // [end]
  EXPECT_NEAR(twin.measures.volume, 0.2 * 0.25 * std::acos(-1.0), 1e-15);
}

TEST(WorldGuide, HasOnlyExamplesThatAreCompiledAndAllOfThem) {
  const std::vector<std::string> compiled = vex::test::compiled_examples("tests/docs/world_examples.cpp");
  EXPECT_EQ(compiled.size(), 8u);
  EXPECT_EQ(vex::test::shown_examples("docs/worlds.md"), compiled);
}

}  // namespace
