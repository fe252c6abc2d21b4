#include "engine/scene/broad_phase_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/scene/body_tree.h"
#include "engine/scene/cell_layout.h"
#include "engine/scene/sorted_bodies.h"

namespace vex {
namespace {

// Some nanoseconds on a processor of 2024, by vex_scene_bench: a body of each, a pair that each looks at, and one whose
// balls meet, which of the grid's has its bodies placed before anything else tells them apart.
constexpr double kGridBody = 105.0, kGridPair = 0.65, kGridMet = 15.0, kTreeBody = 560.0, kTreePair = 40.0;
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

// Whether bodies of the one cell are compared with those of the other.
bool are_neighbours(const CellLayout& layout, const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int apart = std::abs(a[k] - b[k]), around = layout.box ? layout.n_cells[k] - apart : apart;
    if (std::min(apart, around) > layout.stencil[k]) return false;
  }
  return true;
}

}  // namespace

BroadPhase cheaper_broad_phase(const SceneBodies& bodies, double reach, double margin) {
  const std::vector<BodyId> asking = sample(bodies, kAsking), asked = sample(bodies, kAsked);
  if (asking.empty() || asked.empty()) return BroadPhase::grid;
  std::vector<Aabb> boxes;
  for (const BodyId body : asked) boxes.push_back(scene_box(bodies, body, margin, 0.0));
  const Aabb bounds = bodies.box() ? Aabb{} : bounds_of_centres(bodies, 1);
  const CellLayout layout =
      CellLayout::make(bodies.box(), bounds, bodies.largest_offset(), {reach, reach, reach}, bodies.size());
  std::vector<std::array<int, 3>> cells;
  for (const BodyId body : asked) cells.push_back(layout.coordinates(bodies.centre(body)));
  double in_cells = 0.0, in_balls = 0.0, in_boxes = 0.0;
  for (const BodyId body : asking) {
    const Aabb box = scene_box(bodies, body, margin, 0.0);
    const std::array<int, 3> cell = layout.coordinates(bodies.centre(body));
    const double radius = bodies.bounds(bodies.shape_of()[body]).radius + margin;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (asked[k] == body) continue;
      const Vec3d way = bodies.centre(asked[k]) - bodies.centre(body);
      const Vec3d shift = bodies.box() ? bodies.box()->shift(bodies.box()->towards_origin(way)) : Vec3d{};
      if (are_neighbours(layout, cell, cells[k])) in_cells += 1.0;
      const double met = radius + bodies.bounds(bodies.shape_of()[asked[k]]).radius;
      if (norm(way + shift) <= met) in_balls += 1.0;
      if (box.meets({boxes[k].lower + shift, boxes[k].upper + shift})) in_boxes += 1.0;
    }
  }
  const double times = 0.5 * static_cast<double>(bodies.size()) /
                       (static_cast<double>(asking.size()) * static_cast<double>(asked.size()));
  const double of_grid = kGridBody + (kGridPair * in_cells + kGridMet * in_balls) * times,
               of_tree = kTreeBody + kTreePair * in_boxes * times;
  return of_grid <= of_tree ? BroadPhase::grid : BroadPhase::tree;
}

}  // namespace vex
