#include "apps/vex_mesh/announcement.h"

#include <array>
#include <cmath>

#include "apps/common/numbers.h"

namespace vex {
namespace {

constexpr double kMoment = 2.0, kHour = 3600.0;  // seconds

// To one or two digits: it is right to a factor of two or three.
std::string about(double seconds) {
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
  return (number < 10.0 ? short_number(number, 2) : fixed_number(0, number)) + kUnits[k].name;
}

}  // namespace

std::string announcement(const Outlook& outlook, const Options& options) {
  const ExcludedVolumeSettings& settings = options.settings;
  if (outlook.seconds < kMoment) return "";
  const std::string estimator =
      std::string(outlook.estimator->name) + (outlook.sequence == Sequence::sobol ? " with Sobol' points" : "");
  std::string text;
  if (!std::isfinite(outlook.seconds)) {
    text = "how long " + estimator + " will take its pilot could not tell: it found no error of the estimate";
  } else {
    text = estimator + " will take about " + about(outlook.seconds) + " on " + std::to_string(options.n_threads) +
           (options.n_threads == 1 ? " thread" : " threads");
    if (outlook.gives_up) {
      text += ", and reach --max-trials before it is done";
    } else if (settings.rel_error && !settings.trials && !settings.seconds) {
      text += ", to a relative error of " + short_number(*settings.rel_error, 3);
    }
  }
  if (!(outlook.seconds <= kHour) && options.checkpoint.checkpoint.empty()) {
    text += " - --checkpoint FILE saves what is done";
  }
  return text + "\n";
}

}  // namespace vex
