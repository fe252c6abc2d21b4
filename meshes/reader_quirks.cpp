#include "meshes/reader_quirks.h"

#include <algorithm>
#include <cstddef>

namespace vex {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// All there is from here on; `size` is what the file had when it was opened.
std::string rest_of(std::FILE* file, std::uintmax_t size) {
  std::string text(static_cast<std::size_t>(size) + 1, '\0');  // the last character only meets the end
  std::size_t n = 0;
  while (const std::size_t n_more = std::fread(text.data() + n, 1, text.size() - n, file)) {
    n += n_more;
    if (n == text.size()) {
      text.resize(2 * n);
    }
  }
  text.resize(n);
  return text;
}

/// Whether the point there starts a number: assimp reads none from ".5".
bool is_bare_point(const std::string& text, std::size_t at) {
  const bool starts_a_word = at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t';
  return starts_a_word && at + 1 < text.size() && text[at + 1] >= '0' && text[at + 1] <= '9';
}

/// From the back, in place: a mesh has millions of such points, and a list of them would be larger than its text.
std::string with_leading_zeros(std::string text) {
  std::size_t n_left = 0;
  for (std::size_t at = text.find('.'); at != std::string::npos; at = text.find('.', at + 1)) {
    if (is_bare_point(text, at)) ++n_left;
  }
  std::size_t end = text.size();  // of what has not been moved
  text.resize(end + n_left);
  for (std::size_t at = end; n_left > 0;) {
    at = text.rfind('.', at - 1);
    if (is_bare_point(text, at)) {  // what has been moved lies behind its digit
      const auto from = text.begin() + static_cast<std::ptrdiff_t>(at);
      const auto to_end = text.begin() + static_cast<std::ptrdiff_t>(end + n_left);
      *(std::move_backward(from, text.begin() + static_cast<std::ptrdiff_t>(end), to_end) - 1) = '0';
      end = at;
      --n_left;
    }
  }
  return text;
}

std::string in_lower_case(std::string text) {
  text.erase(text.begin(), std::ranges::find_if_not(text, is_blank));
  std::ranges::transform(text, text.begin(), lower);
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
    return ShownText{with_leading_zeros(rest_of(file, size))};
  }
  if (extension == ".stl" && is_stl_text(beginning_of(file), size)) {
    return ShownText{in_lower_case(rest_of(file, size))};
  }
  if (extension == ".off") {
    if (const std::optional<std::size_t> place = place_of_zero_faces(beginning_of(file))) {
      ShownText shown{rest_of(file, size), true};
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
