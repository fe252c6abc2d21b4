// A checksum of text, for files that are read back: what is cut off or damaged is found out.
#pragma once

#include <string>
#include <string_view>

namespace vex {

/// zlib's CRC-32 of all text added.
class Checksum {
 public:
  Checksum();
  void add(std::string_view text);
  /// Eight hexadecimal digits.
  std::string digits() const;

 private:
  unsigned long sum_;
};

/// How the last line of a file with a checksum begins.
inline constexpr std::string_view kEndOfFile = "# end";
/// The last line: of this checksum of all lines before it, each with its line feed.
std::string end_line(const Checksum& sum);

}  // namespace vex
