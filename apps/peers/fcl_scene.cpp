#include "apps/peers/fcl_scene.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <exception>

#include "apps/peers/fcl_geometry.h"
#include "engine/numeric/errors.h"

namespace vex {

struct FclScene::Objects {
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>* out = nullptr;
  std::uint64_t n_asked = 0;

  static std::uint32_t number_of(const fcl::CollisionObjectd* object) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
  }
  // False: go on with the next pair.
  static bool ask(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    Objects& self = *static_cast<Objects*>(data);
    ++self.n_asked;
    const fcl::CollisionRequestd yes_or_no(1, false);
    fcl::CollisionResultd result;
    try {
      fcl::collide(a, b, yes_or_no, result);
    } catch (const std::exception&) {  // where its solver finds itself in an impossible state
      return false;
    }
    if (result.isCollision()) self.out->emplace_back(number_of(a), number_of(b));
    return false;
  }
};

FclScene::FclScene(std::span<const ConvexBody> shapes, std::span<const std::uint32_t> shape_of)
    : objects_(std::make_unique<Objects>()) {
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometries;
  for (const ConvexBody& shape : shapes) {
    const FclGeometry geometry = fcl_geometry(shape, true);
    if (geometry == nullptr) throw InputError("FCL has no such shape - leave it out");
    geometries.push_back(std::const_pointer_cast<fcl::CollisionGeometryd>(geometry));  // FCL takes it so and reads it
  }
  for (std::size_t k = 0; k < shape_of.size(); ++k) {
    objects_->objects.push_back(std::make_unique<fcl::CollisionObjectd>(geometries[shape_of[k]]));
    objects_->objects.back()->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(k)));
  }
}

FclScene::FclScene(FclScene&&) noexcept = default;
FclScene::~FclScene() = default;

std::uint64_t FclScene::n_asked() const { return objects_->n_asked; }

void FclScene::overlapping_pairs(std::span<const Pose> poses,
                                 std::vector<std::pair<std::uint32_t, std::uint32_t>>& out) {
  std::vector<fcl::CollisionObjectd*> all;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    fcl::CollisionObjectd& object = *objects_->objects[k];
    object.setTransform(fcl_pose(poses[k].a_from_b()));
    object.computeAABB();
    all.push_back(&object);
  }
  out.clear();
  objects_->out = &out;
  objects_->n_asked = 0;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects(all);
  manager.setup();
  manager.collide(objects_.get(), &Objects::ask);
}

}  // namespace vex
