// The corners of a polytope by number, and the number of each: what a search remembers of a corner that it has met. Any
// number below `size` is that of a point of the body, so nothing that was remembered need be believed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

class CornerTable {
 public:
  /// More corners than these have no numbers: the table is empty.
  static constexpr std::size_t kMost = 0xffff;

  /// They must outlive the table.
  explicit CornerTable(std::span<const Vec3d> corners);

  std::size_t size() const { return corners_.size(); }
  const Vec3d& operator[](std::size_t number) const { return corners_[number]; }
  /// Of a corner, coordinate for coordinate; none of another point.
  std::optional<std::uint16_t> number_of(const Vec3d& corner) const;

 private:
  std::span<const Vec3d> corners_;
  std::vector<std::uint32_t> slots_;  // numbers plus one, by what is made of the coordinates; a power of two of them
};

}  // namespace vex
