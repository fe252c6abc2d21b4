#include "apps/vex_scene/random_scene.h"

#include <array>
#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/poses/orientation_law.h"

namespace vex {

PeriodicBox box_of_random_scene(const RandomScene& scene, const LoadedBody& body) {
  const double volume = body.shape.measures.volume;
  if (volume == 0.0 && body.shape.body.inradius() == 0.0) {
    throw InputError("a flat body fills no share of space (" + scene.body +
                     " for --random) - give a body with a volume, or poses of your own as FILE");
  }
  const double edge = std::cbrt(static_cast<double>(scene.n_bodies) / scene.eta) * std::cbrt(volume);
  if (!std::isfinite(volume) || !(volume > 0.0)) {
    throw InputError("a body whose volume is out of the range of doubles (" + scene.body +
                     " for --random) - choose another unit of length");
  }
  return PeriodicBox::cube(edge);
}

void place_at_random(SceneInput& scene, const RandomScene& random, std::uint32_t shape, const PeriodicBox& box,
                     std::uint64_t seed) {
  require_room_for(random.n_bodies, scene.source());
  const double edge = box.edges().x;
  std::array<double, 6> u{};
  for (std::uint64_t k = 0; k < random.n_bodies; ++k) {
    draw_unit_cube(seed, Stream::scene, k, u);
    Transformd pose = uniform_rotation(u[3], u[4], u[5]);
    pose.translation = {edge * (u[0] - 0.5), edge * (u[1] - 0.5), edge * (u[2] - 0.5)};
    scene.add(shape, pose);
  }
}

}  // namespace vex
