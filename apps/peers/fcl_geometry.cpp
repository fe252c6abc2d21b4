#include "apps/peers/fcl_geometry.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include <optional>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/exact_hull.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/plate.h"
#include "shapes/polytope.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

FclGeometry convex_of(const Polytope& polytope, bool is_validated) {
  const std::vector<Vec3d> points = polytope.vertices();
  const std::optional<Triangles> hull = exact_hull(points);
  if (!hull) throw InputError("FCL's Convex needs facets, and these vertices have none - they span no volume");
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3d& p : points) vertices->emplace_back(p.x, p.y, p.z);
  auto faces = std::make_shared<std::vector<int>>();  // the number of corners, then the corners, face after face
  for (const auto& corners : hull->corners) {
    faces->push_back(3);
    for (const std::uint32_t corner : corners) faces->push_back(static_cast<int>(corner));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull->size()), faces, is_validated);
}

// What FCL has a primitive for; null for anything else. Its frames are the same: axes along z, origin at mid-height,
// the cone's base below.
FclGeometry primitive_of(const ConvexBody& body) {
  if (const auto* const sphere = body.target<Sphere>()) return std::make_shared<fcl::Sphered>(sphere->circumradius());
  if (const auto* const box = body.target<Box>()) {
    return std::make_shared<fcl::Boxd>(box->edges().x, box->edges().y, box->edges().z);
  }
  if (const auto* const plate = body.target<Plate>()) {
    return std::make_shared<fcl::Boxd>(plate->edge_x(), plate->edge_y(), 0.0);
  }
  if (const auto* const ellipsoid = body.target<Ellipsoid>()) {
    const Vec3d axes = ellipsoid->semi_axes();
    return std::make_shared<fcl::Ellipsoidd>(axes.x, axes.y, axes.z);
  }
  if (const auto* const capsule = body.target<Capsule>()) {
    return std::make_shared<fcl::Capsuled>(capsule->radius(), capsule->body().length());
  }
  if (const auto* const cylinder = body.target<Cylinder>()) {
    return std::make_shared<fcl::Cylinderd>(cylinder->radius(), cylinder->length());
  }
  if (const auto* const cone = body.target<Cone>()) {
    return std::make_shared<fcl::Coned>(cone->lower_radius(), cone->height());
  }
  return nullptr;
}

}  // namespace

bool fcl_takes(const ConvexBody& body) { return body.target<Polytope>() != nullptr || primitive_of(body) != nullptr; }

FclGeometry fcl_geometry(const ConvexBody& body, bool is_validated) {
  const auto* const polytope = body.target<Polytope>();
  return polytope == nullptr ? primitive_of(body) : convex_of(*polytope, is_validated);
}

fcl::Transform3d fcl_pose(const Transformd& a_from_b) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() << a_from_b.row_x.x, a_from_b.row_x.y, a_from_b.row_x.z,  //
      a_from_b.row_y.x, a_from_b.row_y.y, a_from_b.row_y.z,               //
      a_from_b.row_z.x, a_from_b.row_z.y, a_from_b.row_z.z;
  pose.translation() << a_from_b.translation.x, a_from_b.translation.y, a_from_b.translation.z;
  return pose;
}

}  // namespace vex
