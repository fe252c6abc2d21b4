#include "apps/common/status_line.h"

#include <unistd.h>

#include <cstdio>

#include "apps/common/interrupt.h"
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

void StatusLine::show(const std::string& program, const std::function<std::string()>& doing) {
  const auto text = [&] {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    return doing() + ", " + fixed_number(0, seconds) + " s";
  };
  answer_if_asked([&] {
    erase();
    return text();
  });
  if (!is_due()) return;
  shown_ = Clock::now();
  std::fprintf(stderr, "\r\033[K%s: %s", program.c_str(), text().c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace vex
