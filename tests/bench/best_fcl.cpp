#include <fcl/fcl.h>

#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "apps/peers/fcl_geometry.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "meshes/exact_hull.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "tests/bench/best_peers.h"

namespace vex {
namespace {

std::shared_ptr<const fcl::Boxd> fcl_shape(const Box& box) {
  return std::make_shared<fcl::Boxd>(box.edges().x, box.edges().y, box.edges().z);
}
std::shared_ptr<const fcl::Ellipsoidd> fcl_shape(const Ellipsoid& ellipsoid) {
  const Vec3d a = ellipsoid.semi_axes();
  return std::make_shared<fcl::Ellipsoidd>(a.x, a.y, a.z);
}
std::shared_ptr<const fcl::Capsuled> fcl_shape(const Capsule& capsule) {
  return std::make_shared<fcl::Capsuled>(capsule.radius(), capsule.body().length());
}
// Valid, or it throws: only then does FCL climb along edges, which it does from 33 vertices on.
std::shared_ptr<const fcl::Convexd> fcl_shape(const Polytope& polytope) {
  const std::vector<Vec3d> points = polytope.vertices();
  const std::optional<Triangles> hull = exact_hull(points);
  if (!hull) throw InputError("FCL's Convex needs facets, and these vertices have none - they span no volume");
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3d& p : points) vertices->emplace_back(p.x, p.y, p.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& corners : hull->corners) {
    faces->push_back(3);
    for (const std::uint32_t corner : corners) faces->push_back(static_cast<int>(corner));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull->size()), faces, true);
}

// `collide`, as its documentation shows it.
template <class Shape>
class ByCollide {
 public:
  explicit ByCollide(fcl::GJKSolverType solver) : request_(1, false) {
    request_.gjk_solver_type = solver;
    request_.enable_cached_gjk_guess = solver == fcl::GST_INDEP;  // libccd's solver has no use for it
  }
  bool operator()(const Shape& a, const fcl::Transform3d& pose_a, const Shape& b, const fcl::Transform3d& pose_b) {
    result_.clear();
    fcl::collide(&a, pose_a, &b, pose_b, request_, result_);
    if (request_.enable_cached_gjk_guess) request_.cached_gjk_guess = result_.cached_gjk_guess;
    return result_.isCollision();
  }

 private:
  fcl::CollisionRequestd request_;
  fcl::CollisionResultd result_;
};

// What `collide` comes down to, without the way there.
template <class Shape>
class BySolver {
 public:
  bool operator()(const Shape& a, const fcl::Transform3d& pose_a, const Shape& b, const fcl::Transform3d& pose_b) {
    return solver_.shapeIntersect(a, pose_a, b, pose_b, nullptr);
  }

 private:
  fcl::detail::GJKSolver_libccd<double> solver_;
};

// Of two capsules FCL has the distance in closed form, but not the collision.
class ByCapsuleDistance {
 public:
  bool operator()(const fcl::Capsuled& a, const fcl::Transform3d& pose_a, const fcl::Capsuled& b,
                  const fcl::Transform3d& pose_b) {
    double distance = 0.0;
    fcl::Vector3d on_a, on_b;
    solver_.shapeDistance(a, pose_a, b, pose_b, &distance, &on_a, &on_b);
    return distance <= 0.0;
  }

 private:
  fcl::detail::GJKSolver_libccd<double> solver_;
};

template <class Shape, class Test>
class FclBackend final : public PreparedBackend {
 public:
  using Geometry = std::shared_ptr<const Shape>;
  FclBackend(Geometry a, Geometry b, Test test) : a_(std::move(a)), b_(std::move(b)), test_(std::move(test)) {}

  void prepare(std::span<const Pose> a_from_b) override {
    first_ = a_from_b.data();
    poses_.clear();
    for (const Pose& pose : a_from_b) poses_.push_back(fcl_pose(pose.a_from_b()));
  }
  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    const auto begin = static_cast<std::size_t>(a_from_b.data() - first_);
    VEX_EXPECT(begin + a_from_b.size() <= poses_.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = decide(poses_[begin + k]);
  }

 private:
  Verdict decide(const fcl::Transform3d& pose) {
    try {
      return test_(*a_, pose_a_, *b_, pose) ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
    } catch (const std::exception&) {  // where its solver finds itself in an impossible state
      return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
    }
  }

  Geometry a_, b_;
  Test test_;
  fcl::Transform3d pose_a_ = fcl::Transform3d::Identity();
  const Pose* first_ = nullptr;
  std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>> poses_;
};

template <class Shape, class Test>
std::unique_ptr<OverlapBackend> backend_of(std::shared_ptr<const Shape> a, std::shared_ptr<const Shape> b, Test test) {
  return std::make_unique<FclBackend<Shape, Test>>(std::move(a), std::move(b), std::move(test));
}

// Calls `make` with the two bodies in FCL's form; null where they are not both a `Body`.
template <class Body, class Make>
std::unique_ptr<OverlapBackend> try_make(const ConvexBody& a, const ConvexBody& b, const Make& make) {
  const auto *const body_a = a.target<Body>(), *const body_b = b.target<Body>();
  if (body_a == nullptr || body_b == nullptr) return nullptr;
  const auto shape_a = fcl_shape(*body_a);
  return make(shape_a, body_a == body_b ? shape_a : fcl_shape(*body_b));
}

template <class Make>
std::unique_ptr<OverlapBackend> make_for(const ConvexBody& a, const ConvexBody& b, const Make& make) {
  std::unique_ptr<OverlapBackend> backend = try_make<Box>(a, b, make);
  if (!backend) backend = try_make<Ellipsoid>(a, b, make);
  if (!backend) backend = try_make<Capsule>(a, b, make);
  if (!backend) backend = try_make<Polytope>(a, b, make);
  return backend;
}

template <class Body>
bool both_are(const ConvexBody& a, const ConvexBody& b) {
  return a.target<Body>() != nullptr && b.target<Body>() != nullptr;
}

bool are_known(const ConvexBody& a, const ConvexBody& b) {
  return both_are<Box>(a, b) || both_are<Ellipsoid>(a, b) || both_are<Capsule>(a, b) || both_are<Polytope>(a, b);
}

BackendKind by_collide(const char* name, fcl::GJKSolverType solver) {
  return {name, true,
          [solver](const ConvexBody& a, const ConvexBody& b) {
            return make_for(a, b,
                            [solver]<class Shape>(std::shared_ptr<const Shape> x, std::shared_ptr<const Shape> y) {
                              return backend_of(std::move(x), std::move(y), ByCollide<Shape>(solver));
                            });
          },
          are_known};
}

BackendKind by_solver() {
  return {"fcl-solver", true,
          [](const ConvexBody& a, const ConvexBody& b) {
            return make_for(a, b, []<class Shape>(std::shared_ptr<const Shape> x, std::shared_ptr<const Shape> y) {
              return backend_of(std::move(x), std::move(y), BySolver<Shape>());
            });
          },
          are_known};
}

BackendKind by_capsule_distance() {
  return {"fcl-capsules", true,
          [](const ConvexBody& a, const ConvexBody& b) {
            return try_make<Capsule>(
                a, b, [](auto x, auto y) { return backend_of(std::move(x), std::move(y), ByCapsuleDistance()); });
          },
          both_are<Capsule>};
}

}  // namespace

std::vector<BestPeer> best_fcl_peers() {
  const std::string made_before = "transforms made before, no contacts; Convex valid, so that it climbs along edges";
  return {
      {by_collide("fcl-libccd", fcl::GST_LIBCCD),
       "FCL collide, solver GST_LIBCCD, its default (boxes: separating axes); " + made_before},
      {by_collide("fcl-indep-guess", fcl::GST_INDEP),
       "FCL collide, solver GST_INDEP, enable_cached_gjk_guess from query to query; " + made_before},
      {by_solver(), "FCL shapeIntersect of the default solver, which `collide` comes down to, called directly"},
      {by_capsule_distance(), "FCL shapeDistance of two capsules, a closed form; they meet where it is not positive"}};
}

std::string fcl_version() { return FCL_VERSION; }

}  // namespace vex
