#include "engine/scene/broad_phase_choice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scene/body_tree.h"

namespace vex {
namespace {

// Some nanoseconds on a processor of 2024, by vex_scene_bench: a body of each, and a pair that each looks at.
constexpr double kGridBody = 105.0, kGridPair = 0.65, kTreeBody = 560.0, kTreePair = 40.0;
constexpr std::size_t kAsking = 64, kAsked = 2048;

// Of about so many bodies, equally far apart in the order of their numbers.
std::vector<BodyId> sample(const SceneBodies& bodies, std::size_t n) {
  std::vector<BodyId> some;
  const double step = std::fmax(1.0, static_cast<double>(bodies.end()) / static_cast<double>(n));
  for (double at = 0.0; at < static_cast<double>(bodies.end()); at += step) {
    if (bodies.has(static_cast<BodyId>(at))) some.push_back(static_cast<BodyId>(at));
  }
  return some;
}

}  // namespace

BroadPhase cheaper_broad_phase(const SceneBodies& bodies, double reach, double margin) {
  const std::vector<BodyId> asking = sample(bodies, kAsking), asked = sample(bodies, kAsked);
  if (asking.empty() || asked.empty()) return BroadPhase::grid;
  std::vector<Aabb> boxes;
  for (const BodyId body : asked) boxes.push_back(scene_box(bodies, body, margin, 0.0));
  double in_cells = 0.0, in_boxes = 0.0;
  for (const BodyId body : asking) {
    const Aabb box = scene_box(bodies, body, margin, 0.0);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (asked[k] == body) continue;
      Vec3d d = bodies.centre(asked[k]) - bodies.centre(body), shift{};
      if (bodies.box()) {
        const Vec3d f = bodies.box()->fractional(d);
        shift = bodies.box()->shift({-static_cast<int>(std::nearbyint(f.x)), -static_cast<int>(std::nearbyint(f.y)),
                                     -static_cast<int>(std::nearbyint(f.z))});
        d = d + shift;
      }
      // A body in the middle of its cell sees the 27 cells around.
      const double farthest = std::fmax(std::fabs(d.x), std::fmax(std::fabs(d.y), std::fabs(d.z)));
      if (farthest <= 1.5 * reach) in_cells += 1.0;
      if (box.meets({boxes[k].lower + shift, boxes[k].upper + shift})) in_boxes += 1.0;
    }
  }
  const double times = 0.5 * static_cast<double>(bodies.size()) /
                       (static_cast<double>(asking.size()) * static_cast<double>(asked.size()));
  const double of_grid = kGridBody + kGridPair * in_cells * times, of_tree = kTreeBody + kTreePair * in_boxes * times;
  return of_grid <= of_tree ? BroadPhase::grid : BroadPhase::tree;
}

}  // namespace vex
