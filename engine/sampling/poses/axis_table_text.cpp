#include "engine/sampling/poses/axis_table_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

/// A zero byte would end the message, and others may steer a terminal.
std::string printable(std::string_view word) {
  std::string text(word);
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& name, const std::string& advice) {
  throw InputError(problem + " (" + name + ") - " + advice);
}

}  // namespace

AxisTable parse_axis_table(std::string_view text, const std::string& name) {
  AxisTable table;
  std::size_t line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end).substr(0, text.substr(0, end).find('#')));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (line.empty()) continue;
    const std::string where = name + ", line " + std::to_string(line_number);
    const auto number = [&](std::string_view word) {
      double value = 0.0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value)) {
        refuse("not a number: \"" + printable(word.substr(0, 40)) + "\"", where,
               "write a cosine and a density, as in 0.5 1.25");
      }
      return value;
    };
    const std::size_t first_end = line.find_first_of(" \t,");
    if (first_end == std::string_view::npos) refuse("one number alone", where, "write a cosine and a density");
    std::string_view rest = trimmed(line.substr(first_end));
    if (!rest.empty() && rest.front() == ',') rest = trimmed(rest.substr(1));
    if (table.cosines.size() == AxisLaw::kMostPoints) {
      refuse("more than " + std::to_string(AxisLaw::kMostPoints) + " points", where, "leave some out");
    }
    table.cosines.push_back(number(line.substr(0, first_end)));
    table.densities.push_back(number(rest));
  }
  return table;
}

AxisTable read_axis_table(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse("a table of a density is not there", path, "correct the name");
  if (!std::filesystem::is_regular_file(status)) refuse("a table of a density is no file", path, "name a file");
  std::ifstream file(path, std::ios::binary);
  std::string text(kLargestAxisTable + 1, '\0');
  if (!file.is_open()) refuse("a table of a density cannot be read", path, "make it readable");
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) refuse("a table of a density cannot be read", path, "make it readable");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestAxisTable) refuse("a table of a density has more than 16 MiB", path, "leave points out");
  return parse_axis_table(text, path);
}

}  // namespace vex
