// A file of poses, read line by line as it comes: in constant memory, and from a pipe without waiting for more than is
// there.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/vex_pair/pose_text.h"

namespace vex {

/// Some consecutive rows of a file, as text.
struct RowBlock {
  struct Row {
    std::size_t begin = 0, size = 0;  // of `text`
    std::uint64_t line = 0;           // of the file, from 1
    bool is_too_long = false;         // then its text was not kept
  };
  std::uint64_t first_index = 0;  // of its first row among the file's rows of data
  std::string text;
  std::vector<Row> rows;

  std::string_view text_of(const Row& row) const { return std::string_view(text).substr(row.begin, row.size); }
  void clear();
};

class PoseFile {
 public:
  /// No row that is meant to be one is longer.
  static constexpr std::size_t kLongestLine = 1 << 16;
  /// A device may never end a line: what is longer than this is a row that is too long, and nothing behind it is read.
  static constexpr std::size_t kLongestSkipped = 1 << 24;

  /// `path`: "-" is standard input. Waiting ends when `interrupt` is not 0. Throws InputError where it cannot be
  /// opened.
  PoseFile(const std::string& path, const std::atomic<int>& interrupt);
  ~PoseFile();
  PoseFile(const PoseFile&) = delete;
  PoseFile& operator=(const PoseFile&) = delete;

  /// Reads the first line; before the rows. `while_waiting`: called several times a second, also below. Throws
  /// InputError where it is not a header of poses.
  void read_header(const std::function<void()>& while_waiting = {});
  PoseFormat format() const { return format_; }

  /// The next rows: at most `n_most`, fewer where no more have arrived yet, none at the end or when interrupted. Lines
  /// that hold nothing are rows only if one that holds something follows. Throws InputError where reading fails.
  void read_rows(std::size_t n_most, RowBlock& block, const std::function<void()>& while_waiting = {});

  /// Of the last line, once the file has ended, if it has no end of its own and is not empty; otherwise 0.
  std::uint64_t open_line() const { return open_line_; }
  /// For messages: the path, or that it is standard input.
  const std::string& name() const { return name_; }

 private:
  enum class Found { line, nothing_yet, end };

  // The next line without its end. `wait`: until there is one, the file ends, or the program is interrupted.
  Found next_line(bool wait, std::string_view& line, bool& is_too_long);
  // More bytes of the file.
  Found fetch(bool wait);

  std::function<void()> while_waiting_;

  int file_ = -1;
  std::string name_;
  const std::atomic<int>& interrupt_;
  PoseFormat format_ = PoseFormat::matrix;

  std::string buffer_;  // what was read and not yet given out from begin_ on
  std::size_t begin_ = 0;
  std::size_t searched_ = 0;  // no line ends before
  bool at_end_ = false;
  bool skips_line_ = false;    // the rest of a line that is too long
  bool is_endless_ = false;    // the last line was longer than kLongestSkipped
  std::size_t n_skipped_ = 0;  // of the line at hand

  std::uint64_t n_lines_ = 0, n_rows_ = 0, open_line_ = 0;
  std::uint64_t n_empty_ = 0;  // lines that hold nothing, before the held one or the end
  bool holds_line_ = false;    // a line behind empty ones, which come first
  std::string held_line_;
  bool held_is_too_long_ = false;
};

}  // namespace vex
