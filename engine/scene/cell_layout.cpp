#include "engine/scene/cell_layout.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

// Cells a body: more cells than this cost more than they spare.
constexpr double kMostCellsABody = 2.0;
constexpr double kThinnest = 0.25;

double volume(const Vec3d& edges) { return edges.x * edges.y * edges.z; }

}  // namespace

CellLayout CellLayout::make(const std::optional<PeriodicBox>& box, const Aabb& bounds, double offset,
                            const Vec3d& reach, std::size_t n_bodies) {
  CellLayout layout;
  layout.box = box;
  Vec3d extent = box ? box->face_distances() : bounds.upper - bounds.lower;
  // Of coordinates and of shifts: of up to 32 boxes.
  const double farthest =
      box ? 64.0 * box->largest_coordinate() : std::fmax(norm_1(bounds.lower), norm_1(bounds.upper)) + norm_1(extent);
  // The radii's own terms, and that a centre is put into its cell, or into the next one, by rounding.
  // What the bodies are thin along needs cells no thinner than a part of what they are longest along.
  const double least = kThinnest * std::fmax(reach.x, std::fmax(reach.y, reach.z));
  const auto needed_for = [&](double along) {
    return std::fmax(along, least) * (1.0 + 0x1p-20) + 0x1p-44 * (farthest + offset) + 0x1p-490;
  };
  const Vec3d needed{needed_for(reach.x), needed_for(reach.y), needed_for(reach.z)};
  Vec3d width = needed;
  if (!box) extent = {std::fmax(extent.x, width.x), std::fmax(extent.y, width.y), std::fmax(extent.z, width.z)};
  const double most = std::fmax(kMostCellsABody * static_cast<double>(n_bodies), 8.0);
  const auto cells = [&](const Vec3d& w) {
    const auto along = [](double e, double its_width) { return std::fmax(std::floor(e / its_width), 1.0); };
    return Vec3d{along(extent.x, w.x), along(extent.y, w.y), along(extent.z, w.z)};
  };
  while (volume(cells(width)) > most) width = 1.1 * width;
  const Vec3d n = cells(width);
  const double along[3] = {n.x, n.y, n.z}, edges[3] = {extent.x, extent.y, extent.z},
               needs[3] = {needed.x, needed.y, needed.z};
  for (std::size_t k = 0; k < 3; ++k) {
    layout.n_cells[k] = static_cast<int>(along[k]);
    const double of_cell = edges[k] / along[k];
    layout.stencil[k] = std::max(1, static_cast<int>(std::ceil(needs[k] / of_cell)));
    layout.n_images[k] = box ? (layout.stencil[k] + layout.n_cells[k] - 1) / layout.n_cells[k] : 0;
  }
  layout.origin = bounds.lower;
  if (box) extent = box->edges();
  layout.cells_a_unit = {n.x / extent.x, n.y / extent.y, n.z / extent.z};
  return layout;
}

CellLayout::Moved CellLayout::moved(std::size_t axis, int at, int by) const {
  const int n = n_cells[axis];
  int cell = at + by, image = 0;
  if (cell >= 0 && cell < n) return {cell, 0, true};
  if (!box) return {0, 0, false};
  while (cell < 0) cell += n, --image;
  while (cell >= n) cell -= n, ++image;
  return {cell, image, true};
}

}  // namespace vex
