// A polytope that knows its faces: prisms, pyramids, Archimedean solids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/polytope.h"

namespace vex {

/// The body is the hull of the stored doubles. V, S and M are sums over its faces and edges as they are stored, of
/// positive terms each: to some 1e-14 of themselves.
class FacedPolytope : public Polytope {
 public:
  /// The corners of a face, counter-clockwise seen from outside, as indices into the vertices.
  using Face = std::vector<std::uint32_t>;

  /// Convex, closed, with no two faces in one plane; `centre` strictly inside; `inradius` as Polytope's.
  FacedPolytope(std::span<const Vec3d> vertices, std::vector<Face> faces, const Vec3d& centre, double inradius);

  std::size_t n_faces() const { return faces_.size(); }
  const std::vector<Face>& faces() const { return faces_; }

  /// V by cones from the centre, S face by face, M = 1/2 sum over edges of length times exterior angle.
  Measures measures() const;
  NormalMeasure area_measure() const;
  NormalMeasure mean_curvature_measure() const;

 private:
  std::vector<Face> faces_;
};

/// The faces of a polytope all of whose edges have one length, the least distance between two of its vertices, as the
/// Archimedean solids' have.
std::vector<FacedPolytope::Face> faces_of_equal_edges(std::span<const Vec3d> vertices);

/// Corners of a regular polygon about the z axis, a side of it across the x axis, at this height; turned by
/// `half_sides` half sides. Each coordinate within 16 u of the circumradius.
std::vector<Vec3d> regular_polygon(int n_sides, double edge, double z, int half_sides = 0);
/// Of a prism or an antiprism: the lower polygon, then the upper one, turned against it by `half_sides` half sides.
/// Throws InputError; `what`: "a prism".
std::vector<Vec3d> two_polygons(int n_sides, double edge, double height, int half_sides, const std::string& what);
/// These sides, and behind them both polygons.
std::vector<FacedPolytope::Face> between_polygons(int n_sides, std::vector<FacedPolytope::Face> sides);
/// Of a regular polygon: to its corners, and to its sides.
double polygon_circumradius(int n_sides, double edge);
double polygon_inradius(int n_sides, double edge);
/// Throws InputError where it is not from 3 to 1000: `what` has them.
int checked_n_sides(int n_sides, const std::string& what);
inline constexpr int kMostSides = 1000;

}  // namespace vex
