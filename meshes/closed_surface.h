// A soup's surface, welded no more than needed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "meshes/polygon_soup.h"
#include "meshes/weld.h"

namespace vex {

struct ClosedSurface {
  WeldedSurface welded;
  std::vector<std::uint32_t> mates;  // of its half-edges
  std::string note;                  // where points were joined that are not equal; empty where not
};

/// The checked surface (checked_half_edges) of equal points; where that is not closed and the points are joined that
/// are not farther apart than `reach`, or kMostJoined of the size, which closes it, of those. `weld`: a fraction of the size, as in MeshOptions,
/// instead of `reach`. Throws InputError.
ClosedSurface closed_surface(const PolygonSoup& soup, std::optional<double> weld, double reach);

/// The points and faces as --hull wants them: points are joined that are not farther apart than the user said.
ClosedSurface any_surface(const PolygonSoup& soup, std::optional<double> weld);

}  // namespace vex
