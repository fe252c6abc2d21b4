#include "apps/common/status_line.h"

#include <unistd.h>

#include <cstdio>

#include "apps/common/numbers.h"

namespace vex {

StatusLine::StatusLine(bool wanted) : enabled_(wanted && isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() { erase(); }

void StatusLine::erase() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

bool StatusLine::is_due() const {
  constexpr std::chrono::milliseconds kBetween{200};
  return enabled_ && Clock::now() - shown_ >= kBetween;
}

void StatusLine::show(const std::string& text) {
  if (!is_due()) return;
  shown_ = Clock::now();
  const double seconds = std::chrono::duration<double>(shown_ - start_).count();
  std::fprintf(stderr, "\r\033[K%s, %s s", text.c_str(), fixed_number(0, seconds).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace vex
