#include "engine/scene/sorted_bodies.h"

#include <cmath>

#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::size_t kRoom = 16, kBodiesAShare = 4096;

}  // namespace

void SortedBodies::fill(const SceneBodies& bodies, std::span<const BodyId> order, double largest_shift, bool boxes,
                        bool with_poses, int n_threads) {
  const std::size_t n = order.size();
  id.resize(n);
  shape.resize(n);
  poses.resize(with_poses ? kNumbersABody * n : 0);
  for (LargeVector<double>* column : {&x, &y, &z, &radius}) column->resize(n + kRoom);
  const double* const from = bodies.poses().data();
  const bool is_one_shape = bodies.shapes().size() == 1;
  share_range(n_threads, n, kBodiesAShare, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      if (k + kAhead < end) {
        if (with_poses) {
          const double* const next = from + kNumbersABody * order[k + kAhead];
          __builtin_prefetch(next);
          __builtin_prefetch(next + kNumbersABody - 1);
        } else {
          __builtin_prefetch(&bodies.centre(order[k + kAhead]));
        }
        if (!is_one_shape) __builtin_prefetch(&bodies.shape_of()[order[k + kAhead]]);
      }
      const BodyId body = order[k];
      const ShapeId of = is_one_shape ? 0 : bodies.shape_of()[body];
      id[k] = body;
      shape[k] = of;
      const ShapeBounds& bounds = bodies.bounds(of);
      Vec3d centre;
      if (with_poses) {
        const double* const pose = from + kNumbersABody * body;
        double* const to = poses.data() + kNumbersABody * k;
        for (std::size_t j = 0; j < kNumbersABody; ++j) to[j] = pose[j];
        centre = SceneBodies::centre_of(SceneBodies::pose_at(poses.data(), k), bounds.centre);
      } else {
        centre = bodies.centre(body);
      }
      x[k] = centre.x;
      y[k] = centre.y;
      z[k] = centre.z;
      radius[k] = (boxes ? 0.0 : bounds.radius) + bounds.rounding_at(centre, largest_shift);
    }
  });
}

void SortedBodies::widen(double distance) {
  const double more = 0.5 * distance * (1.0 + 0x1p-19);
  for (double& r : radius) r += more;
}

Aabb bounds_of_centres(const SceneBodies& bodies, int n_threads) {
  constexpr Aabb kNothing{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  if (bodies.size() == 0) return {};
  const auto bounds_of = [&](const Part& part) {
    Aabb bounds = kNothing;
    for (std::size_t k = part.first; k < part.end; ++k) {
      const BodyId body = static_cast<BodyId>(k);
      if (bodies.has(body)) bounds = hull_of(bounds, {bodies.centre(body), bodies.centre(body)});
    }
    return bounds;
  };
  if (n_threads == 1) return bounds_of({0, bodies.end()});
  std::vector<Aabb> parts(static_cast<std::size_t>(n_threads), kNothing);
  on_threads(n_threads, [&](int thread) {
    parts[static_cast<std::size_t>(thread)] = bounds_of(part_of(bodies.end(), thread, n_threads));
  });
  Aabb all = kNothing;
  for (const Aabb& part : parts) all = hull_of(all, part);
  return all;
}

}  // namespace vex
