// What a body is, in a line: two runs are of the same bodies where these lines are equal.
#pragma once

#include <string>

#include "shapes/body.h"

namespace vex {

/// Its kind, V, S and M, and a 64-bit hash (FNV-1a) of the exact geometry that was read: every vertex, and the areas of
/// the faces in their order; of a body without an exact form, of its support in 64 directions to 1e-11. Not its name: a file that was moved is the same body, and one that was changed another.
std::string body_identity(const Body& body);

}  // namespace vex
