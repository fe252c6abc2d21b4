// Holds a guide to the file that its examples are compiled in, block by block.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace vex::test {

inline std::string text_of(const std::string& path) {
  std::ifstream file(std::string(VEX_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Without the blanks that lines begin with, which differ by two.
inline std::string unindented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) result += line.substr(begin) + "\n";
  }
  return result;
}

/// What stands between "// [name]" and "// [end]" in a source file, in order.
inline std::vector<std::string> compiled_examples(const std::string& path) {
  const std::string source = text_of(path), open = "// [", close = "// [end]";
  std::vector<std::string> examples;
  for (std::size_t at = 0; (at = source.find("\n", at)) != std::string::npos;) {
    const std::size_t begin = source.find_first_not_of(' ', at + 1);
    at += 1;
    if (begin == std::string::npos || source.compare(begin, open.size(), open) != 0 ||
        source.compare(begin, close.size(), close) == 0) {
      continue;
    }
    const std::size_t first = source.find('\n', begin) + 1, end = source.find(close, first);
    if (end == std::string::npos) break;
    examples.push_back(unindented(source.substr(first, source.rfind('\n', end) + 1 - first)));
    at = end;
  }
  return examples;
}

/// The blocks of C++ of a guide.
inline std::vector<std::string> shown_examples(const std::string& path) {
  const std::string guide = text_of(path);
  std::vector<std::string> shown;
  for (std::size_t at = 0; (at = guide.find("```cpp\n", at)) != std::string::npos;) {
    const std::size_t begin = at + 7, end = guide.find("```", begin);
    if (end == std::string::npos) break;
    shown.push_back(unindented(guide.substr(begin, end - begin)));
    at = end + 3;
  }
  return shown;
}

}  // namespace vex::test
