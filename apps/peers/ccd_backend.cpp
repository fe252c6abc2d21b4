#include "apps/peers/ccd_backend.h"

#include <ccd/ccd.h>

#include "engine/numeric/expect.h"

namespace vex {
namespace {

// Left alone, libccd's GJK never ends on about one of 10^6 random pairs of cubes, and its portal refinement, which
// takes no cap at all, where its tolerance is below the bodies' rounding. After this many support calls each body
// answers with a point behind the origin, which every loop of libccd takes for a separating direction; the query then
// counts as given up.
constexpr unsigned long kMaxSupportCalls = 2000;

struct PlacedBody {
  const ConvexBody* body = nullptr;
  const Transformd* a_from_b = nullptr;  // none for A, which stays in its own frame
  unsigned long n_support_calls = 0;
};

Vec3d from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }

void support(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* point) {
  // libccd passes the object on as constant; the counter is ours.
  auto& placed = *static_cast<PlacedBody*>(const_cast<void*>(object));
  const Vec3d d = from_ccd(*dir);
  if (++placed.n_support_calls > kMaxSupportCalls) {
    ccdVec3Set(point, -d.x, -d.y, -d.z);
    return;
  }
  const Vec3d p = placed.a_from_b == nullptr
                      ? placed.body->support(d)
                      : (*placed.a_from_b)(placed.body->support(placed.a_from_b->direction_to_b(d)));
  ccdVec3Set(point, p.x, p.y, p.z);
}

void centre(const void* object, ccd_vec3_t* point) {
  const auto& placed = *static_cast<const PlacedBody*>(object);
  const Vec3d c = placed.a_from_b == nullptr ? placed.body->centre() : (*placed.a_from_b)(placed.body->centre());
  ccdVec3Set(point, c.x, c.y, c.z);
}

class CcdBackend final : public OverlapBackend {
 public:
  using Query = int (*)(const void*, const void*, const ccd_t*);

  CcdBackend(const ConvexBody& a, const ConvexBody& b, Query query) : query_(query) {
    CCD_INIT(&ccd_);
    ccd_.support1 = support;
    ccd_.support2 = support;
    ccd_.center1 = centre;
    ccd_.center2 = centre;
    ccd_.mpr_tolerance = 1e-12;
    a_.body = &a;
    b_.body = &b;
  }

  void decide(std::span<const Transformd> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) {
      a_.n_support_calls = 0;
      b_.n_support_calls = 0;
      b_.a_from_b = &a_from_b[k];
      const int meets = query_(&a_, &b_, &ccd_);
      if (a_.n_support_calls > kMaxSupportCalls || b_.n_support_calls > kMaxSupportCalls) {
        verdicts[k] = Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
      } else {
        verdicts[k] = meets != 0 ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
      }
    }
  }

 private:
  Query query_;
  ccd_t ccd_;
  PlacedBody a_, b_;
};

BackendKind kind(const char* name, CcdBackend::Query query) {
  return {name,
          true,
          [query](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<CcdBackend>(a, b, query); },
          {}};
}

}  // namespace

BackendKind ccd_gjk_backend() { return kind("ccd-gjk", ccdGJKIntersect); }
BackendKind ccd_mpr_backend() { return kind("ccd-mpr", ccdMPRIntersect); }

}  // namespace vex
