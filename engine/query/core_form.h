// A body without its ball, as the packet kernels take it: told from the exact form alone, never from the shape.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/convex_body.h"

namespace vex {

struct CoreForm {
  enum class Kind : std::uint8_t {
    box,        // all points with coordinates of `lower` or `upper`: plates, needles and points among them
    ellipsoid,  // about the origin
    vertices,   // few enough to scan
  };
  Kind kind = Kind::box;
  Vec3d lower, upper;           // of a box
  Vec3d semi_axes;              // of an ellipsoid
  std::vector<double> x, y, z;  // of vertices
};

/// Polytopes of more vertices are left to their own support mapping, one pose at a time: a query of two hulls of 100
/// takes 0.42 us by packets that scan and 0.45 us by tables of directions (docs/performance.md), which grow no longer.
inline constexpr std::size_t kMostScannedVertices = 100;

/// None where the body's core is none of these.
std::optional<CoreForm> core_form(const ConvexBody& body);

}  // namespace vex
