#include "engine/support/corner_table.h"

#include <bit>

namespace vex {
namespace {

bool are_same(const Vec3d& p, const Vec3d& q) { return p.x == q.x && p.y == q.y && p.z == q.z; }

// Of equal coordinates the same, and -0 equals 0. After T. Mueller's and D. Stafford's mixing of bits.
std::uint64_t mixed(const Vec3d& p) {
  std::uint64_t hash = 0;
  for (const double x : {p.x, p.y, p.z}) {
    hash = (hash ^ bits_of(x + 0.0)) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace

CornerTable::CornerTable(std::span<const Vec3d> corners) : corners_(corners) {
  if (corners_.size() > kMost) corners_ = {};
  slots_.assign(std::bit_ceil(2 * corners_.size() + 1), 0);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t k = 0; k < corners_.size(); ++k) {
    std::size_t slot = mixed(corners_[k]) & mask;
    while (slots_[slot] != 0 && !are_same(corners_[slots_[slot] - 1], corners_[k])) slot = (slot + 1) & mask;
    if (slots_[slot] == 0) slots_[slot] = k + 1;
  }
}

std::optional<std::uint16_t> CornerTable::number_of(const Vec3d& corner) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = mixed(corner) & mask; slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (are_same(corners_[slots_[slot] - 1], corner)) return static_cast<std::uint16_t>(slots_[slot] - 1);
  }
  return std::nullopt;
}

}  // namespace vex
