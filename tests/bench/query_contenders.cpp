#include "tests/bench/query_contenders.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/numeric/quaternion.h"
#include "tests/bench/bench_pairs.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr std::size_t kStepsOfAWalk = 32;
constexpr double kStep = 1e-3;

Outcome wanted(SeparationGoal goal) { return goal == SeparationGoal::distance ? Outcome::disjoint : Outcome::overlap; }

Separation ask(SeparationGoal goal, const ConvexBody& body, const Pose& pose, const SeparationSettings& settings = {},
               WarmStart* warm_start = nullptr) {
  return goal == SeparationGoal::distance ? distance(body, body, pose, settings, warm_start)
                                          : penetration_depth(body, body, pose, settings, warm_start);
}

double value_of(const Separation& answer) {
  return answer.has_witnesses ? answer.signed_distance : std::numeric_limits<double>::quiet_NaN();
}

SeparationContender engine(const char* name, const char* setting, double relative_gap) {
  return {name, setting, false, [relative_gap](const SeparationPoses& poses) -> SeparationAnswer {
            SeparationSettings settings;
            settings.relative_gap = relative_gap;
            return [&poses, settings](std::size_t k) {
              return value_of(ask(poses.goal, poses.body, poses.poses[k], settings));
            };
          }};
}

SeparationContender engine_in_motion(const char* name, const char* setting, bool is_warm) {
  return {name, setting, true, [is_warm](const SeparationPoses& poses) -> SeparationAnswer {
            const auto warm_start = std::make_shared<WarmStart>();
            return [&poses, is_warm, warm_start](std::size_t k) {
              return value_of(ask(poses.goal, poses.body, poses.poses[k], {}, is_warm ? warm_start.get() : nullptr));
            };
          }};
}

// Rows of the product of two rotations.
Transformd turned(const Transformd& by, const Transformd& pose) {
  Transformd result = pose;
  const auto row = [&pose](const Vec3d& r) { return pose.direction_to_b(r); };
  result.row_x = row(by.row_x);
  result.row_y = row(by.row_y);
  result.row_z = row(by.row_z);
  return result;
}

Transformd small_turn(std::mt19937_64& random) {
  const Vec3d dir = random_direction(random);
  const double half_angle_rad = kStep * std::numbers::pi;
  const Vec3d axis = (std::sin(half_angle_rad) / norm(dir)) * dir;
  return rotation_from_quaternion(std::cos(half_angle_rad), axis.x, axis.y, axis.z);
}

}  // namespace

std::vector<SeparationContender> engine_separations() {
  return {engine(kEngine, "full precision", 0.0), engine("vex 1e-3", "relative_gap 1e-3", 1e-3),
          engine("vex 0.1", "relative_gap 0.1", 0.1),
          engine_in_motion(kEngineInMotion, "full precision, each pose from scratch", false),
          engine_in_motion("vex warm", "full precision, a warm start from pose to pose", true)};
}

std::vector<SeparationContender> separation_contenders() {
  std::vector<SeparationContender> all = engine_separations();
#ifdef VEX_WITH_CCD
  for (SeparationContender& one : ccd_separations()) all.push_back(std::move(one));
#endif
#ifdef VEX_WITH_FCL
  for (SeparationContender& one : fcl_separations()) all.push_back(std::move(one));
#endif
  return all;
}

SeparationPoses independent_poses(SeparationGoal goal, const ConvexBody& body, std::uint64_t seed, std::size_t n) {
  SeparationPoses poses{goal, body, {}, {}};
  for (std::size_t n_drawn = 4 * n; poses.poses.size() < n; n_drawn *= 2) {
    poses.poses.clear();
    for (const Pose& pose : stored_poses(body, seed, n_drawn)) {
      if (overlap(body, body, pose).outcome == wanted(goal)) poses.poses.push_back(pose);
      if (poses.poses.size() == n) break;
    }
  }
  for (const Pose& pose : poses.poses) poses.proven.push_back(ask(goal, body, pose));
  return poses;
}

SeparationPoses poses_in_motion(SeparationGoal goal, const ConvexBody& body, std::uint64_t seed, std::size_t n) {
  SeparationPoses poses{goal, body, {}, {}};
  const SeparationPoses starts = independent_poses(goal, body, seed, n);
  std::mt19937_64 random(seed);
  for (const Pose& start : starts.poses) {
    const Vec3d dir = random_direction(random);
    const Vec3d step = (kStep * poses.size() / norm(dir)) * dir;
    const Transformd turn = small_turn(random);
    Transformd pose = start.a_from_b();
    for (std::size_t k = 0; k < kStepsOfAWalk; ++k) {
      if (overlap(body, body, pose).outcome != wanted(goal)) break;  // the walk has come to contact
      poses.poses.push_back(Pose::unchecked(pose));
      poses.proven.push_back(ask(goal, body, pose));
      if (poses.poses.size() == n) return poses;
      pose = turned(turn, pose);
      pose.translation = pose.translation + step;
    }
  }
  return poses;
}

}  // namespace vex
