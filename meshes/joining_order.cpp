#include "meshes/joining_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <random>

#include "meshes/polyhedron_measures.h"

namespace vex {
namespace {

/// Puts two zero bits between the lowest 21 bits of a number.
std::uint64_t spread(std::uint64_t value) {
  value = (value | value << 32U) & 0x1f00000000ffffU;
  value = (value | value << 16U) & 0x1f0000ff0000ffU;
  value = (value | value << 8U) & 0x100f00f00f00f00fU;
  value = (value | value << 4U) & 0x10c30c30c30c30c3U;
  return (value | value << 2U) & 0x1249249249249249U;
}

}  // namespace

std::vector<std::uint32_t> joining_order(std::span<const Vec3d> points) {
  constexpr int kRounds = 20;
  const double scale = 0x1p20 / bounding_diagonal(points);
  std::mt19937_64 random(points.size());           // the same for the same points
  std::vector<std::array<std::uint64_t, 3>> keys;  // round, place on the curve, vertex
  keys.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3d p = scale * (points[v] - points[0]);
    const auto place = [](double x) { return spread(static_cast<std::uint64_t>(x + 0x1p20)); };
    const int round = kRounds - std::min(std::countr_zero(random()), kRounds);
    keys.push_back({static_cast<std::uint64_t>(round), place(p.x) | place(p.y) << 1U | place(p.z) << 2U, v});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& key : keys) {
    order.push_back(static_cast<std::uint32_t>(key[2]));
  }
  return order;
}

}  // namespace vex
