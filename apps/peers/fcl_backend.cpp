#include "apps/peers/fcl_backend.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
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

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

Geometry convex_of(const Polytope& polytope) {
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
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull->size()), faces);
}

// What FCL has a primitive for; null for anything else. Its frames are the same: axes along z, origin at mid-height,
// the cone's base below.
Geometry primitive_of(const ConvexBody& body) {
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

bool takes(const ConvexBody& body) { return body.target<Polytope>() != nullptr || primitive_of(body) != nullptr; }

// The facets of a large hull take seconds to find: once for all threads that ask. Holds the bodies, so that a
// polytope's address stays its own.
class Geometries {
 public:
  Geometry of(const ConvexBody& body) {
    const auto* const polytope = body.target<Polytope>();
    if (polytope == nullptr) return primitive_of(body);
    const std::lock_guard lock(mutex_);
    for (const auto& [known, geometry] : known_) {
      if (known.target<Polytope>() == polytope) return geometry;
    }
    known_.emplace_back(body, convex_of(*polytope));
    return known_.back().second;
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<ConvexBody, Geometry>> known_;
};

class FclBackend final : public OverlapBackend {
 public:
  FclBackend(Geometry a, Geometry b) : a_(std::move(a)), b_(std::move(b)) {
    VEX_EXPECT(a_ != nullptr && b_ != nullptr);
  }

  void decide(std::span<const Transformd> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = decide(a_from_b[k]);
  }

 private:
  Verdict decide(const Transformd& a_from_b) const {
    const fcl::CollisionRequestd yes_or_no(1, false);  // one contact ends it, and its details are not asked for
    fcl::CollisionResultd result;
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() << a_from_b.row_x.x, a_from_b.row_x.y, a_from_b.row_x.z,  //
        a_from_b.row_y.x, a_from_b.row_y.y, a_from_b.row_y.z,               //
        a_from_b.row_z.x, a_from_b.row_z.y, a_from_b.row_z.z;
    pose.translation() << a_from_b.translation.x, a_from_b.translation.y, a_from_b.translation.z;
    try {
      fcl::collide(a_.get(), fcl::Transform3d::Identity(), b_.get(), pose, yes_or_no, result);
    } catch (const std::exception&) {  // FCL throws where its solver finds itself in an impossible state
      return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
    }
    return result.isCollision() ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
  }

  Geometry a_, b_;
};

}  // namespace

BackendKind fcl_backend() {
  const auto geometries = std::make_shared<Geometries>();
  return {"fcl", true,
          [geometries](const ConvexBody& a, const ConvexBody& b) {
            return std::make_unique<FclBackend>(geometries->of(a), geometries->of(b));
          },
          [](const ConvexBody& a, const ConvexBody& b) { return takes(a) && takes(b); }};
}

}  // namespace vex
