// Orientation laws as users write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/numeric/vec3.h"
#include "engine/sampling/poses/orientation_law.h"

namespace vex {

/// What `parse_orientation_law` takes, as messages name it.
inline constexpr std::string_view kOrientationLaws =
    "isotropic, aligned, fixed:W,X,Y,Z, angle:DEG, cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE";

/// isotropic, aligned, fixed:W,X,Y,Z, angle:DEG, cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE: the inverse of
/// `OrientationLaw::name`, but for tables, and for laws that differ between the bodies or are about other axes than z.
/// Throws UsageError, and InputError where a table is not to be used; `option`, where it is not empty, is named in the
/// message: --orientations; `choices` are those that it names where the text is none.
OrientationLaw parse_orientation_law(std::string_view text, std::string_view option = {},
                                     std::string_view choices = kOrientationLaws);

/// The law of one body: those of the above that are about an axis.
AxisLaw parse_axis_law(std::string_view text, std::string_view option = {});

/// A body's own axis: x, y, z, or a direction X,Y,Z of any length but 0. Throws UsageError.
Vec3d parse_axis(std::string_view text, std::string_view option = {});

/// The file of table:FILE; nothing of all others.
std::optional<std::string> file_of_law(std::string_view text);

}  // namespace vex
