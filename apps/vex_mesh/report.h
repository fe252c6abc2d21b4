// What vex_mesh says of a run: on the screen and in JSON.
#pragma once

#include <string>

#include "apps/vex_mesh/mesh_run.h"

namespace vex {

/// The document of --json.
std::string report_json(const MeshRun& run);
std::string report_text(const MeshRun& run);

}  // namespace vex
