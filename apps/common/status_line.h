// A line on the terminal that says what a program is doing.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace vex {

/// Written on standard error, only where that is a terminal and `wanted`; erased at the end. Whether or not, SIGUSR1 is
/// answered with a line (interrupt.h).
class StatusLine {
 public:
  explicit StatusLine(bool wanted);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Shows "program: what is done", with the seconds since the start, unless the last one was shown just before.
  void show(const std::string& program, const std::function<std::string()>& doing);
  void erase();

 private:
  bool is_due() const;

  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
  bool enabled_, drawn_ = false;
};

}  // namespace vex
