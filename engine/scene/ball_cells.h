// A grid of cells that hold their bodies' balls: for queries of one body at a time, between which bodies come, go and
// move (internal).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/cell_layout.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/scene_kernel.h"
#include "engine/scene/shift_table.h"

namespace vex {

/// Holds the circumscribed ball of every body, those of a cell in blocks that a kernel reads.
class BallCells {
 public:
  /// For queries of balls whose centres are up to `reach` apart.
  void build(const SceneBodies& bodies, double reach, double farthest);
  double reach() const { return reach_; }
  /// Whether rounding is allowed for as far out as this, in the 1-norm: of a body or of a query. In a box it always is.
  bool goes_as_far_as(double distance) const { return layout_.box || distance <= farthest_; }
  const ShiftTable& shifts() const { return shifts_; }

  void add(const SceneBodies& bodies, BodyId body);
  /// There are no bodies; the cells stay.
  void clear();
  void remove(BodyId body);
  /// Whether the cells are large enough for the body, and for what rounding does where it is. Else where it is does not
  /// matter: in open space the outermost cells hold what is beyond them, since no two points are farther apart there
  /// than the points themselves.
  bool takes(const SceneBodies& bodies, BodyId body) const;

  /// Appends every body whose ball may meet this one, each copy of it once, as the second of a pair with `place`; calls
  /// take() whenever near.n is kMost or more, which empties it.
  template <class Take>
  void near(const SceneKernel& kernel, std::uint64_t place, const Vec3d& centre, double radius, NearPairs& near,
            Take&& take) const;

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t kMostAtOnce = 64;
  struct Seat {
    std::uint32_t block = kNone, lane = 0;
  };
  // Of one axis: the cells about a cell, and their images.
  std::span<const CellLayout::Moved> stencil(std::size_t axis, int at) const {
    const std::size_t width = 2 * static_cast<std::size_t>(layout_.stencil[axis]) + 1;
    return std::span(stencils_[axis]).subspan(static_cast<std::size_t>(at) * width, width);
  }
  void take_seat(std::uint32_t block, BodyId body, const Vec3d& centre, double radius);

  CellLayout layout_;
  std::array<std::vector<CellLayout::Moved>, 3> stencils_;  // of all cells along an axis
  ShiftTable shifts_;
  double reach_ = 0.0, farthest_ = 0.0, shift_error_ = 0.0;
  std::vector<BallBlock> blocks_;         // the first of each cell, then others
  std::vector<std::uint32_t> n_, after_;  // of each block: how many balls; the next block of the cell
  std::vector<std::uint32_t> free_;       // blocks that no cell has
  std::vector<Seat> seats_;               // of each body
};

template <class Take>
void BallCells::near(const SceneKernel& kernel, std::uint64_t place, const Vec3d& centre, double radius,
                     NearPairs& near, Take&& take) const {
  const std::array<int, 3> own = layout_.coordinates(centre);
  const std::span<const CellLayout::Moved> xs = stencil(0, own[0]), ys = stencil(1, own[1]), zs = stencil(2, own[2]);
  const std::array<int, 3>& n_images = shifts_.n_images();
  std::array<BallBlockAt, kMostAtOnce> at;
  BallQuery query{at.data(), 0, place, centre, radius + 0x1p-46 * norm_1(centre)};
  const auto ask = [&] {
    kernel.find_in_blocks(query, near);
    query.n = 0;
    if (near.n >= NearPairs::kMost) take();
  };
  for (const CellLayout::Moved& z : zs) {
    if (!z.is_any) continue;
    for (const CellLayout::Moved& y : ys) {
      if (!y.is_any) continue;
      const std::uint32_t row = layout_.number({0, y.cell, z.cell});
      const std::uint32_t shift_of_row = shifts_.number({-n_images[0], y.image, z.image});
      for (const CellLayout::Moved& x : xs) {
        if (!x.is_any) continue;
        std::uint32_t block = row + static_cast<std::uint32_t>(x.cell);
        if (n_[block] == 0) continue;
        const std::uint32_t shift = shift_of_row + static_cast<std::uint32_t>(x.image + n_images[0]);
        for (; block != kNone; block = after_[block]) {
          near.n_seen += n_[block];
          at[query.n++] = {&blocks_[block], shift, shifts_.shift(shift)};
          if (query.n == kMostAtOnce) ask();
        }
      }
    }
  }
  ask();
}

}  // namespace vex
