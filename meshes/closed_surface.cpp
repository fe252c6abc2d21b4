#include "meshes/closed_surface.h"

#include <algorithm>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/coordinate_rounding.h"
#include "meshes/near_points.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

std::string joined_text(const NearWeld& near) {
  return std::to_string(near.n_joined) + (near.n_joined == 1 ? " point was" : " points were") +
         " joined to another no farther away than " + rough_text(near.welded->distance) + ", and moved by at most " +
         rough_text(near.welded->largest_move);
}

/// Joins what is no farther apart than `weld` times the size. Where that is below what can tell two doubles apart,
/// equal points are joined already.
ClosedSurface welded_by(WeldedSurface exact, double weld, UnusedPoints unused) {
  ClosedSurface result{std::move(exact), {}, {}};
  const std::vector<Vec3d>& vertices = result.welded.surface.vertices;
  if (vertices.empty()) {
    return result;
  }
  const double distance = weld * bounding_diagonal(vertices);
  if (!(distance >= least_weld_distance(vertices))) {
    return result;
  }
  NearWeld near = joined_within(result.welded, distance, unused);
  if (!near.welded) {
    throw InputError(
        "the weld distance is larger than the distances of the mesh's own vertices (points no farther apart "
        "than " +
        number_text(distance) + " form a chain that is longer than " + number_text(kMostWeldDistances) +
        " times that, from " + point_text(near.chain) + " on) - choose a smaller --weld");
  }
  if (near.n_joined > 0) {
    result.note = joined_text(near);
    result.welded = std::move(*near.welded);
  }
  return result;
}

/// With points joined that are not farther apart than `reach`, if that closes the surface.
std::optional<ClosedSurface> closed_within(const WeldedSurface& exact, double reach) {
  if (exact.surface.n_faces() == 0 || half_edge_pairs(exact.surface).problem.empty()) {
    return std::nullopt;
  }
  reach = std::min(reach, kMostJoined * bounding_diagonal(exact.surface.vertices));
  NearWeld near = joined_within(exact, reach, UnusedPoints::dropped);
  if (!near.welded || near.n_joined == 0 || !half_edge_pairs(near.welded->surface).problem.empty()) {
    return std::nullopt;
  }
  const std::string note = "the surface is not closed as it stands: " + joined_text(near) + ", which closes it";
  ClosedSurface closed{std::move(*near.welded), {}, note};
  closed.mates = checked_half_edges(closed.welded.surface);
  return closed;
}

}  // namespace

ClosedSurface any_surface(const PolygonSoup& soup, std::optional<double> weld) {
  return welded_by(vex::weld(soup, UnusedPoints::kept), weld.value_or(0.0), UnusedPoints::kept);
}

ClosedSurface closed_surface(const PolygonSoup& soup, std::optional<double> weld, double reach) {
  ClosedSurface result = welded_by(vex::weld(soup), weld.value_or(0.0), UnusedPoints::dropped);
  try {
    result.mates = checked_half_edges(result.welded.surface);
  } catch (const InputError&) {
    std::optional<ClosedSurface> closed;
    if (!weld) {
      closed = closed_within(result.welded, reach);
    }
    if (!closed) {
      throw;
    }
    return std::move(*closed);
  }
  return result;
}

}  // namespace vex
