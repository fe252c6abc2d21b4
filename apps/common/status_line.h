// A line on the terminal that says what a program is doing.
#pragma once

#include <chrono>
#include <string>

namespace vex {

/// Written on standard error, only where that is a terminal and `wanted`; erased at the end.
class StatusLine {
 public:
  explicit StatusLine(bool wanted);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool is_due() const;
  /// Shows the text with the seconds since the start, unless the last one was shown just before.
  void show(const std::string& text);
  void erase();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
  bool enabled_, drawn_ = false;
};

}  // namespace vex
