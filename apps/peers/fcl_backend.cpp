#include "apps/peers/fcl_backend.h"

#include <fcl/narrowphase/collision.h>

#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "apps/peers/fcl_geometry.h"
#include "engine/numeric/expect.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

// The facets of a large hull take seconds to find: once for all threads that ask. Holds the bodies, so that a
// polytope's address stays its own.
class Geometries {
 public:
  FclGeometry of(const ConvexBody& body) {
    const auto* const polytope = body.target<Polytope>();
    if (polytope == nullptr) return fcl_geometry(body);
    const std::lock_guard lock(mutex_);
    for (const auto& [known, geometry] : known_) {
      if (known.target<Polytope>() == polytope) return geometry;
    }
    known_.emplace_back(body, fcl_geometry(body));
    return known_.back().second;
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<ConvexBody, FclGeometry>> known_;
};

class FclBackend final : public OverlapBackend {
 public:
  FclBackend(FclGeometry a, FclGeometry b) : a_(std::move(a)), b_(std::move(b)) {
    VEX_EXPECT(a_ != nullptr && b_ != nullptr);
  }

  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = decide(a_from_b[k].a_from_b());
  }

 private:
  Verdict decide(const Transformd& a_from_b) const {
    const fcl::CollisionRequestd yes_or_no(1, false);  // one contact ends it, and its details are not asked for
    fcl::CollisionResultd result;
    const fcl::Transform3d pose = fcl_pose(a_from_b);
    try {
      fcl::collide(a_.get(), fcl::Transform3d::Identity(), b_.get(), pose, yes_or_no, result);
    } catch (const std::exception&) {  // FCL throws where its solver finds itself in an impossible state
      return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
    }
    return result.isCollision() ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
  }

  FclGeometry a_, b_;
};

}  // namespace

BackendKind fcl_backend() {
  const auto geometries = std::make_shared<Geometries>();
  return {"fcl", true,
          [geometries](const ConvexBody& a, const ConvexBody& b) {
            return std::make_unique<FclBackend>(geometries->of(a), geometries->of(b));
          },
          [](const ConvexBody& a, const ConvexBody& b) { return fcl_takes(a) && fcl_takes(b); }};
}

}  // namespace vex
