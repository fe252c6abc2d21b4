#include "engine/sampling/radial/radial_estimator.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/expect.h"
#include "engine/sampling/radial/radial_function.h"

namespace vex {

RadialEstimator::RadialEstimator(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                                 InstructionSet set)
    : a_(a),
      b_(b),
      map_(a, b, law),
      make_rays_(ray_maker(set)),
      packets_(make_packet_rays(ray_kernel(set), a, b, map_.points())) {}

double RadialEstimator::scale() const {
  const double reach = a_.circumradius() + b_.circumradius();
  return 64.0 * (reach * reach * reach);
}

Doubts RadialEstimator::evaluate(std::span<const double> points, std::span<double> values) {
  Doubts doubts;
  const auto dimension = static_cast<std::size_t>(map_.dimension());
  VEX_EXPECT(points.size() == dimension * values.size());
  for (std::size_t first = 0; first < values.size(); first += PacketRays::kMostRays) {
    const std::size_t n = std::min(PacketRays::kMostRays, values.size() - first);
    for (std::size_t c = 0; c < dimension; ++c) {
      std::ranges::copy(points.subspan(c * values.size() + first, n), columns_.coordinates[c]);
    }
    make_rays_(map_, n, columns_);
    const RayTable rays = columns_.table(n);
    if (packets_ != nullptr) {
      packets_->find(rays, answers_);
    } else {
      answers_.open_all(n);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const double weight = columns_.weights[k];
      double cube = answers_.cube[k];
      if (std::isnan(cube)) {
        ++n_one_by_one_;
        const RadialBounds bounds =
            radial_function(a_, b_, map_.points(), Pose::unchecked(rays.rotation(k)), rays.dir(k));
        const double lower = bounds.lower * bounds.lower * bounds.lower;
        const double upper = bounds.upper * bounds.upper * bounds.upper;
        cube = answers_.cube_of(k, columns_.rays[RayTable::kPick][k], 0.5 * (lower + upper));
        if (upper - lower > 2.0 * relative_rounding() * upper) {
          doubts.push_back({first + k, 0.5 * weight * (upper - lower)});
        }
      }
      values[first + k] = weight * cube;
    }
  }
  return doubts;
}

}  // namespace vex
