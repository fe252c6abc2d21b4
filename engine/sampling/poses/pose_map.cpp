#include "engine/sampling/poses/pose_map.h"

#include <algorithm>
#include <utility>

namespace vex {

PoseSampler::PoseSampler(const ConvexBody& a, const ConvexBody& b, TrialPoints points, const OrientationLaw& law,
                         const Domain& domain)
    : points_(std::move(points)), law_(law), domain_(domain), centre_b_(b.centre()) {
  if (domain.kind == Domain::Kind::fitted) fitted_.emplace(a, b);
}

PosedTrial PoseSampler::operator()(std::uint64_t index) const {
  std::array<double, kPoseDimension> point;
  const auto n_used = static_cast<std::size_t>(3 + law_.dimension());
  points_.one(index, std::span(point).first(n_used));
  const Transformd rotation = law_.rotation(std::span<const double>(point).subspan(3));
  if (!fitted_) {
    const Vec3d position = position_in(domain_, point[0], point[1], point[2]);
    return {placed(rotation, position, centre_b_), position, 1.0};
  }
  PosedTrial trial{rotation, {}, 1.0};
  const Parallelepiped set = fitted_->at(rotation);
  trial.a_from_b.translation = set.position(point[0], point[1], point[2]);
  trial.position = trial.a_from_b(centre_b_);
  trial.domain_share = set.volume / domain_.volume;
  return trial;
}

}  // namespace vex
