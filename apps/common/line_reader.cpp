#include "apps/common/line_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "apps/common/pose_numbers.h"
#include "engine/numeric/errors.h"

namespace vex {

std::string open_line_warning(const std::string& name, std::uint64_t line) {
  return name + ", line " + std::to_string(line) +
         ": the last line has no end - if the file was cut off there, fetch it again; if it is whole, end it with a "
         "newline, and this is not said";
}

LineReader::LineReader(const std::string& path, std::string what, std::string advice)
    : name_(path == "-" ? "standard input" : path), what_(std::move(what)), advice_(std::move(advice)) {
  file_ = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) {
    throw InputError(what_ + " cannot be read (" + name_ + ": " + std::strerror(errno) + ") - " + advice_);
  }
}

LineReader::~LineReader() {
  if (file_ != STDIN_FILENO) close(file_);
}

bool LineReader::fetch() {
  constexpr std::size_t kAtOnce = 1 << 20;
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t n_before = buffer_.size();
  buffer_.resize(n_before + kAtOnce);
  ssize_t n = 0;
  do {
    n = read(file_, buffer_.data() + n_before, kAtOnce);
  } while (n < 0 && errno == EINTR);
  const int error = errno;
  buffer_.resize(n_before + (n > 0 ? static_cast<std::size_t>(n) : 0));
  if (n < 0) {
    throw InputError(what_ + " cannot be read (" + name_ + ": " + std::strerror(error) + ") - " + advice_);
  }
  return n > 0;
}

bool LineReader::next(std::string_view& line) {
  std::size_t searched = begin_;
  for (;;) {
    const std::size_t end = buffer_.find('\n', searched);
    const bool is_last = end == std::string::npos && at_end_;
    if (is_last && begin_ == buffer_.size()) return false;
    if (end != std::string::npos || is_last) {
      line = std::string_view(buffer_).substr(begin_, (is_last ? buffer_.size() : end) - begin_);
      begin_ = is_last ? buffer_.size() : end + 1;
      ++number_;
      if (is_last && !without_blanks(line).empty()) open_line_ = number_;
      if (line.find('\0') != std::string_view::npos) {
        throw InputError(name_ + ", line " + std::to_string(number_) + ": a zero byte, which no text has - " + advice_);
      }
      if (line.size() <= kLongestLine) return true;
    } else if (buffer_.size() - begin_ <= kLongestLine) {
      searched = buffer_.size() - begin_;  // of the buffer without what was read
      at_end_ = !fetch();
      continue;
    } else {
      ++number_;
    }
    throw InputError(name_ + ", line " + std::to_string(number_) + ": too long (more than " +
                     std::to_string(kLongestLine) + " characters) - write one body a line");
  }
}

}  // namespace vex
