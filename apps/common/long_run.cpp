#include "apps/common/long_run.h"

#include <array>
#include <cstddef>
#include <iostream>
#include <utility>

#include "apps/common/numbers.h"

namespace vex {
namespace {

constexpr double kLongEnoughToTell = 2.0, kHour = 3600.0;  // seconds

}  // namespace

std::string about_time(double seconds, int n_threads) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr double kDay = 24.0 * kHour, kYear = 365.25 * kDay;
  constexpr std::array<Unit, 5> kUnits{
      {{1.0, " s"}, {60.0, " min"}, {kHour, " h"}, {kDay, " days"}, {kYear, " years"}}};
  std::size_t k = 0;
  while (k + 1 < kUnits.size() && seconds >= 2.0 * kUnits[k + 1].seconds) ++k;
  const double number = seconds / kUnits[k].seconds;
  return "about " + (number < 10.0 ? short_number(number, 2) : fixed_number(0, number)) + kUnits[k].name + " on " +
         std::to_string(n_threads) + (n_threads == 1 ? " thread" : " threads");
}

std::string checkpoint_advice(double seconds, const CheckpointOptions& options) {
  return seconds <= kHour || !options.checkpoint.empty() ? "" : " - --checkpoint FILE saves what is done";
}

LongRun::LongRun(std::string what, bool wanted, int n_threads, const CheckpointOptions& options)
    : what_(std::move(what)), is_open_(wanted), n_threads_(n_threads), options_(options) {}

void LongRun::look(double seconds, const std::function<double()>& share_done,
                   const std::function<void()>& before_message) {
  if (!is_open_ || seconds < kLongEnoughToTell) return;
  const double share = share_done();
  if (!(share > 0.0)) return;
  is_open_ = false;
  const double whole = seconds / share;
  if (whole <= kHour) return;
  before_message();
  std::cerr << what_ << " will take " << about_time(whole, n_threads_) << checkpoint_advice(whole, options_) << "\n";
}

}  // namespace vex
