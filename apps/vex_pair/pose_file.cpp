#include "apps/vex_pair/pose_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "apps/common/pose_numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

[[noreturn]] void cannot_be_read(const std::string& name, int error) {
  throw InputError("the poses cannot be read (" + name + ": " + std::strerror(error) +
                   ") - give a CSV file, or - for standard input");
}

}  // namespace

void RowBlock::clear() {
  text.clear();
  rows.clear();
}

PoseFile::PoseFile(const std::string& path, const std::atomic<int>& interrupt)
    : name_(path == "-" ? "standard input" : path), interrupt_(interrupt) {
  file_ = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) cannot_be_read(name_, errno);
}

PoseFile::~PoseFile() {
  if (file_ != STDIN_FILENO) close(file_);
}

PoseFile::Found PoseFile::fetch(bool wait) {
  constexpr std::size_t kAtOnce = 1 << 18;
  constexpr int kMilliseconds = 50;  // a signal that comes just before the wait is seen this much later
  for (;;) {
    if (interrupt_.load() != 0) return Found::end;
    pollfd readable = {file_, POLLIN, 0};
    const int n_ready = poll(&readable, 1, wait ? kMilliseconds : 0);
    if (n_ready < 0 && errno != EINTR) cannot_be_read(name_, errno);
    if (n_ready > 0) break;
    if (!wait) return Found::nothing_yet;
    if (while_waiting_) while_waiting_();
  }
  buffer_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  const std::size_t n_before = buffer_.size();
  buffer_.resize(n_before + kAtOnce);
  const ssize_t n = read(file_, buffer_.data() + n_before, kAtOnce);
  const int error = errno;
  buffer_.resize(n_before + (n > 0 ? static_cast<std::size_t>(n) : 0));
  if (n == 0) return Found::end;
  if (n < 0 && error != EINTR && error != EAGAIN) cannot_be_read(name_, error);
  return Found::line;
}

PoseFile::Found PoseFile::next_line(bool wait, std::string_view& line, bool& is_too_long) {
  if (is_endless_) return Found::nothing_yet;
  for (;;) {
    std::size_t end = buffer_.find('\n', searched_);
    const bool is_last = end == std::string::npos && at_end_;
    if (is_last) end = buffer_.size();
    if (end != std::string::npos) {
      if (is_last && begin_ == end && !skips_line_) return Found::end;
      line = std::string_view(buffer_).substr(begin_, end - begin_);
      is_too_long = skips_line_ || line.size() > kLongestLine;
      if (is_too_long) line = {};
      skips_line_ = false;
      begin_ = searched_ = is_last ? end : end + 1;
      ++n_lines_;
      if (is_last && !is_too_long && !without_blanks(line).empty()) open_line_ = n_lines_;
      return Found::line;
    }
    if (buffer_.size() - begin_ > kLongestLine) {
      n_skipped_ = (skips_line_ ? n_skipped_ : 0) + (buffer_.size() - begin_);
      skips_line_ = true;
      begin_ = buffer_.size();
      if (n_skipped_ > kLongestSkipped) {
        line = {};
        is_too_long = is_endless_ = true;
        ++n_lines_;
        return Found::line;
      }
    }
    searched_ = buffer_.size();
    switch (fetch(wait)) {
      case Found::line: break;
      case Found::nothing_yet: return Found::nothing_yet;
      case Found::end:
        // What an interrupt leaves of a line is none.
        if (interrupt_.load() != 0) return Found::end;
        at_end_ = true;
    }
  }
}

void PoseFile::read_header(const std::function<void()>& while_waiting) {
  while_waiting_ = while_waiting;
  std::string_view line;
  bool is_too_long = false;
  if (next_line(true, line, is_too_long) == Found::end) {
    if (interrupt_.load() != 0) return;
    throw InputError("the file of poses is empty (" + name_ + ") - its first line is " + kHeaders);
  }
  if (is_too_long) {
    throw InputError(name_ + ", line 1: too long a header (more than " + std::to_string(kLongestLine) +
                     " characters) - it is " + kHeaders);
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.substr(0, kByteOrderMark.size()) == kByteOrderMark) line.remove_prefix(kByteOrderMark.size());
  try {
    format_ = format_of_header(line);
  } catch (const InputError& error) {
    throw InputError(name_ + ", line 1: " + error.what());
  }
}

void PoseFile::read_rows(std::size_t n_most, RowBlock& block, const std::function<void()>& while_waiting) {
  while_waiting_ = while_waiting;
  block.clear();
  if (is_endless_) {
    throw InputError(name_ + ", line " + std::to_string(n_lines_) + ": no end of the line within " +
                     std::to_string(kLongestSkipped) + " characters, so that nothing behind it was read - write one " +
                     "pose a line");
  }
  block.first_index = n_rows_;
  const auto add = [&](std::string_view line, std::uint64_t number, bool is_too_long) {
    block.rows.push_back({block.text.size(), line.size(), number, is_too_long});
    block.text += line;
    ++n_rows_;
  };
  constexpr std::size_t kLongestBlock = 1 << 22;  // of text
  while (block.rows.size() < n_most && block.text.size() < kLongestBlock) {
    if (holds_line_) {
      if (n_empty_ > 0) {
        add("", n_lines_ - n_empty_, false);
        --n_empty_;
      } else {
        add(held_line_, n_lines_, held_is_too_long_);
        holds_line_ = false;
      }
      continue;
    }
    std::string_view line;
    bool is_too_long = false;
    const bool may_wait = block.rows.empty();
    if (next_line(may_wait, line, is_too_long) != Found::line) return;
    if (!is_too_long && without_blanks(line).empty()) {
      ++n_empty_;
    } else if (n_empty_ > 0) {
      held_line_ = line;
      held_is_too_long_ = is_too_long;
      holds_line_ = true;
    } else {
      add(line, n_lines_, is_too_long);
    }
  }
}

}  // namespace vex
