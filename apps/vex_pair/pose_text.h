// Poses as text: B's pose in A's frame, as twelve numbers of a matrix and a translation, or as a quaternion and a
// translation.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "engine/numeric/pose.h"

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

/// A finite number, decimal or hexadecimal (0x1.8p-3), with blanks around it. Throws UsageError where the text is no
/// number, InputError where it is not finite or beyond the range of doubles; `name` stands in the message.
double pose_number(std::string_view text, std::string_view name);

/// Exactly these numbers of `--option`, separated by commas. Throws as pose_number does.
void read_numbers(std::string_view text, std::string_view option, std::span<double> numbers);

/// r11, r12, ... r33, tx, ty, tz, taken as they are. Throws InputError where R is not a rotation to within
/// Pose::kRotationTolerance, or mirrors.
Transformd pose_of_matrix(const std::array<double, 12>& numbers);

/// Of a quaternion w, x, y, z of any length but 0 (engine/numeric/quaternion.h). Throws InputError for 0.
Transformd pose_of_quaternion(const std::array<double, 4>& wxyz, const Vec3d& translation);

}  // namespace vex
