// How long a run will take, said where that is long.
#pragma once

#include <functional>
#include <string>

#include "apps/common/checkpoint.h"

namespace vex {

/// "about 3 days on 2 threads", to one or two digits: what is foreseen is right to a factor of two or three.
std::string about_time(double seconds, int n_threads);

/// What to do about a run of so many seconds whose state is not saved, more than an hour; otherwise empty.
std::string checkpoint_advice(double seconds, const CheckpointOptions& options);

/// Tells of a run that no pilot foresees, once it has gone on for two seconds, that it will take more than an hour,
/// where it will: on standard error, once.
class LongRun {
 public:
  /// `what` will take so long, of this program.
  LongRun(std::string what, bool wanted, int n_threads, const CheckpointOptions& options);

  /// `share_done` of the run in so many seconds, 0 where that is not known yet; asked only as long as it matters.
  void look(double seconds, const std::function<double()>& share_done, const std::function<void()>& before_message);

 private:
  std::string what_;
  bool is_open_;
  int n_threads_;
  const CheckpointOptions& options_;
};

}  // namespace vex
