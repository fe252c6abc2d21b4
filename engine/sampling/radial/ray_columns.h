// The rays of many points at once, as columns: what the kernels make, bit for bit those of RadialMap.
#pragma once

#include <cstddef>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/radial/radial_map.h"
#include "engine/sampling/radial/radial_packets.h"

namespace vex {

/// Up to kMostRays points of the unit cube, coordinate by coordinate, and what becomes of them.
struct RayColumns {
  static constexpr std::size_t kStride = PacketRays::kStride;

  alignas(64) double coordinates[RadialNumbers::kMaxDimension][kStride] = {};
  alignas(64) double rays[RayTable::kColumns][kStride] = {};
  alignas(64) double weights[kStride] = {};

  RayTable table(std::size_t n) const { return {rays[0], kStride, n}; }
};

using MakeRays = void (*)(const RadialNumbers& map, std::size_t n, RayColumns& columns);

/// One point after the other where there is no kernel: for `scalar`.
MakeRays ray_maker(InstructionSet set);

namespace sse2 {
void make_rays(const RadialNumbers& map, std::size_t n, RayColumns& columns);
}
namespace avx2 {
void make_rays(const RadialNumbers& map, std::size_t n, RayColumns& columns);
}
namespace avx512 {
void make_rays(const RadialNumbers& map, std::size_t n, RayColumns& columns);
}

/// The rays of packets of L, a packet after the other. There is room for a packet behind the last.
template <class L, class Load, class Store>
void make_rays_over(const RadialNumbers& map, std::size_t n, RayColumns& columns, const Load& load,
                    const Store& store) {
  const auto dimension = static_cast<std::size_t>(map.dimension());
  constexpr auto kWidth = static_cast<std::size_t>(LaneTraits<L>::width);
  for (std::size_t k = 0; k < n; k += kWidth) {
    std::array<L, RadialNumbers::kMaxDimension> point;
    for (std::size_t c = 0; c < dimension; ++c) point[c] = load(columns.coordinates[c] + k);
    const RadialRay<L> ray = map(std::span<const L>(point));
    std::size_t column = 0;
    const auto put = [&](const Vec3<L>& v) {
      store(columns.rays[column++] + k, v.x);
      store(columns.rays[column++] + k, v.y);
      store(columns.rays[column++] + k, v.z);
    };
    put(ray.rotation.row_x);
    put(ray.rotation.row_y);
    put(ray.rotation.row_z);
    put(ray.dir);
    store(columns.rays[column++] + k, ray.pick);
    for (const Vec3<L>& normal : ray.normals) put(normal);
    store(columns.weights + k, ray.weight);
  }
}

}  // namespace vex
