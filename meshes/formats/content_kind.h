// What a file plainly is, whatever its name says: for messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vex {

struct ContentKind {
  std::string_view what;       // "a PLY mesh"
  std::string_view extension;  // under which it is read; empty where it is not
  std::string_view advice;     // what to do with it
};

/// By the first bytes; nothing where they do not tell. A binary STL may begin with anything: of a file that reads well
/// as what its name says, this proves nothing.
std::optional<ContentKind> content_kind(std::string_view bytes);

/// Formats that are not read, by extension (in lower case, with its point).
std::optional<ContentKind> unread_format(std::string_view extension);

/// Throws the InputError that says so of the file `name`, which was to be read as `extension`.
[[noreturn]] void refuse_kind(const std::string& name, const ContentKind& kind, const std::string& extension);

}  // namespace vex
