#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <memory>

#include "apps/peers/fcl_geometry.h"
#include "tests/bench/compound_cases.h"

namespace vex {
namespace {

struct FclLandscape {
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  FclGeometry body;
  fcl::Transform3d pose_of_mesh = fcl::Transform3d::Identity();
  std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>> poses;
};

}  // namespace

CompoundPeer fcl_compound(const CompoundCase& of) {
  const auto landscape = std::make_shared<FclLandscape>();
  const auto point = [](const Vec3d& v) { return fcl::Vector3d(v.x, v.y, v.z); };
  landscape->mesh->beginModel(static_cast<int>(of.triangles.size()), 3 * static_cast<int>(of.triangles.size()));
  for (const auto& [a, b, c] : of.triangles) landscape->mesh->addTriangle(point(a), point(b), point(c));
  landscape->mesh->endModel();
  landscape->body = fcl_geometry(of.body, true);
  for (const Pose& pose : of.poses) landscape->poses.push_back(fcl_pose(pose.a_from_b()));
  return {[landscape](std::size_t k) {
            const fcl::CollisionRequestd request(1, false);
            fcl::CollisionResultd result;
            fcl::collide(landscape->mesh.get(), landscape->pose_of_mesh, landscape->body.get(), landscape->poses[k],
                         request, result);
            return result.isCollision();
          },
          [landscape](std::size_t k) {
            const fcl::DistanceRequestd request(true);
            fcl::DistanceResultd result;
            return std::max(0.0, fcl::distance(landscape->mesh.get(), landscape->pose_of_mesh, landscape->body.get(),
                                               landscape->poses[k], request, result));
          }};
}

}  // namespace vex
