#include "engine/sampling/virial/triangle_map.h"

#include <algorithm>
#include <array>

namespace vex {

TriangleMap::TriangleMap(const ConvexBody& body, const OrientationLaw& law)
    : is_isotropic_(law.kind() == OrientationLaw::Kind::isotropic), body_(radial_body(body)) {
  const double unit = body.circumradius() * body.circumradius();
  squares_ = {body_.q.xx / unit, body_.q.yy / unit, body_.q.zz / unit};
}

bool TriangleMap::is_usable() const {
  constexpr double kLongest = 0x1p14;  // of squares
  std::array<double, 3> squares{squares_.x, squares_.y, squares_.z};
  std::ranges::sort(squares);
  return squares[2] < kLongest * squares[is_isotropic_ ? 1 : 0];
}

}  // namespace vex
