// How a run came to its result: the estimate after so many trials.
#pragma once

#include <vector>

#include "shapes/estimators/excluded_volume.h"

namespace vex {

struct HistoryPoint {
  std::uint64_t n_trials;
  double value, std_error;
};

/// What a run says of itself several times a second: at most some hundred moments of it, spread over its trials however
/// long it is.
class History {
 public:
  void add(const Progress& progress);
  const std::vector<Tally>& tallies() const { return tallies_; }

 private:
  std::vector<Tally> tallies_;
  std::uint64_t next_ = 0;
};

/// The estimates on the way, in the order of their trials, and the result as the last one. Of a run that was too short
/// to say anything the first half of its trials, quarter, ... are made again, which are the same ones: that takes no
/// longer than the run did, and changes nothing of its result.
std::vector<HistoryPoint> history_of(const ExcludedVolume& result, const History& seen, const Body& a, const Body& b,
                                     const ExcludedVolumeSettings& settings);

}  // namespace vex
