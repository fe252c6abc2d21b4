// The sides of many triangles at once, as columns of rays: what the kernels make, bit for bit those of TriangleMap.
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/radial/radial_packets.h"
#include "engine/sampling/virial/triangle_map.h"

namespace vex {

/// Points of the unit cube, coordinate by coordinate, and what becomes of them. Triangles are made kGrain at once, so
/// that no register full of them ends in the midst.
struct TriangleColumns {
  static constexpr std::size_t kGrain = 16, kTriangles = 80, kStride = PacketRays::kStride;
  static_assert(3 * kTriangles <= PacketRays::kMostRays && kTriangles % kGrain == 0);

  alignas(64) double coordinates[TriangleMap::kMaxDimension][kTriangles] = {};
  alignas(64) double rays[RayTable::kColumns][kStride] = {};  // side e of triangle k of n: row e n + k
  alignas(64) double weights[kTriangles] = {};
  alignas(64) double picks[kTriangles] = {};

  RayTable table(std::size_t n) const { return {rays[0], kStride, 3 * n}; }
};

/// n: a multiple of kGrain, up to kTriangles.
using MakeTriangles = void (*)(const TriangleMap& map, std::size_t n, TriangleColumns& columns);

/// One after the other where there is no kernel: for `scalar`.
MakeTriangles triangle_maker(InstructionSet set);

namespace sse2 {
void make_triangles(const TriangleMap& map, std::size_t n, TriangleColumns& columns);
}
namespace avx2 {
void make_triangles(const TriangleMap& map, std::size_t n, TriangleColumns& columns);
}
namespace avx512 {
void make_triangles(const TriangleMap& map, std::size_t n, TriangleColumns& columns);
}

/// A packet of L after the other.
template <class L, class Load, class Store>
void make_triangles_over(const TriangleMap& map, std::size_t n, TriangleColumns& columns, const Load& load,
                         const Store& store) {
  const auto dimension = static_cast<std::size_t>(map.dimension());
  constexpr auto kWidth = static_cast<std::size_t>(LaneTraits<L>::width);
  static_assert(TriangleColumns::kGrain % kWidth == 0);
  for (std::size_t k = 0; k < n; k += kWidth) {
    std::array<L, TriangleMap::kMaxDimension> point;
    for (std::size_t c = 0; c < dimension; ++c) point[c] = load(columns.coordinates[c] + k);
    const Triangle<L> triangle = map(std::span<const L>(point));
    for (std::size_t e = 0; e < 3; ++e) {
      const TriangleSide<L>& side = triangle.sides[e];
      const auto put = [&](std::size_t column, const Vec3<L>& v) {
        double* const to = columns.rays[column] + e * n + k;
        store(to, v.x);
        store(to + TriangleColumns::kStride, v.y);
        store(to + 2 * TriangleColumns::kStride, v.z);
      };
      put(0, side.rotation.row_x);
      put(3, side.rotation.row_y);
      put(6, side.rotation.row_z);
      put(RayTable::kDirection, side.dir);
      for (std::size_t j = 0; j < 3; ++j) put(RayTable::kNormals + 3 * j, side.normals[j]);
    }
    store(columns.weights + k, triangle.weight);
    store(columns.picks + k, triangle.pick);
  }
}

}  // namespace vex
