// A body without its ball, as the packet kernels take it: told from the exact form alone, never from the shape.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/convex_body.h"
#include "engine/support/direction_table.h"

namespace vex {

struct CoreForm {
  enum class Kind : std::uint8_t {
    box,        // all points with coordinates of `lower` or `upper`: plates, needles and points among them
    ellipsoid,  // about the origin
    vertices,   // few enough to scan
    table,      // of directions, of a polytope of more vertices
    pieces,     // few ellipsoids anywhere, flat ones, half ones and points among them
    powers,     // a superellipsoid about the origin
    profile,    // of revolution, its outline arcs
  };
  /// {centre + D x : |x| <= 1}, D = diag(semi_axes), or of a dome the upper half.
  struct Piece {
    Vec3d centre, semi_axes;
    bool is_dome = false;
    bool is_like_last = false;  // but for the centre
  };
  static constexpr std::size_t kMostPieces = 8;
  /// The unit circle of a norm of exponent p, and of its dual.
  struct PowerCurve {
    double inverse = 0.0, power = 0.0;  // 1/p and 1/(p - 1), large for p = 1
  };

  Kind kind = Kind::box;
  Vec3d lower, upper;           // the bounding box; a box itself
  Vec3d semi_axes;              // of an ellipsoid, or a superellipsoid
  std::vector<double> x, y, z;  // of vertices
  DirectionTable table;         // null where the body's numbers allow of none
  std::vector<Piece> pieces;
  PowerCurve across, along;  // of a superellipsoid
  std::optional<ProfileForm> profile;
  double support_error = 0.0;  // of the core's own support mapping, beyond that of the body's
};

/// None where the body's core is none of these.
std::optional<CoreForm> core_form(const ConvexBody& body);

}  // namespace vex
