#include "engine/sampling/run_state.h"

#include "engine/numeric/errors.h"

namespace vex {

BlockRecord& BlockRecord::operator+=(BlockRecord&& more) {
  tally += more.tally;
  undecided += std::move(more.undecided);
  disagreements += std::move(more.disagreements);
  unproven += std::move(more.unproven);
  n_proven_again += more.n_proven_again;
  if (comparisons.size() < more.comparisons.size()) comparisons.resize(more.comparisons.size());
  for (std::size_t c = 0; c < more.comparisons.size(); ++c) comparisons[c] += more.comparisons[c];
  return *this;
}

void RunState::append(RunState&& next) {
  if (next.first_trial != end()) {
    throw InputError("trials that do not follow each other (" + std::to_string(next.first_trial) + " behind " +
                     std::to_string(end()) + ") - give every trial once");
  }
  const Tally &mine = done.tally, &its = next.done.tally;
  const bool have_both = mine.n_trials > 0 && its.n_trials > 0;
  if (domain != next.domain || domain_volume != next.domain_volume ||
      (have_both && !mine.by_class.is_like(its.by_class)) ||
      (have_both && done.comparisons.size() != next.done.comparisons.size())) {
    throw InputError("trials that are counted in another way (those from " + std::to_string(next.first_trial) +
                     " on) - give those of runs with the same settings");
  }
  done += std::move(next.done);
  done.keep_first();
  seconds += next.seconds;
}

}  // namespace vex
