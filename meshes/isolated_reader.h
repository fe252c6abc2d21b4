// Reads a file by assimp in a process of its own.
//
// Readers of some dozens of formats are a large surface: a damaged file can make one crash, loop, or ask for memory
// without bound. Here that ends the other process, whose time and memory are limited, and the caller gets an
// InputError.
#pragma once

#include "meshes/assimp_input.h"
#include "meshes/polygon_soup.h"

namespace vex {

/// read_by_assimp in a forked process; the same soup, the same InputErrors, and one for a reader that fails.
PolygonSoup read_by_assimp_isolated(const AssimpInput& input);

}  // namespace vex
