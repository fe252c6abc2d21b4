// Two bodies as a report shows them: as triangles, with the surface that B's centre may not enter at some orientations.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/sampling/poses/orientation_law.h"
#include "meshes/body_mesh.h"
#include "shapes/body.h"

namespace vex {

/// An orientation of B in A's frame that the law draws.
struct OrientationView {
  std::array<double, 4> quaternion{};  // w, x, y, z: what --orientations fixed: takes
  Transformd rotation;
  BodyMesh surface;       // of B's centre seen from A's; without points where nothing is excluded
  bool is_exact = false;  // the surface, for polytopes of few vertices
  /// The volume within the surface that the bodies have, not the triangles (exact_average.h), and its error; length^3.
  std::optional<double> excluded_volume;
  double error = 0.0;
};

struct PairView {
  std::string name_a, name_b;                 // B's is empty where it is A again
  BodyMesh a, b;                              // without points where one is too thin to be drawn
  double size = 0.0;                          // no part of the picture is farther from A's centre
  std::vector<OrientationView> orientations;  // from the smallest excluded volume to the largest
  std::string surface_name = "the surface that B’s centre may not enter";
};

/// Some thirty orientations of the law, in a net of quasi-random points that the seed scrambles; one where the law has
/// but one. They are no part of any result: the points are not those of a run. Takes some tenths of a second.
PairView pair_view(const Body& a, const std::string& name_a, const Body& b, const std::string& name_b,
                   const OrientationLaw& law, std::uint64_t seed);

/// A line between two triangles of a mesh, or of a rim one triangle twice; indices of points and of triangles.
struct SharpEdge {
  std::array<std::uint32_t, 2> ends, triangles;
};

/// Where the surface is not smooth, and the rim of what is flat.
std::vector<SharpEdge> sharp_edges(const BodyMesh& mesh);

/// The triangles, orientations and values for the script of the page: a JSON document of whole numbers.
std::string viewer_document(const PairView& view);

}  // namespace vex
