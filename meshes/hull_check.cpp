#include "meshes/hull_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/hull.h"
#include "meshes/hull_depth.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

std::string depth_text(double depth, double size, double tolerance) {
  return number_text(depth) + " deep, " + number_text(depth / size) + " of the size " + number_text(size) +
         "; tolerance " + number_text(tolerance);
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("the surface is not convex (" + what + ")" +
                   hull_advice("mend the mesh, raise --convex-tolerance if this is rounding"));
}

[[noreturn]] void refuse_winding(long winding_number) {
  refuse("it winds " + std::to_string(winding_number) + " times about its centroid, a convex one winds once");
}

/// The hull's own triangulation must be convex far below any tolerance that means something: what Qhull's rounding
/// left.
HullInstead hull_of(const Triangles& mesh) {
  std::optional<Triangles> triangles = paired_triangles(mesh.vertices, convex_hull_triangles(mesh.vertices));
  if (!triangles || triangles->size() == 0) {
    throw InputError(
        "no closed convex hull could be made of the vertices (rounding left gaps) - the body is too thin or its "
        "vertices "
        "too close together for its size: mend the mesh");
  }
  HullInstead hull{std::move(*triangles), {}, 0.0};
  hull.solid = volume_and_centroid(hull.triangles);
  return hull;
}

}  // namespace

std::optional<HullInstead> checked_convexity(const Triangles& mesh, const VolumeAndCentroid& solid, double size,
                                             double tolerance) {
  const ConvexityCensus census = convexity_census(mesh, solid.centroid);
  if (census.locally_convex()) {
    if (census.winding_number != 1) {
      refuse_winding(census.winding_number);
    }
    return std::nullopt;
  }
  const double tolerated = tolerance * size;
  if (census.n_reflex_edges > 0 && !(census.reflex_depth <= tolerated && tolerance > 0.0)) {
    refuse(std::to_string(census.n_reflex_edges) + " edges are reflex, the deepest is " +
           edge_text(mesh, census.deepest_half_edge) + ", " + depth_text(census.reflex_depth, size, tolerance));
  }
  if (tolerance == 0.0) {
    const std::size_t t = census.first_blind_triangle;
    refuse("the triangle " + point_text(mesh.corner(t, 0)) + ", " + point_text(mesh.corner(t, 1)) + ", " +
           point_text(mesh.corner(t, 2)) + " has no area or does not face outward; tolerance 0");
  }
  HullInstead hull = hull_of(mesh);
  const double hull_area = surface_area(hull.triangles);
  const double thickness = 2.0 * hull.solid.volume / hull_area;  // of a plate; then everything is near the hull
  if (!(thickness > 4.0 * tolerated)) {
    throw InputError("the body is too thin to be convex only within the tolerance (it is about " +
                     number_text(thickness) + " thick, the tolerance " + number_text(tolerance) + " of its size is " +
                     number_text(tolerated) + ") - lower --convex-tolerance, or use plate: or disc:");
  }
  const HullDepth deepest = depth_below_hull(mesh, hull.triangles, hull.solid.centroid, tolerated);
  if (deepest.depth > tolerated) {
    refuse("the surface lies below its convex hull at " + point_text(deepest.where) + ", " +
           depth_text(deepest.depth, size, tolerance));
  }
  if (census.winding_number != 1) {
    refuse_winding(census.winding_number);
  }
  // The region between a surface at most `tolerated` deep and its hull, and what its area can differ by (Steiner).
  const double hull_curvature = integrated_mean_curvature(hull.triangles);
  const double area = surface_area(mesh);
  if (!(std::fabs(hull.solid.volume - solid.volume) <= tolerated * hull_area)) {
    refuse("its volume is " + number_text(solid.volume) + " and its hull's " + number_text(hull.solid.volume) +
           "; tolerance " + number_text(tolerance));
  }
  if (!(std::fabs(hull_area - area) <= 2.0 * tolerated * hull_curvature)) {
    refuse("its area is " + number_text(area) + " and its hull's " + number_text(hull_area) + "; tolerance " +
           number_text(tolerance));
  }
  hull.reflex_depth = std::max(census.reflex_depth, deepest.depth);
  return hull;
}

}  // namespace vex
