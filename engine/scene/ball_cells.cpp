#include "engine/scene/ball_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/numeric/interruption.h"
#include "engine/scene/sorted_bodies.h"

namespace vex {
namespace {

constexpr std::size_t kLanes = BallBlock::kLanes;

// NaN meets nothing.
BallBlock empty_block() {
  BallBlock block{};
  for (float& x : block.x) x = std::numeric_limits<float>::quiet_NaN();
  return block;
}

// Units in which a length that queries reach over is between 1 and 2.
double units_for(double reach) { return reach > 0.0 ? std::ldexp(1.0, -std::ilogb(reach)) : 1.0; }

// Of open space: where nearly all bodies are, so that a few which are far away do not make all cells large. What is
// beyond the outermost cells is held by them (BallCells::takes).
Aabb bounds_of_most(const SceneBodies& bodies, const Aabb& all, std::array<std::vector<double>, 3>& along) {
  constexpr std::size_t kSample = 1024, kBeyond = 16;
  for (std::vector<double>& values : along) values.clear();
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

void BallCells::lay_out(const std::optional<PeriodicBox>& box, const Aabb& bounds, double farthest, double reach,
                        std::size_t n_bodies) {
  extents_.reset();
  units_ = units_for(reach);
  layout_ = CellLayout::make(box, bounds, farthest, {reach, reach, reach}, n_bodies);
  merge_cells(n_bodies);
}

void BallCells::lay_out_upright(const std::optional<PeriodicBox>& box, const Aabb& bounds, double farthest,
                                const Vec3d& extents, std::size_t n_bodies) {
  units_ = units_for(std::fmax(extents.x, std::fmax(extents.y, extents.z)));
  extents_ = {rounded_up(extents.x), rounded_up(extents.y), rounded_up(extents.z)};
  layout_ = CellLayout::make(box, bounds, farthest, (1.0 + 0x1p-18) * extents, n_bodies);
  merge_cells(n_bodies);
}

void BallCells::begin(const ShiftTable& shifts) {
  shifts_ = &shifts;
  largest_shift_ = 3.0 * shifts.largest_shift();
  for (std::size_t axis = 0; axis < 3; ++axis) make_stencil(axis);
  clear();
}

// Where cells are nearly empty two along each axis are held as one (of an odd number the last alone). What is near a
// cell is then in two of these along the axis, not in three: eight are looked at instead of 27, and about as many
// blocks have anything in them.
void BallCells::merge_cells(std::size_t n_bodies) {
  constexpr std::size_t kFew = 2;  // bodies a cell
  const bool are_few = n_bodies <= kFew * layout_.size();
  n_held_ = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int n = layout_.n_cells[axis];
    merged_[axis] = are_few && n > 1 && layout_.stencil[axis] == 1 ? 1 : 0;
    held_stride_[axis] = static_cast<std::uint32_t>(n_held_);
    n_held_ *= static_cast<std::size_t>((n + merged_[axis]) >> merged_[axis]);
  }
}

std::uint32_t BallCells::holder_of(const Vec3d& centre) const {
  const std::array<int, 3> cell = layout_.coordinates(centre);
  std::uint32_t number = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    number += static_cast<std::uint32_t>(cell[axis] >> merged_[axis]) * held_stride_[axis];
  }
  return number;
}

// The number of what holds a cell, and that of a shift, are linear in three coordinates.
void BallCells::make_stencil(std::size_t axis) {
  const std::array<int, 3>& n_images = shifts_->n_images();
  Stencil& stencil = stencils_[axis];
  stencil.steps.clear();
  stencil.first.assign(1, 0);
  for (int at = 0; at < layout_.n_cells[axis]; ++at) {
    for (int by = -layout_.stencil[axis]; by <= layout_.stencil[axis]; ++by) {
      const CellLayout::Moved moved = layout_.moved(axis, at, by);
      if (!moved.is_any) continue;
      ImageOffset image{-n_images[0], -n_images[1], -n_images[2]};
      image[axis] = moved.image;
      const Step step{static_cast<std::uint32_t>(moved.cell >> merged_[axis]) * held_stride_[axis],
                      shifts_->number(image)};
      // Of two cells that are held as one the second follows the first.
      const bool is_there = stencil.steps.size() > stencil.first.back() && stencil.steps.back() == step;
      if (!is_there) stencil.steps.push_back(step);
    }
    stencil.first.push_back(static_cast<std::uint32_t>(stencil.steps.size()));
  }
}

void BallCells::clear() {
  blocks_.assign(n_held_, empty_block());
  links_.assign(blocks_.size(), {});
  free_.clear();
  seats_.clear();
}

// The block's origin is the centre of the body that came first: then coordinates are as small as a cell, wherever that
// is. What is too far from it, in the outermost cells of open space, may meet everything.
void BallCells::write_ball(BallBlock& balls, std::uint32_t lane, const SceneBodies& bodies, BodyId body) const {
  const Vec3d& centre = bodies.centre(body);
  const ShapeBounds& bounds = bodies.bounds_of(body);
  const Vec3d from = units_ * (centre - Vec3d{balls.origin[0], balls.origin[1], balls.origin[2]});
  const double distance = norm_1(from);
  const bool is_near = distance <= 0x1p40;
  balls.x[lane] = is_near ? static_cast<float>(from.x) : 0.0f;
  balls.y[lane] = is_near ? static_cast<float>(from.y) : 0.0f;
  balls.z[lane] = is_near ? static_cast<float>(from.z) : 0.0f;
  const float radius = rounded_up((extents_ ? 0.0 : bounds.radius) + bounds.rounding_at(centre, largest_shift_));
  balls.radius[lane] =
      is_near ? radius + static_cast<float>(0x1p-21 * distance) : std::numeric_limits<float>::infinity();
  balls.body[lane] = body;
}

// A cell's first block is the last one to be filled: all behind it are full.
void BallCells::add(const SceneBodies& bodies, BodyId body) {
  if (body >= seats_.size()) seats_.resize(std::size_t{body} + 1);
  const Vec3d& centre = bodies.centre(body);
  const std::uint32_t first = holder_of(centre);
  if (links_[first].n == kLanes) {
    std::uint32_t full = static_cast<std::uint32_t>(blocks_.size());
    if (free_.empty()) {
      blocks_.push_back(blocks_[first]);
      links_.push_back(links_[first]);
    } else {
      full = free_.back();
      free_.pop_back();
      blocks_[full] = blocks_[first];
      links_[full] = links_[first];
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) seats_[blocks_[full].body[lane]].block = full;
    blocks_[first] = empty_block();
    links_[first] = {0, full};
  }
  const std::uint32_t lane = links_[first].n++;
  BallBlock& balls = blocks_[first];
  if (lane == 0) {
    balls.origin[0] = centre.x;
    balls.origin[1] = centre.y;
    balls.origin[2] = centre.z;
  }
  write_ball(balls, lane, bodies, body);
  seats_[body] = {first, lane, first};
}

void BallCells::remove(const SceneBodies& bodies, BodyId body) {
  const Seat seat = seats_[body];
  // The last ball of the cell's first block takes the seat.
  const std::uint32_t first = seat.first, last = --links_[first].n;
  const BodyId moved = blocks_[first].body[last];
  if (moved != body) {
    write_ball(blocks_[seat.block], seat.lane, bodies, moved);
    seats_[moved] = seat;
  }
  blocks_[first].x[last] = std::numeric_limits<float>::quiet_NaN();
  seats_[body] = {};
  if (links_[first].n > 0 || links_[first].after == kNone) return;
  // The next block, which is full, becomes the first.
  const std::uint32_t next = links_[first].after;
  blocks_[first] = blocks_[next];
  links_[first] = links_[next];
  for (std::uint32_t lane = 0; lane < links_[first].n; ++lane) seats_[blocks_[first].body[lane]].block = first;
  links_[next].n = 0;
  free_.push_back(next);
}

// Of the radii that are there: a class begins where one is less than 1 / kLeastRatio of its largest; of many different
// ones there are kMostClasses, as far apart on a logarithmic scale.
void BallCellsOfScene::make_classes(const SceneBodies& bodies, bool are_expected) {
  constexpr double kLeastRatio = 2.0;
  constexpr int kMostClasses = 4;
  is_there_.assign(bodies.shapes().size(), are_expected);
  for (BodyId body = 0; body < bodies.end() && !are_expected; ++body) {
    if (bodies.has(body)) is_there_[bodies.shape_of()[body]] = true;
  }
  largest_.clear();
  for (ShapeId shape = 0; shape < is_there_.size(); ++shape) {
    if (is_there_[shape]) largest_.push_back(bodies.bounds(shape).radius);
  }
  if (largest_.empty()) largest_.push_back(0.0);
  std::sort(largest_.begin(), largest_.end(), std::greater<>());
  const double all = largest_.front() / std::fmax(largest_.back(), 0x1p-1000);
  const double ratio = std::fmax(kLeastRatio, std::pow(all, 1.0 / kMostClasses));
  double first = HUGE_VAL;
  std::erase_if(largest_, [&](double radius) {
    const bool is_new = radius * ratio < first;
    if (is_new) first = radius;
    return !is_new;
  });
}

void BallCellsOfScene::build(const SceneBodies& bodies, double farthest, double offset, std::size_t n_expected,
                             bool may_be_upright) {
  const std::optional<PeriodicBox>& box = bodies.box();
  in_box_ = box.has_value();
  are_upright_ = may_be_upright && bodies.are_told_by_boxes();
  make_classes(bodies, n_expected > 0);
  const std::size_t n = largest_.size();
  const auto reach = [this](std::size_t i, std::size_t j) { return (largest_[i] + largest_[j]) * (1.0 + 0x1p-18); };
  Aabb bounds = box ? Aabb{} : bounds_of_centres(bodies, 1);
  // Room for bodies that move, twice as far out as they are.
  farthest_ = std::fmax(norm_1(bounds.lower), norm_1(bounds.upper)) + offset + reach(0, 0);
  farthest_ = 2.0 * std::fmax(farthest_, farthest);
  if (!box) bounds = bounds_of_most(bodies, bounds, sample_);
  n_bodies_.assign(n, n_expected);
  for (BodyId body = 0; body < bodies.end() && n_expected == 0; ++body) {
    if (bodies.has(body)) ++n_bodies_[class_of(bodies.bounds(bodies.shape_of()[body]).radius)];
  }
  grids_.resize(n * n);
  std::array<int, 3> n_images{};
  for (std::size_t asking = 0; asking < n; ++asking) {
    for (std::size_t held = 0; held < n; ++held) {
      BallCells& grid = grids_[asking * n + held];
      if (are_upright_) {
        grid.lay_out_upright(box, bounds, farthest_, bodies.bounds(0).extents, n_bodies_[held]);
      } else {
        grid.lay_out(box, bounds, farthest_, reach(asking, held), n_bodies_[held]);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) n_images[axis] = std::max(n_images[axis], grid.n_images()[axis]);
    }
  }
  shifts_.assign(box, n_images);
  for (BallCells& grid : grids_) grid.begin(shifts_);
  for (BodyId body = 0; body < bodies.end(); ++body) {
    if (body % 1024 == 0) end_if_interrupted();
    if (bodies.has(body)) add(bodies, body);
  }
}

void BallCellsOfScene::add(const SceneBodies& bodies, BodyId body) {
  const std::size_t n = largest_.size(), held = class_of(bodies.bounds(bodies.shape_of()[body]).radius);
  for (std::size_t asking = 0; asking < n; ++asking) grids_[asking * n + held].add(bodies, body);
}

void BallCellsOfScene::remove(const SceneBodies& bodies, BodyId body) {
  const std::size_t n = largest_.size(), held = class_of(bodies.bounds(bodies.shape_of()[body]).radius);
  for (std::size_t asking = 0; asking < n; ++asking) grids_[asking * n + held].remove(bodies, body);
}

void BallCellsOfScene::clear() {
  for (BallCells& grid : grids_) grid.clear();
}

bool BallCellsOfScene::takes(const SceneBodies& bodies, BodyId body) const {
  const ShapeBounds& bounds = bodies.bounds(bodies.shape_of()[body]);
  if (are_upright_ && !(bodies.shapes().size() == 1 && SceneBodies::is_upright(bodies.pose(body)))) return false;
  return takes(bounds.radius) && goes_as_far_as(norm_1(bodies.centre(body)) + norm_1(bounds.centre));
}

}  // namespace vex
