// A file line by line, whatever its size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace vex {

/// A warning: where a file was cut off in this line, a part of its last number may look like a number.
std::string open_line_warning(const std::string& name, std::uint64_t line);

class LineReader {
 public:
  /// No row that is meant to be one is longer.
  static constexpr std::size_t kLongestLine = 1 << 16;

  /// `path`: "-" is standard input. Throws InputError where it cannot be opened; `what` says in messages what it holds,
  /// and `advice` what to do where it cannot be read.
  LineReader(const std::string& path, std::string what,
             std::string advice = "give a CSV file, or - for standard input");
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The next line without its end, good until the next call; false at the end of the file. Throws InputError where
  /// reading fails, and for a line that is too long.
  bool next(std::string_view& line);
  /// Of the last line, from 1 on.
  std::uint64_t number() const { return number_; }
  /// For messages: the path, or that it is standard input.
  const std::string& name() const { return name_; }
  /// Of the last line, once the file has ended, if it has no end of its own and is not empty; otherwise 0.
  std::uint64_t open_line() const { return open_line_; }

 private:
  bool fetch();  // more bytes behind those that are left; false at the end

  int file_ = -1;
  std::string name_, what_, advice_;
  std::string buffer_;
  std::size_t begin_ = 0;
  bool at_end_ = false;
  std::uint64_t number_ = 0, open_line_ = 0;
};

}  // namespace vex
