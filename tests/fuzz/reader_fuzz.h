// Any bytes into any reader: it ends in an InputError, or in what its header promises.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vex::tests {

/// What is fuzzed as one: a strict reader, gunzip, what is asked of a scene format before assimp sees it, and "model",
/// that of a .3mf archive whose model is these bytes.
struct FuzzFormat {
  std::string name;  // the extension without its point
  std::function<void(std::string_view bytes)> read;
};
std::vector<FuzzFormat> fuzz_formats();

/// Throws std::logic_error, which says what is broken, where a promise is.
void demand(bool holds, const char* what);
void read_as(const FuzzFormat& format, std::string_view bytes);

}  // namespace vex::tests
