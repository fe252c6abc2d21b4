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
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

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
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const;

  std::size_t bytes() const { return sizeof(double) * (blocks_.capacity() + lists_.capacity()); }

 private:
  friend class DirectionMapBuilder;

  /// Where a direction is in the table: the body is looked at as if it were as long along each axis, up to a factor of
  /// two, so that a needle's cells are no needles. Powers of two change no product of a vertex with a direction.
  template <class L>
  Vec3<L> scaled(const Vec3<L>& dir) const {
    return {L(scale_.x) * dir.x, L(scale_.y) * dir.y, L(scale_.z) * dir.z};
  }

  // All numbers are doubles, so that a packet can gather them. A cell is one number: where it is divided, the place of
  // a block, which begins with a width and goes on with width * width cells, row by row; and otherwise minus the place
  // of a list, which begins with a count and goes on with x, y, z of so many vertices, in the order in which they were
  // given. The cells of the six faces stand first. No list begins at place 0.
  std::vector<double> blocks_;
  std::vector<double> lists_;
  Vec3d scale_{1.0, 1.0, 1.0};
  double least_size_ = 0.0;
  double largest_size_ = -1.0;
};

namespace direction_map_detail {

/// The largest whole number up to q, for 0 <= q < width; the last cell for q = width, and for a NaN.
template <class L>
L cell_of(L q, L width) {
  const L nearest = nearest_whole(q);
  const L below = select(nearest > q, nearest - L(1.0), nearest);
  return select(q < width, below, width - L(1.0));
}

}  // namespace direction_map_detail

template <class L>
Vec3<L> DirectionMap::support(const Vec3<L>& dir) const {
  const Vec3<L> place = scaled(dir);
  const L size_x = absolute(place.x), size_y = absolute(place.y);
  const L size = larger(size_x, larger(size_y, absolute(place.z)));
  const MaskOf<L> is_x = size_x >= size;
  const MaskOf<L> is_y = but_not(size_y >= size, is_x);
  const L major = select(is_x, place.x, select(is_y, place.y, place.z));
  const L half = L(0.5) / size;
  // (s + 1)/2 and (t + 1)/2, in [0, 1] also when rounded (E17).
  L p = L(0.5) + half * select(is_x, place.y, select(is_y, place.z, place.x));
  L q = L(0.5) + half * select(is_x, place.z, select(is_y, place.x, place.y));
  L cell = select(is_x, L(0.0), select(is_y, L(2.0), L(4.0))) + select(major < L(0.0), L(1.0), L(0.0));
  cell = gather(blocks_.data(), cell);
  for (MaskOf<L> is_divided = cell > L(0.0); any(is_divided); is_divided = cell > L(0.0)) {
    const L block = select(is_divided, cell, L(0.0));
    const L width = gather(blocks_.data(), block);
    // Exact, the width being a power of two.
    p = p * width;
    q = q * width;
    const L column = direction_map_detail::cell_of(p, width);
    const L row = direction_map_detail::cell_of(q, width);
    p = p - column;
    q = q - row;
    const L inner = gather(blocks_.data() + 1, select(is_divided, block + (row * width + column), L(0.0)));
    cell = select(is_divided, inner, cell);
  }

  const L list = -cell;
  const auto vertex = [&](std::size_t k, const L& at) {
    const double* const table = lists_.data() + 3 * k + 1;
    return Vec3<L>{gather(table, at), gather(table + 1, at), gather(table + 2, at)};
  };
  Vec3<L> best = vertex(0, list);
  L best_value = dot(best, dir);
  L n_left = gather(lists_.data(), list) - L(1.0);
  MaskOf<L> is_left = n_left > L(0.0);
  for (std::size_t k = 1; any(is_left); ++k) {
    // Lanes whose lists have ended look at what stands at the beginning of the table, which is as long.
    const Vec3<L> next = vertex(k, select(is_left, list, L(0.0)));
    const L value = dot(next, dir);
    const MaskOf<L> better = both(is_left, value > best_value);
    best_value = select(better, value, best_value);
    best = select(better, next, best);
    n_left = n_left - L(1.0);
    is_left = n_left > L(0.0);
  }
  return best;
}

/// One direction: the same steps in whole numbers, which take half as long.
template <>
inline Vec3d DirectionMap::support(const Vec3d& dir) const {
  const Vec3d place = scaled(dir);
  const std::array<double, 5> along = {place.x, place.y, place.z, place.x, place.y};
  const double size_x = absolute(place.x), size_y = absolute(place.y);
  const double size = larger(size_x, larger(size_y, absolute(place.z)));
  const std::size_t axis = size_x >= size ? 0 : (size_y >= size ? 1 : 2);
  const double half = 0.5 / size;
  double p = 0.5 + half * along[axis + 1];
  double q = 0.5 + half * along[axis + 2];
  double cell = blocks_[2 * axis + (along[axis] < 0.0 ? 1 : 0)];
  while (cell > 0.0) {
    const double* const block = blocks_.data() + static_cast<std::size_t>(cell);
    const double width = block[0], last = width - 1.0;
    p = p * width;
    q = q * width;
    // A NaN gives the last cell, as above.
    const double column = p < last ? static_cast<double>(static_cast<int>(p)) : last;
    const double row = q < last ? static_cast<double>(static_cast<int>(q)) : last;
    p = p - column;
    q = q - row;
    cell = block[1 + static_cast<std::size_t>(row * width + column)];
  }
  const double* const list = lists_.data() + static_cast<std::size_t>(-cell);
  const double* const end = list + 1 + 3 * static_cast<std::size_t>(list[0]);
  const double* best = list + 1;
  double best_value = dot(Vec3d{best[0], best[1], best[2]}, dir);
  for (const double* next = best + 3; next != end; next += 3) {
    const double value = dot(Vec3d{next[0], next[1], next[2]}, dir);
    best = value > best_value ? next : best;
    best_value = value > best_value ? value : best_value;
  }
  return {best[0], best[1], best[2]};
}

}  // namespace vex
