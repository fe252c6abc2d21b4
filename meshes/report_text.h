// How the messages of this folder print numbers and places.
#pragma once

#include <string>

#include "engine/numeric/vec3.h"

namespace vex {

/// A number with nine digits, as many as tell 32-bit floats apart.
std::string number_text(double value);
/// "(x, y, z)", each with the digits that it needs to be found again in the file.
std::string point_text(const Vec3d& point);
/// What every refusal of a shape ends with.
std::string hull_advice(const std::string& first_advice);

}  // namespace vex
