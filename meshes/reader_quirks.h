// Files that are well-formed and that assimp 5.2 misreads or refuses: what it is shown in their place.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace vex {

struct ShownText {
  std::string text;
  bool face_was_added = false;  // the last face of the file, of one corner, is not the file's
};

/// Nothing where the file's own bytes do; `file`, of `size` bytes, is then at its start again. `extension` is in lower
/// case, with its point.
///  .obj: a 0 is put before every word that starts like ".5". assimp takes only words that start with a digit or a sign
///        for numbers, and silently drops the vertex that has another.
///  .stl: text is put in lower case, from its first word on. assimp knows no SOLID, FACET, VERTEX, and no empty line
///        before them.
///  .off: a file of points without a face gets one, of one corner. assimp refuses it otherwise.
std::optional<ShownText> text_for_assimp(const std::string& extension, std::FILE* file, std::uintmax_t size);

}  // namespace vex
