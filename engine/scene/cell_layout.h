// How a scene's space is cut into cells, and which cells' bodies may be near each other (internal).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/numeric/vec3.h"
#include "engine/scene/aabb.h"
#include "engine/scene/periodic_box.h"

namespace vex {

/// Cells of one size, x first. Two bodies whose centres are no farther apart than `reach`, along each axis, are in
/// cells that are no more than `stencil` apart along each lattice vector. A periodic scene has copies of its cells on
/// all sides: however small the box is, a neighbour is a cell and an image of it.
struct CellLayout {
  std::array<int, 3> n_cells{1, 1, 1}, stencil{1, 1, 1};
  std::array<int, 3> n_images{};  // the images of neighbours are -n ... n
  std::optional<PeriodicBox> box;
  Vec3d origin, cells_a_unit;  // of open space; in a box, of its edges

  /// For some n bodies whose centres are within `bounds`, or in the box, and no farther than `offset` from the origins
  /// of their frames. What rounding adds to the radii of bodies so far out (SortedBodies::fill) is added to `reach`
  /// here. In a triclinic box `reach` is the same along each axis.
  static CellLayout make(const std::optional<PeriodicBox>& box, const Aabb& bounds, double offset, const Vec3d& reach,
                         std::size_t n_bodies);

  std::size_t size() const {
    return static_cast<std::size_t>(n_cells[0]) * static_cast<std::size_t>(n_cells[1]) *
           static_cast<std::size_t>(n_cells[2]);
  }
  std::array<int, 3> coordinates(const Vec3d& centre) const;
  std::uint32_t number(const std::array<int, 3>& cell) const {
    return static_cast<std::uint32_t>(
        (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(n_cells[1]) + static_cast<std::size_t>(cell[1])) *
            static_cast<std::size_t>(n_cells[0]) +
        static_cast<std::size_t>(cell[0]));
  }

  /// A cell moved along one lattice vector, `at` + `by`: the cell it is a copy of, and the image; none outside of open
  /// space.
  struct Moved {
    int cell, image;
    bool is_any;
  };
  Moved moved(std::size_t axis, int at, int by) const;
};

inline std::array<int, 3> CellLayout::coordinates(const Vec3d& centre) const {
  Vec3d at;
  if (box) {
    // PeriodicBox::fractional, times the numbers of cells, without a division.
    const double y = centre.y - centre.z * box->yz();
    const double x = centre.x - y * box->xy() - centre.z * box->xz();
    at = {x * cells_a_unit.x + 0.5 * n_cells[0], y * cells_a_unit.y + 0.5 * n_cells[1],
          centre.z * cells_a_unit.z + 0.5 * n_cells[2]};
  } else {
    const Vec3d from = centre - origin;
    at = {from.x * cells_a_unit.x, from.y * cells_a_unit.y, from.z * cells_a_unit.z};
  }
  const auto cell = [](double x, int n) { return x > 0.0 ? (x < n ? static_cast<int>(x) : n - 1) : 0; };
  return {cell(at.x, n_cells[0]), cell(at.y, n_cells[1]), cell(at.z, n_cells[2])};
}

}  // namespace vex
