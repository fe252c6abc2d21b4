// Numbers of poses as text, in options and in the rows of files: decimal or hexadecimal, and the poses they make.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "engine/numeric/pose.h"

namespace vex {

/// Without the blanks, tabs and carriage returns at its ends.
std::string_view without_blanks(std::string_view text);

/// In quotation marks, as messages quote: not more than a reader takes in, and no character that ends a message.
std::string in_quotation_marks(std::string_view text);

/// Whether the text is a finite number, decimal or hexadecimal (0x1.8p-3), without blanks.
bool is_a_number(std::string_view text);

/// The number, with blanks around it. Throws UsageError where the text is no number, InputError where it is not finite
/// or beyond the range of doubles; `name` stands in the message.
double pose_number(std::string_view text, std::string_view name);

/// The same of a cell of a row: InputError in every case.
double cell_number(std::string_view cell, std::string_view column);

/// Exactly these numbers of `--option`, separated by commas. Throws as pose_number does.
void read_numbers(std::string_view text, std::string_view option, std::span<double> numbers);

/// r11, r12, ... r33, tx, ty, tz, taken as they are. Throws InputError where R is not a rotation to within
/// Pose::kRotationTolerance, or mirrors.
Transformd pose_of_matrix(const std::array<double, 12>& numbers);

/// Of a quaternion w, x, y, z of any length but 0 (engine/numeric/quaternion.h). Throws InputError for 0.
Transformd pose_of_quaternion(const std::array<double, 4>& wxyz, const Vec3d& translation);

}  // namespace vex
