#include "engine/sampling/virial/triangle_map.h"

#include <algorithm>
#include <cmath>

namespace vex {

TriangleMap::TriangleMap(const ConvexBody& body, const OrientationLaw& law)
    : is_isotropic_(law.kind() == OrientationLaw::Kind::isotropic), body_(radial_body(body)) {
  const double unit = body.circumradius();
  root_ = {std::sqrt(body_.q.xx) / unit, std::sqrt(body_.q.yy) / unit, std::sqrt(body_.q.zz) / unit};
}

double TriangleMap::longest_by_shortest() const {
  return std::max({root_.x, root_.y, root_.z}) / std::min({root_.x, root_.y, root_.z});
}

}  // namespace vex
