// Which of many vertices may be the farthest in some direction of a small cell of directions: what a direction map is
// made with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vex {

/// Vertices in the axes of a face of the cube of directions: `w` along the face's outer normal, `y` and `z` in it.
struct VertexList {
  std::vector<double> w, y, z;

  std::size_t size() const { return w.size(); }
  void resize(std::size_t n) {
    w.resize(n);
    y.resize(n);
    z.resize(n);
  }
  void copy_to(std::size_t at, std::size_t i, VertexList* to) const {
    to->w[at] = w[i];
    to->y[at] = y[i];
    to->z[at] = z[i];
  }
};

/// The directions (1, s, t) with s and t in [s0, s0 + width] and [t0, t0 + width], in a face's axes. All of these are
/// multiples of powers of two within [-1, 1], and exact.
struct DirectionCell {
  double s0 = -1.0, t0 = -1.0, width = 2.0;
  bool is_face() const { return width == 2.0; }
};

/// A cell is looked at as a grid of kCellGrid * kCellGrid parts, row by row, s growing within a row.
inline constexpr std::size_t kCellGrid = 4;
inline constexpr std::size_t kCellParts = kCellGrid * kCellGrid;

/// Coordinates w, y, z are taken times `scale`, powers of two.
///
/// Of each vertex the parts of the cell, a bit each, in which it may have the largest computed product with some
/// direction. A part is left out only by proof: one vertex of the list beats this one in all directions of the part, by
/// more than `margin` less the roundings made here (E17).
void find_contenders(const VertexList& list, const DirectionCell& cell, const std::array<double, 3>& scale,
                     double margin, std::vector<std::uint32_t>* parts_of_each);

}  // namespace vex
