#include "engine/scene/broad_phase_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "engine/scene/body_tree.h"
#include "engine/scene/cell_layout.h"
#include "engine/scene/sorted_bodies.h"

namespace vex {
namespace {

// Some nanoseconds on a processor of 2024, by vex_scene_bench: a body of each, a pair that each looks at, and one whose
// balls meet, which of the grid's has its bodies placed before anything else tells them apart.
constexpr double kGridBody = 105.0, kGridPair = 0.65, kGridMet = 15.0, kTreeBody = 560.0, kTreePair = 40.0;

// So many bodies are compared with so many others: fewer where a scene has few, so that this takes a small part of what
// a query does.
constexpr std::size_t kAsking = 32, kAskingOfMany = 64, kMany = 65536;
constexpr std::size_t kLeastAsked = 64, kMostAsked = 2048, kBodiesAnAsked = 16;

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

// By what a copy is moved so that it is nearest, or about that.
Vec3d shift_to_nearest(const std::optional<PeriodicBox>& box, const Vec3d& way) {
  if (!box) return {};
  if (box->xy() != 0.0 || box->xz() != 0.0 || box->yz() != 0.0) return box->shift(box->towards_origin(way));
  const auto shift = [](double d, double edge) { return d > 0.5 * edge ? -edge : d < -0.5 * edge ? edge : 0.0; };
  const Vec3d& edges = box->edges();
  return {shift(way.x, edges.x), shift(way.y, edges.y), shift(way.z, edges.z)};
}

// How many of the asked bodies the asking ones meet: `of(body)` makes of one of these what tells it of each of those,
// by its place, the way to it, and the shift in that.
template <class Of>
double count(const SceneBodies& bodies, const std::vector<BodyId>& asking, const std::vector<BodyId>& asked,
             const Of& of) {
  std::size_t n = 0;
  for (const BodyId body : asking) {
    const auto meets = of(body);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (asked[k] == body) continue;
      const Vec3d way = bodies.centre(asked[k]) - bodies.centre(body);
      const Vec3d shift = shift_to_nearest(bodies.box(), way);
      if (meets(k, way + shift, shift)) ++n;
    }
  }
  return static_cast<double>(n);
}

}  // namespace

BroadPhase cheaper_broad_phase(const SceneBodies& bodies, double reach, double margin) {
  const std::size_t n = bodies.size();
  const std::vector<BodyId> asking = sample(bodies, n < kMany ? kAsking : kAskingOfMany),
                            asked = sample(bodies, std::clamp(n / kBodiesAnAsked, kLeastAsked, kMostAsked));
  if (asking.empty() || asked.empty()) return BroadPhase::grid;
  const Aabb bounds = bodies.box() ? Aabb{} : bounds_of_centres(bodies, 1);
  const CellLayout layout = CellLayout::make(bodies.box(), bounds, bodies.largest_offset(), {reach, reach, reach}, n);
  std::vector<std::array<int, 3>> cells;
  for (const BodyId body : asked) cells.push_back(layout.coordinates(bodies.centre(body)));
  double in_balls = 0.0;
  const double in_cells = count(bodies, asking, asked, [&](BodyId body) {
    return [&, cell = layout.coordinates(bodies.centre(body)), radius = bodies.bounds_of(body).radius + margin](
               std::size_t k, const Vec3d& way, const Vec3d&) {
      const double met = radius + bodies.bounds_of(asked[k]).radius;
      if (dot(way, way) <= met * met) in_balls += 1.0;
      return are_neighbours(layout, cell, cells[k]);
    };
  });
  const double times =
      0.5 * static_cast<double>(n) / (static_cast<double>(asking.size()) * static_cast<double>(asked.size()));
  const double of_grid = kGridBody + (kGridPair * in_cells + kGridMet * in_balls) * times;
  if (of_grid <= kTreeBody) return BroadPhase::grid;
  std::vector<Aabb> boxes;
  for (const BodyId body : asked) boxes.push_back(scene_box(bodies, body, margin, 0.0));
  const double in_boxes = count(bodies, asking, asked, [&](BodyId body) {
    return [&, box = scene_box(bodies, body, margin, 0.0)](std::size_t k, const Vec3d&, const Vec3d& shift) {
      return box.meets({boxes[k].lower + shift, boxes[k].upper + shift});
    };
  });
  return of_grid <= kTreeBody + kTreePair * in_boxes * times ? BroadPhase::grid : BroadPhase::tree;
}

}  // namespace vex
