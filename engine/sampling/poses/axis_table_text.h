// A density of orientations as a file of text: two columns, cos(theta) and the density.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/sampling/poses/axis_law.h"

namespace vex {

inline constexpr std::size_t kLargestAxisTable = std::size_t{1} << 24;  // bytes

/// A line a point: two numbers with blanks or one comma between them, cosines ascending (AxisLaw::table). Empty lines
/// and what follows a # are passed over; there is no header. Throws InputError with `name` and the line.
AxisTable parse_axis_table(std::string_view text, const std::string& name);

/// Of a regular file of at most kLargestAxisTable bytes. Throws InputError.
AxisTable read_axis_table(const std::string& path);

}  // namespace vex
