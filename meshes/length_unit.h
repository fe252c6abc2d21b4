// Units of length: the names that users and files give them, and soups in another unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "meshes/polygon_soup.h"

namespace vex {

struct LengthUnit {
  std::string name;     // "mm"
  double metres = 0.0;  // nearest double; positive
};

/// "m", "cm", "mm", "um" (or "µm"), "nm", "in", "ft", or such a unit's English name; any case. Nothing for other text.
std::optional<LengthUnit> parse_length_unit(std::string_view text);

/// The unit of a file that states its size and may name it. The size is what counts: where it is that of a unit above,
/// or the float nearest to it, that is the unit; other sizes go by the file's name for them, or "X m" where it has none
/// or one that means another size. Nothing where `metres` is not positive and finite.
std::optional<LengthUnit> stated_length_unit(std::string_view name, double metres);

/// Multiplies every coordinate, and the last place. Between the units above a coordinate is rounded once where one unit
/// is a whole multiple of the other (20 mm become exactly the double 0.02 m), and otherwise multiplied by the nearest
/// double to the ratio; in its own unit a soup keeps every bit. Throws InputError for a soup that states no unit.
void convert_unit(PolygonSoup& soup, const LengthUnit& to);

}  // namespace vex
