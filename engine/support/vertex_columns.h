// The vertices of a polytope by coordinate, made ready for a direction map.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace vex {

/// All x, all y and all z.
using VertexColumns = std::array<std::vector<double>, 3>;

/// The vertices in their order, without those that equal one before: these never answer.
VertexColumns without_repetitions(std::span<const double> x, std::span<const double> y, std::span<const double> z);

/// Exponents of the powers of two by which the body is about as long along each axis; none where coordinates are too
/// large. An axis along which it has no length is treated like that of its greatest.
std::optional<std::array<int, 3>> lengths_along(const VertexColumns& columns);

}  // namespace vex
