#include "meshes/reader_quirks.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace vex {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

template <class Visit>  // visit(character)
void for_each_character(std::FILE* file, const Visit& visit) {
  std::array<char, 1U << 16U> chunk{};
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), file)) {
    std::for_each_n(chunk.begin(), n, visit);
  }
}

std::string with_leading_zeros(std::FILE* file) {
  std::string text;
  char previous = ' ';
  bool at_point = false;  // the last character is a point that starts a word
  for_each_character(file, [&](char c) {
    if (at_point && c >= '0' && c <= '9') {
      text.insert(text.size() - 1, 1, '0');
    }
    at_point = c == '.' && (previous == ' ' || previous == '\t');
    text.push_back(c);
    previous = c;
  });
  return text;
}

std::string in_lower_case(std::FILE* file) {
  std::string text;
  for_each_character(file, [&](char c) {
    if (!text.empty() || !is_blank(c)) {
      text.push_back(lower(c));
    }
  });
  return text;
}

std::string beginning_of(std::FILE* file) {
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::rewind(file);
  return text;
}

/// Whether the file is STL as text, by its first word; one whose size is that of the binary form is that, whatever its
/// heading says.
bool is_stl_text(const std::string& beginning, std::uintmax_t size) {
  constexpr std::size_t kHeading = 80;
  if (beginning.size() >= kHeading + 4) {
    std::uintmax_t n_triangles = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      n_triangles |= std::uintmax_t{static_cast<unsigned char>(beginning[kHeading + k])} << (8 * k);
    }
    if (size == kHeading + 4 + 50 * n_triangles) {
      return false;
    }
  }
  std::string word;
  for (const char c : beginning) {
    if (is_blank(c) && !word.empty()) {
      break;
    }
    if (!is_blank(c)) {
      word.push_back(lower(c));
    }
  }
  return word == "solid";
}

/// Where the number of faces stands in an .off file that has points and no face.
std::optional<std::size_t> place_of_zero_faces(const std::string& beginning) {
  std::size_t n_words = 0;
  for (std::size_t at = 0; at < beginning.size();) {
    if (is_blank(beginning[at])) {
      ++at;
      continue;
    }
    const bool is_comment = beginning[at] == '#';
    std::size_t end = at;
    while (end < beginning.size() && (is_comment ? beginning[end] != '\n' : !is_blank(beginning[end]))) {
      ++end;
    }
    const std::string word = beginning.substr(at, end - at);
    if (!is_comment && (n_words > 0 || !word.ends_with("OFF"))) {
      ++n_words;
      const bool is_number = std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
      if (!is_number || (word == "0") == (n_words == 1)) {
        return std::nullopt;
      }
      if (n_words == 2) {
        return at;
      }
    }
    at = end;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ShownText> text_for_assimp(const std::string& extension, std::FILE* file, std::uintmax_t size) {
  if (extension == ".obj") {
    return ShownText{with_leading_zeros(file)};
  }
  if (extension == ".stl" && is_stl_text(beginning_of(file), size)) {
    return ShownText{in_lower_case(file)};
  }
  if (extension == ".off") {
    if (const std::optional<std::size_t> place = place_of_zero_faces(beginning_of(file))) {
      ShownText shown{{}, true};
      for_each_character(file, [&](char c) { shown.text.push_back(c); });
      if (*place < shown.text.size()) {  // the file may have been changed meanwhile
        shown.text[*place] = '1';
      }
      shown.text += "\n1 0\n";
      return shown;
    }
  }
  return std::nullopt;
}

}  // namespace vex
