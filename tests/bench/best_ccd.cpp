#include <ccd/ccd.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "meshes/exact_hull.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "tests/bench/best_peers.h"

namespace vex {
namespace {

// Structures and support mappings as a user of libccd writes them. A's frame is the world's, so that A is not placed,
// and B's turn is a matrix: fewer operations than the quaternions of libccd's examples take.

struct PlainBox {
  explicit PlainBox(const Box& box) { ccdVec3Set(&half, box.edges().x / 2, box.edges().y / 2, box.edges().z / 2); }
  void support(const ccd_vec3_t& dir, ccd_vec3_t* point) const {
    ccdVec3Set(point, std::copysign(half.v[0], dir.v[0]), std::copysign(half.v[1], dir.v[1]),
               std::copysign(half.v[2], dir.v[2]));
  }
  ccd_vec3_t half;
};

struct PlainEllipsoid {
  explicit PlainEllipsoid(const Ellipsoid& ellipsoid) {
    const Vec3d a = ellipsoid.semi_axes();
    ccdVec3Set(&axes_sq, a.x * a.x, a.y * a.y, a.z * a.z);
  }
  void support(const ccd_vec3_t& dir, ccd_vec3_t* point) const {
    const ccd_real_t x = axes_sq.v[0] * dir.v[0], y = axes_sq.v[1] * dir.v[1], z = axes_sq.v[2] * dir.v[2];
    const ccd_real_t length_sq = x * dir.v[0] + y * dir.v[1] + z * dir.v[2];
    const ccd_real_t scale = length_sq > 0 ? 1 / std::sqrt(length_sq) : 0;
    ccdVec3Set(point, scale * x, scale * y, scale * z);
  }
  ccd_vec3_t axes_sq;
};

struct PlainCapsule {
  explicit PlainCapsule(const Capsule& capsule) : half_length(capsule.body().length() / 2), radius(capsule.radius()) {}
  void support(const ccd_vec3_t& dir, ccd_vec3_t* point) const {
    const ccd_real_t length_sq = ccdVec3Len2(&dir);
    const ccd_real_t scale = length_sq > 0 ? radius / std::sqrt(length_sq) : 0;
    ccdVec3Set(point, scale * dir.v[0], scale * dir.v[1], scale * dir.v[2] + std::copysign(half_length, dir.v[2]));
  }
  ccd_real_t half_length, radius;
};

struct ScannedHull {
  explicit ScannedHull(const Polytope& polytope) {
    for (const Vec3d& p : polytope.vertices()) {
      vertices.emplace_back();
      ccdVec3Set(&vertices.back(), p.x, p.y, p.z);
    }
  }
  void support(const ccd_vec3_t& dir, ccd_vec3_t* point) const {
    ccd_real_t most = -HUGE_VAL;
    const ccd_vec3_t* best = vertices.data();
    for (const ccd_vec3_t& vertex : vertices) {
      const ccd_real_t value = ccdVec3Dot(&vertex, &dir);
      if (value > most) most = value, best = &vertex;
    }
    *point = *best;
  }
  std::vector<ccd_vec3_t> vertices;
};

// Uphill along the edges, from the vertex that answered the last direction of the same octant.
struct ClimbedHull {
  explicit ClimbedHull(const Polytope& polytope) : scanned(polytope), first(scanned.vertices.size() + 1) {
    const std::vector<Vec3d> points = polytope.vertices();
    const std::optional<Triangles> hull = exact_hull(points);
    if (!hull) return;  // flat: there is no uphill, and the scan answers
    for (const auto& corners : hull->corners) ++first[corners[0] + 1], ++first[corners[1] + 1], ++first[corners[2] + 1];
    for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
    neighbours.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& corners : hull->corners) {
      for (std::size_t k = 0; k < 3; ++k) neighbours[next[corners[k]]++] = corners[(k + 1) % 3];
    }
    last.fill(hull->corners[0][0]);
  }
  void support(const ccd_vec3_t& dir, ccd_vec3_t* point) const {
    if (neighbours.empty()) return scanned.support(dir, point);
    std::uint32_t& start = last[(dir.v[0] < 0 ? 1u : 0u) + (dir.v[1] < 0 ? 2u : 0u) + (dir.v[2] < 0 ? 4u : 0u)];
    std::uint32_t best = start;
    ccd_real_t most = ccdVec3Dot(&scanned.vertices[best], &dir);
    for (bool climbs = true; climbs;) {
      climbs = false;
      const std::uint32_t here = best;
      for (std::uint32_t k = first[here]; k < first[here + 1]; ++k) {
        const ccd_real_t value = ccdVec3Dot(&scanned.vertices[neighbours[k]], &dir);
        if (value > most) most = value, best = neighbours[k], climbs = true;
      }
    }
    start = best;
    *point = scanned.vertices[best];
  }
  ScannedHull scanned;
  std::vector<std::uint32_t> first, neighbours;
  mutable std::array<std::uint32_t, 8> last{};  // by octant
};

template <class Shape>
struct Placed {
  Shape shape;
  Vec3d centre;
  Transformd a_from_b;  // of B
};

template <class Shape>
const Placed<Shape>& placed(const void* object) {
  return *static_cast<const Placed<Shape>*>(object);
}

void set(ccd_vec3_t* to, const Vec3d& from) { ccdVec3Set(to, from.x, from.y, from.z); }

template <class Shape>
void support_a(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* point) {
  placed<Shape>(object).shape.support(*dir, point);
}
template <class Shape>
void support_b(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* point) {
  const Placed<Shape>& b = placed<Shape>(object);
  ccd_vec3_t local;
  set(&local, b.a_from_b.direction_to_b({dir->v[0], dir->v[1], dir->v[2]}));
  b.shape.support(local, point);
  set(point, b.a_from_b({point->v[0], point->v[1], point->v[2]}));
}
template <class Shape>
void centre_a(const void* object, ccd_vec3_t* point) {
  set(point, placed<Shape>(object).centre);
}
template <class Shape>
void centre_b(const void* object, ccd_vec3_t* point) {
  set(point, placed<Shape>(object).a_from_b(placed<Shape>(object).centre));
}

// GJK's first direction: libccd's own is x, whatever the poses.
template <class Shape>
void between_centres(const void* a, const void* b, ccd_vec3_t* dir) {
  ccd_vec3_t from, to;
  centre_a<Shape>(a, &from);
  centre_b<Shape>(b, &to);
  ccdVec3Sub2(dir, &to, &from);
}

using Query = int (*)(const void*, const void*, const ccd_t*);

template <class Shape>
class PlainBackend final : public OverlapBackend {
 public:
  template <class Body>
  PlainBackend(const Body& a, const Body& b, Query query)
      : query_(query), a_{Shape(a), a.centre(), {}}, b_{Shape(b), b.centre(), {}} {
    CCD_INIT(&ccd_);  // and so portal refinement's tolerance of 1e-4
    ccd_.first_dir = between_centres<Shape>;
    ccd_.support1 = support_a<Shape>;
    ccd_.support2 = support_b<Shape>;
    ccd_.center1 = centre_a<Shape>;
    ccd_.center2 = centre_b<Shape>;
    ccd_.max_iterations = 100;  // as in its documentation; without it its GJK need not end
  }
  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < a_from_b.size(); ++k) {
      b_.a_from_b = a_from_b[k].a_from_b();
      verdicts[k] =
          query_(&a_, &b_, &ccd_) != 0 ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
    }
  }

 private:
  Query query_;
  ccd_t ccd_;
  Placed<Shape> a_, b_;
};

template <class Body, class Shape>
std::unique_ptr<OverlapBackend> try_make(const ConvexBody& a, const ConvexBody& b, Query query) {
  const auto *const body_a = a.target<Body>(), *const body_b = b.target<Body>();
  if (body_a == nullptr || body_b == nullptr) return nullptr;
  return std::make_unique<PlainBackend<Shape>>(*body_a, *body_b, query);
}

template <class Hull>
std::unique_ptr<OverlapBackend> make(const ConvexBody& a, const ConvexBody& b, Query query) {
  std::unique_ptr<OverlapBackend> backend = try_make<Box, PlainBox>(a, b, query);
  if (!backend) backend = try_make<Ellipsoid, PlainEllipsoid>(a, b, query);
  if (!backend) backend = try_make<Capsule, PlainCapsule>(a, b, query);
  if (!backend) backend = try_make<Polytope, Hull>(a, b, query);
  return backend;
}

template <class Body>
bool both_are(const ConvexBody& a, const ConvexBody& b) {
  return a.target<Body>() != nullptr && b.target<Body>() != nullptr;
}

bool are_hulls(const ConvexBody& a, const ConvexBody& b) { return both_are<Polytope>(a, b); }

bool are_plain(const ConvexBody& a, const ConvexBody& b) {
  return both_are<Box>(a, b) || both_are<Ellipsoid>(a, b) || both_are<Capsule>(a, b) || are_hulls(a, b);
}

template <class Hull>
BackendKind kind(const char* name, Query query, bool (*takes_pair)(const ConvexBody&, const ConvexBody&)) {
  return {name, true, [query](const ConvexBody& a, const ConvexBody& b) { return make<Hull>(a, b, query); },
          takes_pair};
}

}  // namespace

std::vector<BestPeer> best_ccd_peers() {
  const std::string plain = "plain C support functions on the shape's own sizes, B placed by a matrix";
  return {{kind<ScannedHull>("ccd-gjk-plain", ccdGJKIntersect, are_plain),
           "libccd ccdGJKIntersect, max_iterations 100, first_dir between the centres; " + plain + ", hulls scanned"},
          {kind<ScannedHull>("ccd-mpr-plain", ccdMPRIntersect, are_plain),
           "libccd ccdMPRIntersect, mpr_tolerance 1e-4, its default; " + plain + ", hulls scanned"},
          {kind<ClimbedHull>("ccd-gjk-climbing", ccdGJKIntersect, are_hulls),
           "the same GJK, hulls climbed along their edges from the vertex that answered the octant's last direction"},
          {kind<ClimbedHull>("ccd-mpr-climbing", ccdMPRIntersect, are_hulls),
           "the same portal refinement, hulls climbed along their edges from the vertex that answered the octant's "
           "last direction"}};
}

BestPeer ccd_scan_mpr() { return best_ccd_peers()[1]; }

}  // namespace vex
