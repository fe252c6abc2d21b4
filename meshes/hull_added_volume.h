// How much volume a hull has that the mesh does not have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshes/polyhedron_measures.h"
#include "meshes/surface.h"

namespace vex {

/// What the hull adds to surfaces that enclose `mesh`: 0 where no rounding tells them apart.
double added_volume(const VolumeAndCentroid& hull, const VolumeAndCentroid& mesh);

/// The same of any faces, if they enclose a defined volume (MeshReport::hull_added_volume), with what the user is to
/// know of it, why there is none among it.
struct AddedVolume {
  std::optional<double> volume;
  std::vector<std::string> notes;
};
AddedVolume volume_added_to(const PolygonSurface& surface, const VolumeAndCentroid& hull);

}  // namespace vex
