// Orientation laws as users write them.
#pragma once

#include <string_view>

#include "engine/sampling/poses/orientation_law.h"

namespace vex {

/// isotropic, aligned, fixed:W,X,Y,Z, cone:DEG, angle:DEG, onsager:ALPHA; throws UsageError, with `option` in the
/// message.
OrientationLaw parse_orientations(std::string_view text, std::string_view option);

}  // namespace vex
