// What programs read besides meshes, as fuzzing and its tests see it: a file of poses, a scene, realisations to go on
// from, a body's text, a law's table, a document that vex_merge adds. Whatever the bytes are, reading them ends in an
// InputError (or UsageError) with a message as promised, or in what the reader promises.
#pragma once

#include <vector>

#include "reader_fuzz.h"

namespace vex::tests {

/// "poses", "scene", "realisations", "body", "table", "document".
std::vector<FuzzFormat> program_formats();

}  // namespace vex::tests
