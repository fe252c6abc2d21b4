// What an answer about a motion says, apart from whether it is true (internal).
#pragma once

#include <cmath>
#include <string>

#include "engine/query/first_contact.h"

namespace vex::checker {

/// What is wrong with the verdict and the times by themselves; empty where nothing is.
inline std::string fault_of_statement(const FirstContact& claimed, double until) {
  const double time = claimed.time, lower = claimed.lower, upper = claimed.upper;
  if (!(until >= 0.0)) return "the end is no time";
  switch (claimed.verdict.outcome) {
    case Outcome::disjoint:
      if (!(time == HUGE_VAL && lower == HUGE_VAL && upper == HUGE_VAL)) return "there is a time of no contact";
      return {};
    case Outcome::overlap:
      if (!(upper < HUGE_VAL)) return "the upper bound is no time";
      if (upper > until) return "the contact is after the end";
      break;
    case Outcome::undecided:
      if (upper != HUGE_VAL) return "an upper bound is claimed and no contact";
      break;
    default: return "the verdict is none";
  }
  if (!(lower >= 0.0 && lower < HUGE_VAL)) return "the lower bound is no time";
  if (!(lower <= time && time <= upper)) return "the time is not between its bounds";
  return {};
}

}  // namespace vex::checker
