// What legacy .vtk files are put together from: types of numbers, lists of cells, and arrays that are no geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "meshes/formats/mixed_scanner.h"

namespace vex {

/// In any case of letters; `lower` is in lower case.
bool is_vtk_word(std::string_view word, std::string_view lower);

/// The next word as the type of numbers. Refuses what is none: bit, string, and in a binary file long, the size of
/// which depends on the machine that wrote the file.
ScalarType read_vtk_type(MixedScanner* scanner);

/// What stands behind a keyword like POLYGONS: two numbers, and cells in either of two forms. The older has the length
/// of each cell and its points; the numbers announce the cells, and all that follow. The newer, which VTK 9 writes, has
/// an array OFFSETS of where each cell begins and an array CONNECTIVITY of all points; the numbers are their lengths.
/// Calls `visit` with the points of each cell, all of them below `n_points`.
void read_vtk_cells(MixedScanner* scanner, std::size_t n_points,
                    const std::function<void(std::span<const std::uint32_t>)>& visit);

/// Goes behind what follows the keyword FIELD: named arrays.
void skip_vtk_field(MixedScanner* scanner);

/// Goes behind what follows the keyword METADATA: lines up to an empty one.
void skip_vtk_metadata(MixedScanner* scanner);

/// Points or cells announced in a line of `rest`, where only attributes should be: the keyword; empty where there is
/// none.
std::string_view geometry_in_vtk_attributes(std::string_view rest);

}  // namespace vex
