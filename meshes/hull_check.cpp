#include "meshes/hull_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/exact_hull.h"
#include "meshes/hull.h"
#include "meshes/hull_depth.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

std::string depth_text(double depth, double size, const ConvexTolerance& tolerance) {
  return number_text(depth) + " deep, " + number_text(depth / size) + " of the size " + number_text(size) +
         "; tolerance " + number_text(tolerance.of_size) + (tolerance.reason.empty() ? "" : ", " + tolerance.reason);
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("the surface is not convex (" + what + ")" +
                   hull_advice("mend the mesh, raise --convex-tolerance if this is rounding"));
}

[[noreturn]] void refuse_winding(long winding_number) {
  refuse("it winds " + std::to_string(winding_number) + " times about its centroid, a convex one winds once");
}

/// The triangles with what they enclose, if they are exactly convex.
std::optional<HullInstead> if_convex(std::optional<Triangles> triangles) {
  if (!triangles) {
    return std::nullopt;
  }
  const VolumeAndCentroid solid = volume_and_centroid(*triangles);
  const ConvexityCensus census = convexity_census(*triangles, solid.centroid);
  if (!census.locally_convex() || census.winding_number != 1) {
    return std::nullopt;
  }
  return HullInstead{std::move(*triangles), solid, 0.0};
}

HullInstead hull_of(const Triangles& mesh) {
  std::optional<HullInstead> hull = if_convex(exact_hull(mesh.vertices));
  if (!hull) {
    hull = if_convex(paired_triangles(mesh.vertices, convex_hull_triangles(mesh.vertices)));
  }
  if (!hull) {
    throw InputError(
        "no convex hull could be made of the vertices (rounding left it with gaps) - the body is too thin or its "
        "vertices too close together for its size: mend the mesh");
  }
  return std::move(*hull);
}

}  // namespace

std::optional<HullInstead> checked_convexity(const Triangles& mesh, const VolumeAndCentroid& solid, double size,
                                             const ConvexTolerance& tolerance) {
  const ConvexityCensus census = convexity_census(mesh, solid.centroid);
  if (census.locally_convex()) {
    if (census.winding_number != 1) {
      refuse_winding(census.winding_number);
    }
    return std::nullopt;
  }
  const double tolerated = tolerance.of_size * size;
  if (census.n_reflex_edges > 0 && !(census.reflex_depth <= tolerated && tolerance.of_size > 0.0)) {
    const std::string n_edges = std::to_string(census.n_reflex_edges);
    refuse((census.n_reflex_edges == 1 ? "an edge is reflex: " : n_edges + " edges are reflex, the deepest is ") +
           edge_text(mesh, census.deepest_half_edge) + ", " + depth_text(census.reflex_depth, size, tolerance));
  }
  if (tolerance.of_size == 0.0) {
    const std::size_t t = census.first_blind_triangle;
    refuse("the triangle " + point_text(mesh.corner(t, 0)) + ", " + point_text(mesh.corner(t, 1)) + ", " +
           point_text(mesh.corner(t, 2)) + " has no area or does not face outward; tolerance 0");
  }
  HullInstead hull = hull_of(mesh);
  const double hull_area = surface_area(hull.triangles);
  const double thickness = 2.0 * hull.solid.volume / hull_area;  // of a plate
  const HullDepth deepest =
      depth_below_hull(mesh, hull.triangles, hull.solid.centroid, std::min(tolerated, thickness / 8.0));
  if (deepest.depth > tolerated) {
    refuse("the surface lies below its convex hull at " + point_text(deepest.where) + ", " +
           depth_text(deepest.depth, size, tolerance));
  }
  if (census.winding_number != 1) {
    refuse_winding(census.winding_number);
  }
  hull.reflex_depth = std::max(census.reflex_depth, deepest.depth);
  if (!(thickness > 4.0 * hull.reflex_depth)) {  // then everything is near the hull, a crumpled sheet too
    refuse("it is only about " + number_text(thickness) + " thick and " +
           depth_text(hull.reflex_depth, size, tolerance));
  }
  // Depth is at most three times that of the middles (hull_depth.h): so much room is there between surface and hull.
  const double allowed_volume = 3.0 * hull.reflex_depth * hull_area + 1e-12 * hull.solid.volume;
  if (!(std::fabs(hull.solid.volume - solid.volume) <= allowed_volume)) {
    refuse("its volume is " + number_text(solid.volume) + " and its hull's " + number_text(hull.solid.volume) +
           ", though it is nowhere deeper than " + number_text(hull.reflex_depth));
  }
  // What two surfaces that are nowhere further apart can differ by in area (Steiner's formula).
  const double allowed_area = 2.0 * tolerated * integrated_mean_curvature(hull.triangles);
  if (!(census.area_turned_away <= allowed_area)) {
    refuse("faces with an area of " + number_text(census.area_turned_away) + " look inward");
  }
  return hull;
}

}  // namespace vex
