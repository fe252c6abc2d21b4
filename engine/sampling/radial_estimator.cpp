#include "engine/sampling/radial_estimator.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/expect.h"
#include "engine/query/radial_function.h"

namespace vex {

RadialEstimator::RadialEstimator(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                                 InstructionSet set)
    : a_(a), b_(b), map_(a, b, law), packets_(make_packet_rays(ray_kernel(set), a, b, map_.points())) {}

void RadialEstimator::evaluate(std::span<const double> points, std::span<double> values) {
  const auto dimension = static_cast<std::size_t>(map_.dimension());
  VEX_EXPECT(points.size() == dimension * values.size());
  for (std::size_t first = 0; first < values.size(); first += PacketRays::kMostRays) {
    const std::size_t n = std::min(PacketRays::kMostRays, values.size() - first);
    evaluate_part(points.subspan(dimension * first, dimension * n), values.subspan(first, n));
  }
}

void RadialEstimator::evaluate_part(std::span<const double> points, std::span<double> values) {
  const auto dimension = static_cast<std::size_t>(map_.dimension());
  const std::size_t n = values.size();
  for (std::size_t k = 0; k < n; ++k) {
    RadialRay<double>& ray = rays_[k];
    ray = map_(points.subspan(dimension * k, dimension));
    std::size_t column = 0;
    const auto put = [&](const Vec3d& v) {
      for (const double x : {v.x, v.y, v.z}) columns_[column++][k] = x;
    };
    put(ray.rotation.row_x);
    put(ray.rotation.row_y);
    put(ray.rotation.row_z);
    put(ray.dir);
    columns_[column++][k] = ray.pick;
    for (const Vec3d& normal : ray.normals) put(normal);
  }
  if (packets_ != nullptr) {
    packets_->cubes({columns_[0], PacketRays::kStride, n}, values.data());
  } else {
    std::ranges::fill(values, std::nan(""));
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (std::isnan(values[k])) {
      ++n_one_by_one_;
      const RadialBounds bounds = radial_function(a_, b_, map_.points(), rays_[k].rotation, rays_[k].dir);
      const double r = 0.5 * (bounds.lower + bounds.upper);
      values[k] = r * r * r;
    }
    values[k] *= rays_[k].weight;
  }
}

}  // namespace vex
