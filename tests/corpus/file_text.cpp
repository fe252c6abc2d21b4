#include "file_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace vex::tests {
namespace {

std::size_t place_of(const std::string& text, std::string_view what, bool last = false) {
  const std::size_t place = last ? text.rfind(what) : text.find(what);
  if (place == std::string::npos) throw std::logic_error("the row's text holds no '" + std::string(what) + "'");
  return place;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// `change` gets every line with its number.
std::string by_lines(const std::string& text, const std::function<std::string(std::string, std::size_t)>& change) {
  std::string result;
  std::size_t number = 0;
  for (const std::string& line : lines_of(text)) result += change(line, ++number);
  return result;
}

}  // namespace

std::string shortest(double value) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string printed(const char* format, double value) {
  std::array<char, 60> digits{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(digits.data(), digits.size(), format, value);
#pragma GCC diagnostic pop
  return digits.data();
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  return text.replace(place_of(text, what), what.size(), by);
}
std::string replaced_last(std::string text, std::string_view what, std::string_view by) {
  return text.replace(place_of(text, what, true), what.size(), by);
}
std::string replaced_all(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = place_of(text, what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}
std::string without(std::string text, std::string_view what) { return replaced(std::move(text), what, ""); }
std::string up_to(const std::string& text, std::string_view what) { return text.substr(0, place_of(text, what)); }
std::string up_to_last(const std::string& text, std::string_view what) {
  return text.substr(0, place_of(text, what, true));
}
std::string without_last(std::string bytes, std::size_t n) {
  bytes.resize(bytes.size() - n);
  return bytes;
}

std::string with_line(const std::string& text, std::size_t number, std::string_view line) {
  return by_lines(
      text, [&](const std::string& old, std::size_t n) { return (n == number ? std::string(line) : old) + "\n"; });
}
std::string without_line(const std::string& text, std::size_t number) {
  return by_lines(text, [&](const std::string& old, std::size_t n) { return n == number ? "" : old + "\n"; });
}
std::string with_line_behind(const std::string& text, std::size_t number, std::string_view line) {
  const std::string added = std::string(line) + "\n";
  if (number == 0) return added + text;
  return by_lines(text, [&](const std::string& old, std::size_t n) { return old + "\n" + (n == number ? added : ""); });
}
std::string with_line_behind_every(const std::string& text, std::string_view line) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return old + "\n" + std::string(line) + "\n"; });
}
std::string with_at_every_line_end(const std::string& text, std::string_view what) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return old + std::string(what) + "\n"; });
}
std::string with_at_every_line_start(const std::string& text, std::string_view what) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return std::string(what) + old + "\n"; });
}
std::string with_byte(std::string bytes, std::size_t at, unsigned value) {
  bytes.at(at) = static_cast<char>(static_cast<unsigned char>(value));
  return bytes;
}
std::string in_upper_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string with_crlf(const std::string& text) { return replaced_all(text, "\n", "\r\n"); }
std::string with_cr(const std::string& text) { return replaced_all(text, "\n", "\r"); }
std::string with_bom(const std::string& text) { return "\xEF\xBB\xBF" + text; }
std::string without_final_newline(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::string step_text() {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('part.stp','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.,0.));\nENDSEC;\n"
         "END-ISO-10303-21;\n";
}
std::string medit_text() {
  return "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         "Triangles\n4\n1 3 2 0\n1 2 4 0\n2 3 4 0\n1 4 3 0\nEnd\n";
}
std::string html_text() {
  return "<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head>\n<body><p>The page was not found.</p></body>"
         "</html>\n";
}

}  // namespace vex::tests
