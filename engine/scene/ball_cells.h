// Grids of cells that hold their bodies' balls: for queries of one body at a time, between which bodies come, go and
// move (internal).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/cell_layout.h"
#include "engine/scene/large_vector.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/scene_kernel.h"
#include "engine/scene/shift_table.h"

namespace vex {

/// One grid. Holds circumscribed balls, those of a cell in blocks that a kernel reads; or the boxes of bodies of one
/// shape none of which is turned: then radii are what rounding adds, and no more.
class BallCells {
 public:
  /// For queries of balls whose centres are up to `reach` apart; with cells for so many bodies, whose centres are
  /// within `bounds`, or in the box, and no farther than `farthest` from the origin, as those of the queries.
  void lay_out(const std::optional<PeriodicBox>& box, const Aabb& bounds, double farthest, double reach,
               std::size_t n_bodies);
  /// The same for queries of boxes of these extents. A periodic box is not triclinic.
  void lay_out_upright(const std::optional<PeriodicBox>& box, const Aabb& bounds, double farthest, const Vec3d& extents,
                       std::size_t n_bodies);
  /// The images that its queries look at: -n ... n along each lattice vector.
  const std::array<int, 3>& n_images() const { return layout_.n_images; }
  /// Empty cells of the layout. The table, which has all its images or more, must stay where it is.
  void begin(const ShiftTable& shifts);

  void add(const SceneBodies& bodies, BodyId body);
  /// There are no bodies; the cells stay.
  void clear();
  /// Of what was added; other bodies are where they were then.
  void remove(const SceneBodies& bodies, BodyId body);
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
    std::uint32_t first = kNone;  // the cell's first block
  };
  // How many balls a block has, and the next block of the cell.
  struct Link {
    std::uint32_t n = 0, after = kNone;
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
  void write_ball(BallBlock& balls, std::uint32_t lane, const SceneBodies& bodies, BodyId body) const;
  // A length in units, and what floats may be off (E26); infinite where it is too large for a float.
  float rounded_up(double length) const { return static_cast<float>(length * units_ * (1.0 + 0x1p-18) + 0x1p-60); }

  CellLayout layout_;
  double units_ = 1.0;                           // a length of 1 is so many: a power of two
  std::optional<std::array<float, 3>> extents_;  // of boxes, in units
  std::array<int, 3> merged_{};                  // along each axis: 1 where two cells are held as one, else 0
  std::array<std::uint32_t, 3> held_stride_{};
  std::size_t n_held_ = 0;
  std::array<Stencil, 3> stencils_;
  const ShiftTable* shifts_ = nullptr;
  double largest_shift_ = 0.0;       // as ShapeBounds::rounding_at counts it
  LargeVector<BallBlock> blocks_;    // the first of each cell, then others
  LargeVector<Link> links_;          // of each block
  std::vector<std::uint32_t> free_;  // blocks that no cell has
  LargeVector<Seat> seats_;          // of each body
};

template <class Take>
void BallCells::near(const SceneKernel& kernel, std::uint64_t place, const Vec3d& centre, double radius,
                     NearPairs& near, Take&& take) const {
  const std::array<int, 3> own = layout_.coordinates(centre);
  const std::span<const Step> xs = stencils_[0].about(own[0]);
  std::array<BallBlockAt, kMostAtOnce> at;
  BallQuery query{blocks_.data(),
                  shifts_->rows(),
                  at.data(),
                  0,
                  place,
                  centre,
                  units_,
                  rounded_up(radius + 0x1p-46 * norm_1(centre)),
                  extents_ ? extents_->data() : nullptr};
  const auto ask = [&](std::size_t n_blocks, std::uint64_t n_balls) {
    near.n_seen += n_balls;
    query.n = n_blocks;
    kernel.find_in_blocks(query, near);
    if (near.n >= NearPairs::kMost) take();
  };
  // No local variable of the loop is known to `ask`, so that they stay in registers.
  const Link* const links = links_.data();
  std::uint64_t n_seen = 0;
  std::size_t n = 0;
  for (const Step& z : stencils_[2].about(own[2])) {
    for (const Step& y : stencils_[1].about(own[1])) {
      const std::uint32_t row = z.holder + y.holder, shift_of_row = z.shift + y.shift;
      for (const Step& x : xs) {
        // Whether it is empty is as good as random: written in any case, it needs no branch.
        std::uint32_t block = row + x.holder;
        const std::uint32_t shift = shift_of_row + x.shift;
        Link link = links[block];
        n_seen += link.n;
        at[n] = {block, shift};
        n += link.n != 0 ? 1u : 0u;
        while (true) {
          if (n == kMostAtOnce) {
            ask(n, n_seen);
            n = 0;
            n_seen = 0;
          }
          block = link.after;
          if (block == kNone) break;
          link = links[block];
          n_seen += link.n;
          at[n++] = {block, shift};
        }
      }
    }
  }
  ask(n, n_seen);
}

/// The balls of all bodies of a scene. Bodies of like size make a class, and of each class there is one grid for the
/// queries of each class: a small body looks for small ones in small cells only, wherever a large one may be.
class BallCellsOfScene {
 public:
  /// For queries of bodies of these shapes and of those that the scene has, whose centres are no farther than
  /// `farthest` from the origin and no farther than `offset` from the origins of their frames. `n_expected`: with cells
  /// for so many bodies and for all shapes, whatever the scene has; 0: for the bodies that are there. Where none of
  /// them is turned the cells are for such bodies alone, if `may_be_upright`.
  void build(const SceneBodies& bodies, double farthest, double offset, std::size_t n_expected, bool may_be_upright);
  /// Whether rounding is allowed for as far out as this, in the 1-norm: of a body or of a query. In a box it always is.
  bool goes_as_far_as(double distance) const { return in_box_ || distance <= farthest_; }
  const ShiftTable& shifts() const { return shifts_; }

  void add(const SceneBodies& bodies, BodyId body);
  void remove(const SceneBodies& bodies, BodyId body);
  /// There are no bodies; the cells stay.
  void clear();
  /// Whether they are for bodies that are not turned alone.
  bool are_upright() const { return are_upright_; }
  /// Whether the cells are large enough for such a radius; nothing is before the first `build`.
  bool takes(double radius) const { return !largest_.empty() && radius <= largest_.front(); }
  /// ... and for the body, and for what rounding does where it is. Else where it is does not matter: in open space the
  /// outermost cells hold what is beyond them, since no two points are farther apart there than the points themselves.
  bool takes(const SceneBodies& bodies, BodyId body) const;

  /// BallCells::near of all bodies, for one of a shape that the cells take, at this centre.
  template <class Take>
  void near(const SceneKernel& kernel, std::uint64_t place, const Vec3d& centre, const ShapeBounds& bounds,
            NearPairs& near, Take&& take) const {
    // Widened as the held ones are, but for the shifts, which these allow for.
    const double radius = (are_upright_ ? 0.0 : bounds.radius) + bounds.rounding_at(centre);
    const std::size_t n = largest_.size(), asking = class_of(bounds.radius);
    for (std::size_t held = 0; held < n; ++held) {
      grids_[asking * n + held].near(kernel, place, centre, radius, near, take);
    }
  }

 private:
  void make_classes(const SceneBodies& bodies, bool are_expected);
  std::size_t class_of(double radius) const {
    std::size_t k = 0;
    while (k + 1 < largest_.size() && radius <= largest_[k + 1]) ++k;
    return k;
  }

  std::vector<double> largest_;   // radius of each class, from large to small
  std::vector<BallCells> grids_;  // of each class that asks, one of each that is held
  ShiftTable shifts_;
  double farthest_ = 0.0;
  bool in_box_ = false, are_upright_ = false;
  // Of `build`, which keeps its memory.
  std::vector<bool> is_there_;                 // of each shape
  std::vector<std::size_t> n_bodies_;          // of each class
  std::array<std::vector<double>, 3> sample_;  // of bounds_of_most
};

}  // namespace vex
