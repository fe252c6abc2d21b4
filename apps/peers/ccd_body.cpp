#include "apps/peers/ccd_body.h"

namespace vex {
namespace {

// Left alone, libccd's GJK never ends on about one of 10^6 random pairs of cubes, and its portal refinement, which
// takes no cap at all, where its tolerance is below the bodies' rounding. After this many support calls each body
// answers with a point behind the origin, which every loop of libccd takes for a separating direction; the query then
// counts as given up.
constexpr unsigned long kMaxSupportCalls = 2000;

Vec3d from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }

void support(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* point) {
  auto& placed = *static_cast<CcdBody*>(const_cast<void*>(object));
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
  const auto& placed = *static_cast<const CcdBody*>(object);
  const Vec3d c = placed.a_from_b == nullptr ? placed.body->centre() : (*placed.a_from_b)(placed.body->centre());
  ccdVec3Set(point, c.x, c.y, c.z);
}

}  // namespace

bool CcdBody::has_given_up() const { return n_support_calls > kMaxSupportCalls; }

ccd_t ccd_of_bodies() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.center1 = centre;
  ccd.center2 = centre;
  return ccd;
}

}  // namespace vex
