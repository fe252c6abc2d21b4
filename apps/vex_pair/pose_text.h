// Poses as text: B's pose in A's frame, as twelve numbers of a matrix and a translation, or as a quaternion and a
// translation.
#pragma once

#include <string_view>

#include "apps/common/pose_numbers.h"

namespace vex {

/// What the columns of a file of poses are.
enum class PoseFormat {
  matrix,      // r11,r12,r13,r21,...,r33,tx,ty,tz
  quaternion,  // tx,ty,tz,qw,qx,qy,qz
};

/// Both headers, as messages and the help show them.
inline constexpr const char* kHeaders = "r11,r12,r13,r21,r22,r23,r31,r32,r33,tx,ty,tz or tx,ty,tz,qw,qx,qy,qz";

/// Throws InputError where the columns are not those of a format, in its order. Blanks around a name do not count.
PoseFormat format_of_header(std::string_view line);

/// Of a row of a file. Throws InputError, which names the column; where the row is, the caller knows.
Transformd pose_of_row(std::string_view line, PoseFormat format);

}  // namespace vex
