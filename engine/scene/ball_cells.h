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
  /// For queries of balls whose centres are up to `reach` apart; with cells for so many bodies, whose centres are no
  /// farther than `offset` from the origins of their frames.
  void build(const SceneBodies& bodies, double reach, double farthest, double offset, std::size_t n_bodies);
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
  // A step along one axis from a cell to one about it: what the numbers of its holder and of a shift are sums of.
  struct Step {
    std::uint32_t holder, shift;
    friend bool operator==(const Step&, const Step&) = default;
  };
  // All cells along an axis: the steps from the cell `at` are first[at] ... first[at + 1] - 1.
  struct Stencil {
    std::vector<Step> steps;
    std::vector<std::uint32_t> first;
    std::span<const Step> about(int at) const {
      const std::size_t k = static_cast<std::size_t>(at);
      return {steps.data() + first[k], steps.data() + first[k + 1]};
    }
  };
  void make_stencil(std::size_t axis);
  void merge_cells(std::size_t n_bodies);
  // The number of the first block of the cell, or of the cells that are held as one.
  std::uint32_t holder_of(const Vec3d& centre) const;
  void take_seat(std::uint32_t block, BodyId body, const Vec3d& centre, double radius);

  CellLayout layout_;
  std::array<int, 3> merged_{};  // along each axis: 1 where two cells are held as one, else 0
  std::array<std::uint32_t, 3> held_stride_{};
  std::size_t n_held_ = 0;
  std::array<Stencil, 3> stencils_;
  ShiftTable shifts_;
  double reach_ = 0.0, farthest_ = 0.0, shift_error_ = 0.0;
  std::vector<BallBlock> blocks_;              // the first of each cell, then others
  std::vector<std::uint32_t> n_, after_;       // of each block: how many balls; the next block of the cell
  std::vector<std::uint32_t> free_;            // blocks that no cell has
  std::array<std::vector<double>, 3> sample_;  // of bounds_of_most
  std::vector<Seat> seats_;                    // of each body
};

template <class Take>
void BallCells::near(const SceneKernel& kernel, std::uint64_t place, const Vec3d& centre, double radius,
                     NearPairs& near, Take&& take) const {
  const std::array<int, 3> own = layout_.coordinates(centre);
  const std::span<const Step> xs = stencils_[0].about(own[0]);
  std::array<BallBlockAt, kMostAtOnce> at;
  BallQuery query{blocks_.data(), shifts_.rows(), at.data(), 0, place, centre, radius + 0x1p-46 * norm_1(centre)};
  std::uint64_t n_seen = 0;
  std::size_t n = 0;
  const auto ask = [&] {
    near.n_seen += n_seen;
    n_seen = 0;
    query.n = n;
    kernel.find_in_blocks(query, near);
    n = 0;
    if (near.n >= NearPairs::kMost) take();
  };
  for (const Step& z : stencils_[2].about(own[2])) {
    for (const Step& y : stencils_[1].about(own[1])) {
      const std::uint32_t row = z.holder + y.holder, shift_of_row = z.shift + y.shift;
      for (const Step& x : xs) {
        // Whether it is empty is as good as random: written in any case, it needs no branch.
        std::uint32_t block = row + x.holder;
        const std::uint32_t shift = shift_of_row + x.shift;
        n_seen += n_[block];
        at[n] = {block, shift};
        n += n_[block] != 0 ? 1u : 0u;
        while (true) {
          if (n == kMostAtOnce) ask();
          block = after_[block];
          if (block == kNone) break;
          n_seen += n_[block];
          at[n++] = {block, shift};
        }
      }
    }
  }
  ask();
}

}  // namespace vex
