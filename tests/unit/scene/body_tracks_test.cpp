#include <gtest/gtest.h>

#include <cmath>

#include "engine/numeric/pose_algebra.h"
#include "engine/numeric/rounding.h"
#include "engine/scene/scene_bodies.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Matrix = std::array<Vec3d, 3>;

Vec3d times(const Matrix& m, const Vec3d& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
Matrix transposed(const Matrix& m) {
  return {Vec3d{m[0].x, m[1].x, m[2].x}, Vec3d{m[0].y, m[1].y, m[2].y}, Vec3d{m[0].z, m[1].z, m[2].z}};
}
Matrix inverse(const Matrix& m) {
  const Vec3d c = cross(m[1], m[2]);
  const double by = 1.0 / dot(m[0], c);
  return transposed({by * c, by * cross(m[2], m[0]), by * cross(m[0], m[1])});
}
Matrix rotation_of(const Transformd& pose) { return {pose.row_x, pose.row_y, pose.row_z}; }

// About a unit axis; each entry is off by up to 2.5e-8.
Transformd turned(const Transformd& pose, double angle, const Vec3d& axis, std::mt19937_64& random) {
  const Vec3d part = std::sin(0.5 * angle) * axis;
  Matrix rows = rotation_of((pose_of({std::cos(0.5 * angle), part.x, part.y, part.z}, {}) * Pose(pose)).a_from_b());
  for (Vec3d& row : rows) row = row + 2.5e-8 * random_direction(random);
  return {rows[0], rows[1], rows[2], {}};
}

// How far the placed body reaches from its centre: of the rows as they are, or of their inverse transposed.
double reach(const ConvexBody& body, const Matrix& to_frame, const Vec3d& dir) {
  const Vec3d d = times(to_frame, dir);
  return dot(d, body.support(d) - body.centre());
}

struct Turned {
  double told, most;  // of the track, and along any of the directions that were looked at
};

Turned turn_of(const ConvexBody& body, double angle, std::mt19937_64& random) {
  SceneBodies bodies(std::nullopt);
  const ShapeId shape = bodies.add_shape(body);
  const Transformd from = turned(random_rotation(random), 0.0, {1, 0, 0}, random);
  const Vec3d dir = random_direction(random);
  const Transformd to = turned(from, angle, (1.0 / norm(dir)) * dir, random);
  bodies.add(shape, Pose(from));
  bodies.track();
  const Pose pose(to);
  bodies.set_poses(0, {&pose, 1});
  std::vector<Vec3d> dirs = {from.row_x, from.row_y, from.row_z};
  for (const Vec3d& column : transposed(rotation_of(from))) dirs.push_back(column);
  for (int k = 0; k < 40; ++k) dirs.push_back(random_direction(random));
  double most = 0.0;
  for (Vec3d& d : dirs) {
    d = (1.0 / norm(d)) * d;
    const Matrix before = rotation_of(from), after = rotation_of(to);
    most = std::fmax(most, std::fabs(reach(body, transposed(after), d) - reach(body, transposed(before), d)));
    most = std::fmax(most, std::fabs(reach(body, inverse(after), d) - reach(body, inverse(before), d)));
  }
  return {bodies.tracked(0).turned, most};
}

constexpr double kAngles[] = {1e-10, 1e-8, 1e-7, 3e-7, 1e-6, 1e-5, 1e-3, 0.03, 0.5, 0.98, 1.04, 1.5, 3.1};

TEST(BodyTracks, NoTurnChangesABodysReachByMore) {
  std::mt19937_64 random(1);
  for (const char* name : every_test_body()) {
    SCOPED_TRACE(name);
    const ConvexBody body = parse_shape(name).body;
    for (const double angle : kAngles) {
      for (int k = 0; k < 8; ++k) {
        const Turned found = turn_of(body, angle, random);
        ASSERT_LE(found.most, found.told + 2.0 * body.support_error() + 64.0 * kUnitRoundoff * body.reach()) << angle;
      }
    }
  }
}

// A cube's face turns by half its diagonal, a ball not at all but by what its widened radius leaves open.
TEST(BodyTracks, TurnsCountByHowFarABodyIsFromRound) {
  std::mt19937_64 random(2);
  const ConvexBody cube = parse_shape("box:1,1,1").body, ball = parse_shape("sphere:0.5").body;
  double best = 0.0;
  for (int k = 0; k < 200; ++k) {
    const Turned found = turn_of(cube, 0.01, random);
    best = std::fmax(best, found.most / found.told);
    EXPECT_LT(found.told, 0.01 * 0.7075);
    EXPECT_LT(turn_of(ball, 0.01, random).told, 0.01 * 0.5 * 0.004);
  }
  EXPECT_GT(best, 0.95);
  EXPECT_LE(best, 1.0);
}

TEST(BodyTracks, DisplacementsAreOfCentresWhicheverWayTheyWent) {
  std::mt19937_64 random(3);
  for (const bool is_in_a_box : {false, true}) {
    SceneBodies bodies(is_in_a_box ? std::optional(PeriodicBox(4.0, 5.0, 6.0, 0.5, 0.2, -0.3)) : std::nullopt);
    const ShapeId shape = bodies.add_shape(parse_shape("box:1,1,1").body);
    Transformd pose;
    pose.translation = {1.9, 0.0, 0.0};
    bodies.add(shape, Pose(pose));
    bodies.track();
    double way = 0.0;
    for (int k = 0; k < 100; ++k) {
      const Vec3d before = pose.translation;
      pose.translation = Vec3d{1.9, 0.0, 0.0} + 0.3 * random_direction(random);
      way += norm(pose.translation - before);
      const Pose to(pose);
      bodies.set_poses(0, {&to, 1});
      EXPECT_NEAR(bodies.largest_displacement(false), norm(pose.translation - Vec3d{1.9, 0.0, 0.0}), 1e-14);
      EXPECT_NEAR(bodies.largest_step(), norm(pose.translation - before), 1e-4);
    }
    EXPECT_NEAR(bodies.travel(0), way, 1e-3);
    EXPECT_EQ(bodies.tracked(0).turned, 0.0);
    bodies.set_poses(0, std::vector{Pose(turned(pose, 0.1, {0, 0, 1}, random))});
    EXPECT_EQ(bodies.largest_displacement(true), bodies.largest_displacement(false) + bodies.tracked(0).turned);
  }
}

}  // namespace
}  // namespace vex
