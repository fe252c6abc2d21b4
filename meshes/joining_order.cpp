#include "meshes/joining_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <numeric>
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

/// Places on the grid of the curve by the coordinates: even where the points are.
std::vector<std::array<std::uint32_t, 3>> places_by_length(std::span<const Vec3d> points) {
  const double scale = 0x1p20 / bounding_diagonal(points);
  const auto place = [](double x) { return static_cast<std::uint32_t>(x + 0x1p20); };
  std::vector<std::array<std::uint32_t, 3>> places;
  places.reserve(points.size());
  for (const Vec3d& v : points) {
    const Vec3d p = scale * (v - points[0]);
    places.push_back({place(p.x), place(p.y), place(p.z)});
  }
  return places;
}

/// By how many points are lower along each axis: crowds that one cell of the other grid would hold are spread, too.
std::vector<std::array<std::uint32_t, 3>> places_by_rank(std::span<const Vec3d> points) {
  const unsigned n_too_many_bits =
      static_cast<unsigned>(std::max(0, static_cast<int>(std::bit_width(points.size())) - 21));
  std::vector<std::array<std::uint32_t, 3>> places(points.size());
  std::vector<std::uint32_t> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = [&](std::uint32_t v) { return axis == 0 ? points[v].x : axis == 1 ? points[v].y : points[v].z; };
    std::ranges::stable_sort(sorted, {}, along);
    std::uint32_t rank = 0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      if (k > 0 && along(sorted[k]) != along(sorted[k - 1])) rank = static_cast<std::uint32_t>(k);
      places[sorted[k]][axis] = rank >> n_too_many_bits;
    }
  }
  return places;
}

}  // namespace

std::vector<std::uint32_t> joining_order(std::span<const Vec3d> points, std::uint64_t which) {
  constexpr int kRounds = 20;
  const std::vector<std::array<std::uint32_t, 3>> places =
      which == 0 ? places_by_length(points) : places_by_rank(points);
  std::mt19937_64 random(points.size() + (which << 32U));
  std::vector<std::array<std::uint64_t, 3>> keys;  // round, place on the curve, vertex
  keys.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto& [x, y, z] = places[v];
    const int round = kRounds - std::min(std::countr_zero(random()), kRounds);
    keys.push_back({static_cast<std::uint64_t>(round), spread(x) | spread(y) << 1U | spread(z) << 2U, v});
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
