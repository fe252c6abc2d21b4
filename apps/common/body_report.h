// What every program says of its bodies: in JSON and on the screen.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/common/bodies.h"

namespace vex {

/// The entry of `bodies` in every program's JSON; with the vertices in hexadecimal if asked for.
nlohmann::ordered_json body_json(const LoadedBody& loaded, bool with_vertices);

/// The lines that describe the body on the screen; `label` is A or B.
std::string body_text(const LoadedBody& loaded, const std::string& label, bool with_vertices);

}  // namespace vex
