// A body as Python holds it.
#pragma once

#include <optional>
#include <string>

#include "meshes/convex_mesh.h"
#include "python/bindings/arrays.h"
#include "shapes/body.h"

namespace vex::python {

struct PyBody {
  Body body;
  std::optional<MeshReport> report{};  // of a mesh
};

void bind_bodies(py::module_& module);
void bind_depletion(py::module_& module);
void bind_excluded_volume(py::module_& module);
void bind_nematic(py::module_& module);
void bind_queries(py::module_& module);
void bind_scenes(py::module_& module);
void bind_separations(py::module_& module);
void bind_poses(py::module_& module);
void bind_percolation(py::module_& module);
void bind_virial(py::module_& module);
void bind_worlds(py::module_& module);

/// A body whose support mapping is a function of Python: of an array (1, 3) of directions, of points of the same shape.
/// What it throws passes through the query; it is asked with the GIL held.
ConvexBody callable_body(py::function support, double support_error, const Vec3d& centre, double circumradius,
                         double inradius);

}  // namespace vex::python
