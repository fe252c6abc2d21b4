// How the messages of this folder print numbers and places.
#pragma once

#include <string>

#include "engine/numeric/vec3.h"

namespace vex {

/// A number with as many digits as a 32-bit float needs to be found again in the file.
std::string number_text(double value);
/// "(x, y, z)".
std::string point_text(const Vec3d& point);
/// What every refusal of a shape ends with.
std::string hull_advice(const std::string& first_advice);

}  // namespace vex
