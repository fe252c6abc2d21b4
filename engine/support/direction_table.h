// The table over the directions of a polytope of many vertices (engine/support/direction_map.h), as the kernels read
// it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/vec3.h"

namespace vex {

/// Polytopes of more vertices are asked by their table of directions: from there on it takes no longer than the scan,
/// and grows no longer (docs/performance.md, "Large hulls").
inline constexpr std::size_t kMostScannedVertices = 32;

/// What it refers to belongs to the body.
///
/// A direction is scaled axis by axis; its largest coordinate picks a face of the cube, and the two others divided by
/// it a place in it. A cell is one number. Where it is divided, the upper half are the upper bits of a double, the
/// width of a block, and the lower half is the place of the block's width * width cells, row by row. Otherwise the
/// upper half is 0 and the lower the place of its list: the vertices of which one is the farthest in each direction of
/// the cell (E17). The cells of the six faces stand first.
struct DirectionTable {
  static constexpr std::uint64_t kWidthBits = 0xffffffff00000000u, kPlaceBits = 0xffffffffu;

  struct alignas(32) Vertex {
    double x, y, z;
    double n_left;  // of its list, itself counted: 1 for the last
  };

  const std::uint64_t* cells = nullptr;
  /// Behind the last list there are as many vertices more as the longest has, and one: from wherever a list begins,
  /// that many can be read, and each is a vertex of the body.
  const Vertex* vertices = nullptr;
  Vec3d scale;  // powers of two
};

}  // namespace vex
