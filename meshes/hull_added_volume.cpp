#include "meshes/hull_added_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "meshes/triangles.h"

namespace vex {
namespace {

/// The volume that each part of a closed surface encloses, negative where it is inside out; by the part's first vertex.
/// Rounded: for comparing parts with each other.
std::map<std::uint32_t, double> volume_of_each_part(const PolygonSurface& surface, const Triangles& triangles) {
  const std::vector<std::uint32_t> component = component_of_each_vertex(surface);
  std::map<std::uint32_t, double> volumes;
  for (const auto& [a, b, c] : triangles.corners) {
    const Vec3d base = surface.vertices[component[a]];
    volumes[component[a]] +=
        dot(surface.vertices[a] - base, cross(surface.vertices[b] - base, surface.vertices[c] - base)) / 6.0;
  }
  return volumes;
}

AddedVolume not_defined(const std::string& why) {
  return {std::nullopt, {"how much volume the hull added is not defined: " + why}};
}

}  // namespace

double added_volume(const VolumeAndCentroid& hull, const VolumeAndCentroid& mesh) {
  const DoubleDouble six_mesh = mesh.volume < 0.0 ? -mesh.six_volumes : mesh.six_volumes;
  const double added = (hull.six_volumes - six_mesh).value() / 6.0;
  return std::fabs(added) > hull.volume_error + mesh.volume_error ? added : 0.0;
}

AddedVolume volume_added_to(const PolygonSurface& surface, const VolumeAndCentroid& hull) {
  const HalfEdgePairs pairs = half_edge_pairs(surface);
  if (!pairs.problem.empty()) {
    return not_defined(pairs.problem);
  }
  const Triangles mesh = fan_triangles(surface, pairs.mates);
  const std::map<std::uint32_t, double> parts = volume_of_each_part(surface, mesh);
  const std::string n_surfaces = std::to_string(parts.size()) + " surfaces share no vertex";
  const auto [least, most] = std::minmax_element(
      parts.begin(), parts.end(), [](const auto& one, const auto& other) { return one.second < other.second; });
  if (least->second < 0.0 && most->second > 0.0) {
    return not_defined("the file's " + n_surfaces + ", and some of them are inside out, as parts or as cavities");
  }
  AddedVolume added{added_volume(hull, volume_and_centroid(mesh)), {}};
  if (*added.volume < 0.0) {
    return not_defined("the file's surfaces overlap or wind several times: together they enclose more than the hull");
  }
  if (parts.size() > 1) {
    added.notes.push_back("the file's " + n_surfaces + ": the volumes that they enclose were added as they stand, " +
                          "as if none overlapped, to say how much the hull added");
  }
  return added;
}

}  // namespace vex
