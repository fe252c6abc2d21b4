// Orientation laws as users write them.
#pragma once

#include <string_view>

#include "engine/sampling/poses/orientation_law.h"

namespace vex {

/// isotropic, aligned, fixed:W,X,Y,Z, cone:DEG, angle:DEG, onsager:ALPHA: the inverse of `OrientationLaw::name`. Throws
/// UsageError; `option`, where it is not empty, is named in the message: --orientations.
OrientationLaw parse_orientation_law(std::string_view text, std::string_view option = {});

}  // namespace vex
