#include "engine/scene/aabb_tree.h"

#include <algorithm>
#include <atomic>

#include "engine/numeric/expect.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// How much the boxes around the blocks may grow, all together.
constexpr double kWorn = 1.5;

template <class Real>
double half_area(const RealBox<Real>& box) {
  const double x = static_cast<double>(box.upper[0]) - static_cast<double>(box.lower[0]);
  const double y = static_cast<double>(box.upper[1]) - static_cast<double>(box.lower[1]);
  const double z = static_cast<double>(box.upper[2]) - static_cast<double>(box.lower[2]);
  return (x * y + y * z) + z * x;
}

template <class Real>
double extent(const RealBox<Real>& box) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    sum += static_cast<double>(box.upper[axis]) - static_cast<double>(box.lower[axis]);
  }
  return sum;
}

template <class Real>
Aabb as_aabb(const RealBox<Real>& box) {
  const auto wide = [](const Real(&p)[3]) {
    return Vec3d{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  return {wide(box.lower), wide(box.upper)};
}

}  // namespace

std::size_t AabbTree::level_of(std::uint32_t block) const {
  std::size_t level = 0;
  while (block >= first_[level + 1]) ++level;
  return level;
}

void AabbTree::build(std::span<const Aabb> boxes, int n_threads) {
  VEX_EXPECT(boxes.size() < (std::uint64_t{1} << 32));
  order_boxes(boxes, kWidth, n_threads, keys_, order_);
  const std::size_t n = boxes.size();
  place_.resize(n);
  for (std::size_t k = 0; k < n; ++k) place_[order_[k]] = static_cast<std::uint32_t>(k);
  n_levels_ = 0;
  first_[0] = 0;
  std::size_t n_blocks = std::max<std::size_t>((n + kWidth - 1) / kWidth, 1);
  for (;;) {
    first_[n_levels_ + 1] = first_[n_levels_] + static_cast<std::uint32_t>(n_blocks);
    ++n_levels_;
    if (n_blocks == 1) break;
    n_blocks = (n_blocks + kWidth - 1) / kWidth;
  }
  is_in_floats_ = true;
  fit<float>(boxes, n_threads);
  if (is_coarse_) {
    is_in_floats_ = false;
    fit<double>(boxes, n_threads);
  }
  is_in_floats_ ? double_blocks_.clear() : float_blocks_.clear();
  area_when_built_ = area_;
}

void AabbTree::refit(std::span<const Aabb> boxes, int n_threads) {
  VEX_EXPECT(boxes.size() == size());
  is_in_floats_ ? fit<float>(boxes, n_threads) : fit<double>(boxes, n_threads);
}

bool AabbTree::is_worn() const { return is_coarse_ || area_ > kWorn * area_when_built_; }

// Of each block of leaves it is looked whether rounding makes the box around it larger by more than 1/16: two such
// blocks in one place may be taken to meet whatever is in them.
template <class Real>
void AabbTree::fit(std::span<const Aabb> boxes, int n_threads) {
  Blocks<Real>& all = blocks<Real>();
  all.resize(first_[n_levels_]);
  const std::size_t n = size();
  std::atomic<std::size_t> n_coarse{0};
  share_range(n_threads, first_[1], 512, [&](std::size_t first, std::size_t last) {
    constexpr std::size_t kAhead = 4 * kWidth;
    std::size_t n_coarse_here = 0;
    for (std::size_t b = first; b < last; ++b) {
      BoxBlock<Real>& block = all[b];
      BoxBlock<double> unrounded;
      for (std::size_t k = 0; k < kWidth; ++k) {
        const std::size_t place = b * kWidth + k;
        if (place + kAhead < n) {  // boxes are read in no order that the processor would foresee
          const Aabb* const ahead = &boxes[order_[place + kAhead]];
          __builtin_prefetch(ahead);
          __builtin_prefetch(&ahead->upper.z);
        }
        place < n ? unrounded.set(k, RealBox<double>::around(boxes[order_[place]])) : unrounded.clear(k);
      }
      block.set(unrounded);
      const RealBox<Real> hull = block.hull();
      if (n_levels_ > 1) all[first_[1] + b / kWidth].set(b % kWidth, hull);
      if (sizeof(Real) < sizeof(double) && !(extent(hull) <= 1.0625 * extent(unrounded.hull()))) ++n_coarse_here;
    }
    n_coarse += n_coarse_here;
  });
  is_coarse_ = n > 0 && n_coarse > first_[1] / 256;
  for (std::size_t level = 1; level < n_levels_; ++level) {
    const std::size_t n_blocks = first_[level + 1] - first_[level];
    // The level below has put its boxes in; the last block may have places to spare.
    for (std::size_t k = first_[level] - first_[level - 1]; k < n_blocks * kWidth; ++k) {
      all[first_[level] + k / kWidth].clear(k % kWidth);
    }
    if (level + 1 == n_levels_) break;
    share_range(n_threads, n_blocks, 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) {
        all[first_[level + 1] + b / kWidth].set(b % kWidth, all[first_[level] + b].hull());
      }
    });
  }
  area_ = 0.0;
  for (std::size_t below = 0; n_levels_ > 1 && below < first_[1]; ++below) {
    area_ += half_area(all[first_[1] + below / kWidth].box(below % kWidth));
  }
  bounds_ = as_aabb(all[root()].hull());
}

template <class Real>
void AabbTree::move_in(std::uint32_t place, const Aabb& box) {
  Blocks<Real>& all = blocks<Real>();
  RealBox<Real> fitted = RealBox<Real>::around(box);
  std::size_t at = place;
  for (std::size_t level = 0; level < n_levels_; ++level) {
    BoxBlock<Real>& block = all[first_[level] + at / kWidth];
    if (level == 1) area_ += half_area(fitted) - half_area(block.box(at % kWidth));
    block.set(at % kWidth, fitted);
    fitted = block.hull();
    at /= kWidth;
  }
  bounds_ = as_aabb(fitted);
}

void AabbTree::move(std::uint32_t leaf, const Aabb& box) {
  VEX_EXPECT(leaf < size());
  is_in_floats_ ? move_in<float>(place_[leaf], box) : move_in<double>(place_[leaf], box);
}

void AabbTree::pair_tasks(std::span<const Vec3d> shifts, std::size_t n_wanted, std::vector<PairTask>& tasks) const {
  tasks.clear();
  for (std::size_t k = 0; k < shifts.size(); ++k) tasks.push_back({root(), root(), static_cast<std::uint32_t>(k)});
  is_in_floats_ ? add_tasks<float>(shifts, n_wanted, tasks) : add_tasks<double>(shifts, n_wanted, tasks);
}

// Splits the first task until there are enough: all of a level before one of the next.
template <class Real>
void AabbTree::add_tasks(std::span<const Vec3d> shifts, std::size_t n_wanted, std::vector<PairTask>& tasks) const {
  const Blocks<Real>& all = blocks<Real>();
  std::size_t head = 0;
  for (; head < tasks.size() && tasks.size() - head < n_wanted; ++head) {
    const PairTask task = tasks[head];
    const std::size_t level = level_of(task.node);
    if (level == 0) break;
    const BoxBlock<Real>&block = all[task.node], &other = all[task.other];
    const auto add = [&](std::size_t k, std::size_t l) {
      tasks.push_back({child(level, task.node, k), child(level, task.other, l), task.shift});
    };
    if (task.shift == 0 && task.node == task.other) {
      for (std::size_t k = 0; k < kWidth && child(level, task.node, k) < first_[level]; ++k) add(k, k);
      pairs_within(block, add);
    } else if (task.shift == 0) {
      pairs_between<Real, false>(block, other, other.hull(), {}, add);
    } else {
      pairs_between<Real, true>(block, other, other.hull(), shifts[task.shift], add);
    }
  }
  tasks.erase(tasks.begin(), tasks.begin() + static_cast<std::ptrdiff_t>(head));
}

}  // namespace vex
