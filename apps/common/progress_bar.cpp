#include "apps/common/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

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

}  // namespace

double fraction_done(const Progress& progress, const StopRule& stop) {
  const double n = static_cast<double>(progress.tally.n_trials);
  double fraction = n / static_cast<double>(std::min(stop.trials.value_or(stop.max_trials), stop.max_trials));
  if (stop.seconds) fraction = std::max(fraction, progress.seconds / *stop.seconds);
  if (stop.relative_error && progress.tally.n_hits > 0 && progress.tally.n_misses() > 0) {
    // The error falls with the square root of the trials; and neither hits nor misses may be too few.
    const double error = hit_or_miss_estimate(progress.tally, 1.0).relative_error();
    const double enough = static_cast<double>(std::min(progress.tally.n_hits, progress.tally.n_misses())) /
                          static_cast<double>(kMinHitsAndMisses);
    fraction = std::max(fraction, std::min(enough, std::pow(*stop.relative_error / error, 2.0)));
  }
  return std::clamp(fraction, 0.0, 1.0);
}

ProgressBar::ProgressBar(bool wanted, const StopRule& stop) : enabled_(wanted && isatty(STDERR_FILENO) != 0), stop_(stop) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(const Progress& progress) {
  if (!enabled_ || progress.tally.n_trials == 0) return;
  constexpr int kWidth = 30;
  const double fraction = fraction_done(progress, stop_);
  const int filled = static_cast<int>(fraction * kWidth);
  std::string line = "\r\033[K[" + std::string(static_cast<std::size_t>(filled), '#') +
                     std::string(static_cast<std::size_t>(kWidth - filled), ' ') + "] ";
  const double n = static_cast<double>(progress.tally.n_trials);
  line += short_number(std::floor(100.0 * fraction), 3) + " %  " + short_count(n) + " trials  " +
          short_count(n / progress.seconds) + "/s";
  if (progress.tally.n_hits > 0) {
    line += "  rel. error " + short_number(hit_or_miss_estimate(progress.tally, 1.0).relative_error(), 2);
  }
  if (fraction > 0.0) line += "  " + duration(progress.seconds * (1.0 - fraction) / fraction) + " left";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace vex
