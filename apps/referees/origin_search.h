// Where is the origin: outside of A - B, and behind which direction, or between which of its points?
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/referees/difference_body.h"

namespace vex::exact {

/// What a search ends with. Claims of double-double arithmetic, to be proven.
struct SearchResult {
  std::optional<Vec3dd> separating_dir;  // all of A - B seems to lie behind the origin along it
  std::vector<DifferencePoint> around;   // points of A - B that seem to hold the origin; the last ones best
};

/// Starts at the support point of `dir`, any direction but zero.
SearchResult search_origin(const DifferenceBody& difference, const Vec3dd& dir);

/// The four of the points whose tetrahedron holds the origin deepest, in units of its own size; nothing where none does
/// by more than rounding.
std::optional<std::array<std::size_t, 4>> deepest_tetrahedron(const std::vector<DifferencePoint>& points);

}  // namespace vex::exact
