#include "apps/common/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"

namespace vex {
namespace {

std::string duration(double seconds) {
  if (!(seconds < 100.0 * 3600.0)) return "long";
  const long whole = std::lround(seconds);
  char text[32];
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

std::size_t terminal_width() {
  struct winsize size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

double fraction_done(const Progress& progress) {
  const StopRule& stop = progress.stop;
  const double n = static_cast<double>(progress.tally.n_trials);
  double fraction = n / static_cast<double>(std::min(stop.trials.value_or(stop.max_trials), stop.max_trials));
  if (stop.seconds) fraction = std::max(fraction, progress.seconds / *stop.seconds);
  const ClassTally& by_class = progress.tally.by_class;
  if (stop.relative_error && by_class.kind != ClassTally::Kind::none && !by_class.are_hits) {
    fraction = std::max(fraction, std::pow(*stop.relative_error / progress.relative_error, 2.0));
  } else if (stop.relative_error && progress.tally.n_hits > 0 && progress.tally.n_misses() > 0) {
    // The error falls with the square root of the trials; and neither hits nor misses may be too few.
    const double enough = static_cast<double>(std::min(progress.tally.n_hits, progress.tally.n_misses())) /
                          static_cast<double>(kMinHitsAndMisses);
    fraction = std::max(fraction, std::min(enough, std::pow(*stop.relative_error / progress.relative_error, 2.0)));
  }
  return std::clamp(fraction, 0.0, 1.0);
}

ProgressBar::ProgressBar(bool wanted, std::string label)
    : enabled_(wanted && isatty(STDERR_FILENO) != 0), label_(std::move(label)) {}

ProgressBar::~ProgressBar() { erase(); }

void ProgressBar::erase() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void ProgressBar::show(const Progress& progress) {
  answer_if_asked([&] {
    if (drawn_) std::fputs("\r\033[K", stderr);
    return label_ + progress_text(progress);
  });
  if (!enabled_ || progress.tally.n_trials == 0 || progress.seconds < next_seconds_) return;
  next_seconds_ = progress.seconds + kSecondsBetween;
  const std::size_t width = terminal_width();
  const std::size_t label_width = std::min(label_.size(), width);
  const std::string line = "\r\033[K" + label_.substr(0, label_width) + progress_line(progress, width - label_width);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

std::string progress_text(const Progress& progress) {
  const double fraction = fraction_done(progress);
  const double n = static_cast<double>(progress.tally.n_trials);
  std::string text = short_number(std::floor(100.0 * fraction), 3) + " %  ";
  if (fraction > 0.0) text += duration(progress.seconds * (1.0 - fraction) / fraction) + " left  ";
  text += short_count(n) +
          (progress.tally.by_class.kind == ClassTally::Kind::none || progress.tally.by_class.are_hits ? " trials  "
                                                                                                      : " values  ") +
          short_count(n / progress.seconds) + "/s";
  if (std::isfinite(progress.relative_error)) {
    text += "  rel. error " + short_number(progress.relative_error, 2);
  }
  return text;
}

std::string progress_line(const Progress& progress, std::size_t width) {
  const std::string text = progress_text(progress);
  // A line that reaches the terminal's edge goes on in the next one, where erasing it does not reach.
  constexpr std::size_t kWidest = 30;
  constexpr std::size_t kNarrowest = 5;
  const std::size_t around = text.size() + std::string("[] ").size() + 1;
  if (width < around + kNarrowest) return text.substr(0, width > 0 ? width - 1 : 0);
  const std::size_t bar = std::min(kWidest, width - around);
  const auto filled = static_cast<std::size_t>(fraction_done(progress) * static_cast<double>(bar));
  return "[" + std::string(filled, '#') + std::string(bar - filled, ' ') + "] " + text;
}

}  // namespace vex
