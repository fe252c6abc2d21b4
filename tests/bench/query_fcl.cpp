#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>

#include "apps/peers/fcl_geometry.h"
#include "tests/bench/query_contenders.h"

namespace vex {
namespace {

constexpr double kNoAnswer = std::numeric_limits<double>::quiet_NaN();

// A body with itself, its transforms made before.
struct FclPair {
  FclGeometry geometry;
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>> poses;
};

double distance_of(const FclPair& pair, std::size_t k, fcl::GJKSolverType solver) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  fcl::DistanceResultd result;
  const double found =
      fcl::distance(pair.geometry.get(), pair.pose_a, pair.geometry.get(), pair.poses[k], request, result);
  return found > 0.0 ? found : kNoAnswer;
}

double depth_of(const FclPair& pair, std::size_t k, fcl::GJKSolverType solver) {
  fcl::CollisionRequestd request(8, true);  // of boxes it finds as many, elsewhere one
  request.gjk_solver_type = solver;
  fcl::CollisionResultd result;
  fcl::collide(pair.geometry.get(), pair.pose_a, pair.geometry.get(), pair.poses[k], request, result);
  double deepest = result.isCollision() ? 0.0 : kNoAnswer;
  for (std::size_t contact = 0; contact < result.numContacts(); ++contact) {
    deepest = std::max(deepest, result.getContact(contact).penetration_depth);
  }
  return -deepest;
}

SeparationContender by(const char* name, const char* setting, fcl::GJKSolverType solver) {
  return {name, setting, false, [solver](const SeparationPoses& poses) -> SeparationAnswer {
            if (!fcl_takes(poses.body)) return {};
            const auto pair = std::make_shared<FclPair>();
            pair->geometry = fcl_geometry(poses.body, true);
            for (const Pose& pose : poses.poses) pair->poses.push_back(fcl_pose(pose.a_from_b()));
            const auto query = poses.goal == SeparationGoal::distance ? distance_of : depth_of;
            return [pair, query, solver](std::size_t k) {
              try {
                return query(*pair, k, solver);
              } catch (const std::exception&) {  // where its solver finds itself in an impossible state
                return kNoAnswer;
              }
            };
          }};
}

}  // namespace

std::vector<SeparationContender> fcl_separations() {
  return {by("FCL libccd", "distance, or the deepest of the contacts of collide; solver GST_LIBCCD, its default",
             fcl::GST_LIBCCD),
          by("FCL indep", "the same, solver GST_INDEP", fcl::GST_INDEP)};
}

}  // namespace vex
