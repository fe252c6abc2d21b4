#include "apps/vex_mesh/announcement.h"

#include <cmath>

#include "apps/common/long_run.h"
#include "apps/common/numbers.h"

namespace vex {
namespace {

constexpr double kMoment = 2.0;  // seconds

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
    text = estimator + " will take " + about_time(outlook.seconds, options.n_threads);
    if (outlook.gives_up) {
      text += ", and reach --max-trials before it is done";
    } else if (settings.rel_error && !settings.trials && !settings.seconds) {
      text += ", to a relative error of " + short_number(*settings.rel_error, 3);
    }
  }
  return text + checkpoint_advice(outlook.seconds, options.checkpoint) + "\n";
}

}  // namespace vex
