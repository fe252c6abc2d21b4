#include "engine/support/vertex_columns.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace vex {
namespace {

// Beyond this differences of coordinates may overflow.
constexpr double kLargestCoordinate = 0x1p1000;
constexpr int kLargestExponent = 1000;
// No axis is stretched so far that coordinates along it become more than this power of two times their spread: what is
// lost to rounding grows with them.
constexpr int kFarthestOff = 20;

}  // namespace

VertexColumns without_repetitions(std::span<const double> x, std::span<const double> y, std::span<const double> z) {
  std::vector<std::uint32_t> order(x.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (x[a] != x[b]) return x[a] < x[b];
    if (y[a] != y[b]) return y[a] < y[b];
    return z[a] != z[b] ? z[a] < z[b] : a < b;
  });
  std::vector<bool> is_repeated(x.size(), false);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::uint32_t a = order[k - 1], b = order[k];
    is_repeated[b] = x[a] == x[b] && y[a] == y[b] && z[a] == z[b];
  }
  VertexColumns all;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (is_repeated[i]) continue;
    all[0].push_back(x[i]);
    all[1].push_back(y[i]);
    all[2].push_back(z[i]);
  }
  return all;
}

std::optional<std::array<int, 3>> lengths_along(const VertexColumns& columns) {
  std::array<int, 3> lengths{};
  std::array<double, 3> farthest{};
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax_element(columns[axis].begin(), columns[axis].end());
    farthest[axis] = std::max(std::fabs(*least), std::fabs(*most));
    if (!(farthest[axis] <= kLargestCoordinate)) return std::nullopt;
    const double length = *most - *least;
    longest = std::max(longest, length > 0.0 ? length : 0x1p-1074);
    lengths[axis] = length > 0.0 ? std::ilogb(length) : INT_MIN;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (lengths[axis] == INT_MIN) lengths[axis] = std::ilogb(longest);
    if (farthest[axis] > 0.0) lengths[axis] = std::max(lengths[axis], std::ilogb(farthest[axis]) - kFarthestOff);
    lengths[axis] = std::clamp(lengths[axis], -kLargestExponent, kLargestExponent);
  }
  return lengths;
}

}  // namespace vex
