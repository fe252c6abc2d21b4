// Reads a file by assimp in a process of its own.
//
// Readers of some dozens of formats are a large surface: a damaged file can make one crash, loop, or ask for memory
// without bound, and a crafted one can take it over. Here that ends the other process, whose time and memory are
// limited and which can open, connect and start nothing (confinement.h), and the caller gets an InputError. No file is
// opened there: `input` holds all that is read.
#pragma once

#include "meshes/assimp_input.h"
#include "meshes/confined_process.h"
#include "meshes/polygon_soup.h"

namespace vex {

/// read_by_assimp in a forked process; the same soup, the same InputErrors, and one for a reader that fails, or cannot
/// be held as `confining` asks. `unconfined` of the soup says what holds it less than it should.
PolygonSoup read_by_assimp_isolated(const AssimpInput& input, Confining confining = Confining::as_far_as_possible);

}  // namespace vex
