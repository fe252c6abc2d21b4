// One line on the terminal that says how far a run is.
#pragma once

#include <cstddef>
#include <string>

#include "engine/sampling/monte_carlo.h"

namespace vex {

/// Drawn on standard error, only where that is a terminal and `wanted`; erased at the end. Whether or not, SIGUSR1 is
/// answered with a line (interrupt.h).
class ProgressBar {
 public:
  /// `label` stands before all else.
  explicit ProgressBar(bool wanted, std::string label = "");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Until it is shown again: before something else is said.
  void erase();

 private:
  static constexpr double kSecondsBetween = 0.1;  // as fast as eyes read

  bool enabled_;
  bool drawn_ = false;
  double next_seconds_ = kSecondsBetween;  // so that a run over in a blink draws nothing
  std::string label_;
};

/// How much of a run is done, 0 to 1: the largest share over its stop rules.
double fraction_done(const Progress& progress);

/// Percentage, remaining time, trials, rate and error.
std::string progress_text(const Progress& progress);

/// The bar and, beside it, the same: shorter than `width` columns.
std::string progress_line(const Progress& progress, std::size_t width);

}  // namespace vex
