// The farthest of many vertices by a table over the directions: a support mapping whose cost hardly grows with them.
//
// A direction is projected onto the surface of a cube: its largest coordinate picks the face, the two others divided by
// it are s and t in [-1, 1]. Each face is divided into cells, finer where the answer changes faster. A cell keeps every
// vertex that may have the largest computed product with some direction of the cell; all others are proven to be beaten
// by one vertex at all four corners of the cell, and so in between, by more than rounding can make up for (E17). What
// is kept is scanned. So the answer is that of a scan over all vertices, bit for bit, also where vertices tie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/direction_table.h"
#include "engine/support/first_farthest.h"

namespace vex {

class DirectionMap {
 public:
  /// The table is a copy: the coordinates are not referred to later. At least one vertex, all finite.
  DirectionMap(std::span<const double> x, std::span<const double> y, std::span<const double> z);

  /// Whether `support` answers directions of this size: those that are neither so small beside the body that products
  /// underflow, nor so large that they overflow. Not for infinite coordinates. A NaN may be taken, and gives any
  /// vertex.
  template <class L>
  MaskOf<L> takes(const Vec3<L>& dir) const {
    const Vec3<L> place = scaled(dir);
    const L size = larger(absolute(place.x), larger(absolute(place.y), absolute(place.z)));
    return both(size >= L(least_size_), size <= L(largest_size_));
  }

  /// The first of the vertices whose computed product with `dir`, which `takes` must accept, is the largest.
  Vec3d support(const Vec3d& dir) const;

  /// For the kernels; none where they could ask for a direction that `takes` does not accept, or where a list is very
  /// long.
  std::optional<DirectionTable> table() const;

  std::size_t bytes() const { return sizeof cells_[0] * cells_.capacity() + sizeof lists_[0] * lists_.capacity(); }

 private:
  friend class DirectionMapBuilder;

  /// Where a direction is in the table: the body is looked at as if it were as long along each axis, up to a factor of
  /// two, so that a needle's cells are no needles. Powers of two change no product of a vertex with a direction.
  template <class L>
  Vec3<L> scaled(const Vec3<L>& dir) const {
    return {L(scale_.x) * dir.x, L(scale_.y) * dir.y, L(scale_.z) * dir.z};
  }

  using Vertex = DirectionTable::Vertex;
  static std::uint64_t cell_of_block(double width, std::size_t place) { return bits_of(width) | place; }

  // As DirectionTable tells. The vertices of a list stand in the order in which they were given.
  std::vector<std::uint64_t> cells_;
  std::vector<Vertex> lists_;
  Vec3d scale_{1.0, 1.0, 1.0};
  std::size_t longest_list_ = 0;
  double least_size_ = 0.0;
  double largest_size_ = -1.0;
};

inline Vec3d DirectionMap::support(const Vec3d& dir) const {
  const Vec3d place = scaled(dir);
  const std::array<double, 5> along = {place.x, place.y, place.z, place.x, place.y};
  const double size_x = absolute(place.x), size_y = absolute(place.y);
  const double size = larger(size_x, larger(size_y, absolute(place.z)));
  // 0, 1 or 2, without a jump: nothing foretells which.
  const std::size_t axis = std::size_t{size_x < size} << std::size_t{size_y < size};
  const double half = 0.5 / size;
  // (s + 1)/2 and (t + 1)/2, in [0, 1] also when rounded (E17).
  double p = 0.5 + half * along[axis + 1];
  double q = 0.5 + half * along[axis + 2];
  std::uint64_t cell = cells_[2 * axis + (along[axis] < 0.0 ? 1 : 0)];
  while (cell > DirectionTable::kPlaceBits) {
    const double width = from_bits(cell & DirectionTable::kWidthBits), last = width - 1.0;
    // Exact, the width being a power of two.
    p = p * width;
    q = q * width;
    // The largest whole number up to p; the last cell for p = width, and for a NaN.
    const double column = static_cast<double>(static_cast<int>(smaller(p, last)));
    const double row = static_cast<double>(static_cast<int>(smaller(q, last)));
    p = p - column;
    q = q - row;
    cell = cells_[(cell & DirectionTable::kPlaceBits) + static_cast<std::size_t>(row * width + column)];
  }
  const Vertex* const kept = lists_.data() + cell;
  const auto vertex = [kept](std::uint64_t k) { return Vec3d{kept[k].x, kept[k].y, kept[k].z}; };
  return vertex(first_farthest(static_cast<std::uint64_t>(kept->n_left), dir, vertex));
}

}  // namespace vex
