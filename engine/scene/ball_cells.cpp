#include "engine/scene/ball_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/sorted_bodies.h"

namespace vex {
namespace {

constexpr std::size_t kLanes = BallBlock::kLanes;

// An empty seat is too far away to meet anything: its square is infinite.
BallBlock empty_block() {
  BallBlock block{};
  for (double& x : block.x) x = 1e300;
  return block;
}

// Of open space: where nearly all bodies are, so that a few which are far away do not make all cells large. What is
// beyond the outermost cells is held by them (BallCells::takes).
Aabb bounds_of_most(const SceneBodies& bodies, const Aabb& all) {
  constexpr std::size_t kSample = 1024, kBeyond = 16;
  std::array<std::vector<double>, 3> along;
  const std::size_t step = std::max<std::size_t>(bodies.end() / kSample, 1);
  for (std::size_t k = 0; k < bodies.end(); k += step) {
    const BodyId body = static_cast<BodyId>(k);
    if (!bodies.has(body)) continue;
    const Vec3d& centre = bodies.centre(body);
    along[0].push_back(centre.x);
    along[1].push_back(centre.y);
    along[2].push_back(centre.z);
  }
  const std::size_t n = along[0].size();
  if (n < 4 * kBeyond) return all;
  const auto within = [&](std::vector<double>& values, double* lower, double* upper) {
    std::sort(values.begin(), values.end());
    const double first = values[kBeyond], last = values[n - 1 - kBeyond], more = 0.25 * (last - first);
    *lower = std::fmax(*lower, first - more);
    *upper = std::fmin(*upper, last + more);
  };
  Aabb most = all;
  within(along[0], &most.lower.x, &most.upper.x);
  within(along[1], &most.lower.y, &most.upper.y);
  within(along[2], &most.lower.z, &most.upper.z);
  return most;
}

}  // namespace

void BallCells::build(const SceneBodies& bodies, double reach, double farthest) {
  reach_ = reach;
  const Aabb bounds = bodies.box() ? Aabb{} : bounds_of_centres(bodies, 1);
  // Room for bodies that move, twice as far out as they are.
  farthest_ = std::fmax(norm_1(bounds.lower), norm_1(bounds.upper)) + bodies.largest_offset() + reach;
  farthest_ = 2.0 * std::fmax(farthest_, farthest);
  layout_ = CellLayout::make(bodies.box(), bodies.box() ? bounds : bounds_of_most(bodies, bounds), farthest_, reach,
                             bodies.size());
  shifts_ = ShiftTable(layout_.box, layout_.n_images);
  for (std::size_t axis = 0; axis < 3; ++axis) stencils_[axis] = stencil_along(axis);
  shift_error_ = 0x1p-46 * 3.0 * shifts_.largest_shift();
  clear();
  for (BodyId body = 0; body < bodies.end(); ++body) {
    if (bodies.has(body)) add(bodies, body);
  }
}

// The number of a cell, and that of a shift, is linear in its three coordinates.
BallCells::Stencil BallCells::stencil_along(std::size_t axis) const {
  const std::array<int, 3>& n_images = shifts_.n_images();
  Stencil stencil;
  stencil.first.push_back(0);
  for (int at = 0; at < layout_.n_cells[axis]; ++at) {
    for (int by = -layout_.stencil[axis]; by <= layout_.stencil[axis]; ++by) {
      const CellLayout::Moved moved = layout_.moved(axis, at, by);
      if (!moved.is_any) continue;
      std::array<int, 3> cell{};
      ImageOffset image{-n_images[0], -n_images[1], -n_images[2]};
      cell[axis] = moved.cell;
      image[axis] = moved.image;
      stencil.steps.push_back({layout_.number(cell), shifts_.number(image)});
    }
    stencil.first.push_back(static_cast<std::uint32_t>(stencil.steps.size()));
  }
  return stencil;
}

void BallCells::clear() {
  blocks_.assign(layout_.size(), empty_block());
  n_.assign(blocks_.size(), 0);
  after_.assign(blocks_.size(), kNone);
  free_.clear();
  seats_.clear();
}

bool BallCells::takes(const SceneBodies& bodies, BodyId body) const {
  const ShapeBounds& bounds = bodies.bounds(bodies.shape_of()[body]);
  if (!(2.0 * bounds.radius <= reach_)) return false;
  return goes_as_far_as(norm_1(bodies.centre(body)) + norm_1(bounds.centre));
}

void BallCells::take_seat(std::uint32_t block, BodyId body, const Vec3d& centre, double radius) {
  const std::uint32_t lane = n_[block]++;
  BallBlock& balls = blocks_[block];
  balls.x[lane] = centre.x;
  balls.y[lane] = centre.y;
  balls.z[lane] = centre.z;
  balls.radius[lane] = radius;
  balls.body[lane] = body;
  seats_[body] = {block, lane};
}

// A cell's first block is the last one to be filled: all behind it are full.
void BallCells::add(const SceneBodies& bodies, BodyId body) {
  if (body >= seats_.size()) seats_.resize(std::size_t{body} + 1);
  const Vec3d& centre = bodies.centre(body);
  const ShapeBounds& bounds = bodies.bounds(bodies.shape_of()[body]);
  // As SortedBodies::fill.
  const double radius = bounds.radius + 0x1p-46 * (norm_1(centre) + norm_1(bounds.centre)) + shift_error_ + kTrifle;
  const std::uint32_t first = layout_.number(layout_.coordinates(centre));
  if (n_[first] == kLanes) {
    std::uint32_t full = static_cast<std::uint32_t>(blocks_.size());
    if (free_.empty()) {
      blocks_.push_back(blocks_[first]);
      n_.push_back(kLanes);
      after_.push_back(after_[first]);
    } else {
      full = free_.back();
      free_.pop_back();
      blocks_[full] = blocks_[first];
      n_[full] = kLanes;
      after_[full] = after_[first];
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) seats_[blocks_[full].body[lane]] = {full, lane};
    blocks_[first] = empty_block();
    n_[first] = 0;
    after_[first] = full;
  }
  take_seat(first, body, centre, radius);
}

void BallCells::remove(BodyId body) {
  const Seat seat = seats_[body];
  // The last ball of the cell's first block takes the seat.
  const std::uint32_t first = layout_.number(layout_.coordinates(
      {blocks_[seat.block].x[seat.lane], blocks_[seat.block].y[seat.lane], blocks_[seat.block].z[seat.lane]}));
  BallBlock& from = blocks_[first];
  BallBlock& to = blocks_[seat.block];
  const std::uint32_t last = --n_[first];
  to.x[seat.lane] = from.x[last];
  to.y[seat.lane] = from.y[last];
  to.z[seat.lane] = from.z[last];
  to.radius[seat.lane] = from.radius[last];
  to.body[seat.lane] = from.body[last];
  seats_[from.body[last]] = seat;
  from.x[last] = 1e300;
  seats_[body] = {};
  if (n_[first] > 0 || after_[first] == kNone) return;
  // The next block, which is full, becomes the first.
  const std::uint32_t next = after_[first];
  blocks_[first] = blocks_[next];
  n_[first] = n_[next];
  after_[first] = after_[next];
  for (std::uint32_t lane = 0; lane < n_[first]; ++lane) seats_[blocks_[first].body[lane]] = {first, lane};
  n_[next] = 0;
  free_.push_back(next);
}

}  // namespace vex
