// What an overlap query answers: proven disjoint, proven overlapping, or not decided, and why.
#pragma once

#include <cstdint>
#include <string_view>

namespace vex {

enum class Outcome : std::uint8_t {
  disjoint,   // a direction separates the bodies
  overlap,    // the bodies share a point
  undecided,  // neither was proven
};

/// Which stage of a query spoke.
enum class DecidedBy : std::uint8_t {
  outer_bound,    // the circumscribed balls do not meet
  inner_bound,    // the inscribed balls meet
  gjk,            // a separating direction, or a simplex around the origin, in double precision
  double_double,  // the same in twice the precision, for curved bodies that nearly touch
  exact,          // rational arithmetic, for polytopes, rounded or not, that double precision leaves open
  peer,           // another library, which proves nothing
};
inline constexpr int kNDecidedBy = 6;

enum class UndecidedReason : std::uint16_t {
  none,
  rounding,       // the bodies touch to within the rounding bound of the query
  iteration_cap,  // the search was given up
};

/// Four bytes without a gap, so that tallies may compare it as one word.
struct Verdict {
  Outcome outcome = Outcome::undecided;
  DecidedBy by = DecidedBy::gjk;
  UndecidedReason reason = UndecidedReason::none;

  static constexpr Verdict disjoint(DecidedBy by) { return {Outcome::disjoint, by, UndecidedReason::none}; }
  static constexpr Verdict overlap(DecidedBy by) { return {Outcome::overlap, by, UndecidedReason::none}; }
  static constexpr Verdict undecided(DecidedBy by, UndecidedReason reason) { return {Outcome::undecided, by, reason}; }

  friend constexpr bool operator==(const Verdict&, const Verdict&) = default;
};

constexpr std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::disjoint: return "disjoint";
    case Outcome::overlap: return "overlap";
    case Outcome::undecided: break;
  }
  return "undecided";
}

constexpr std::string_view name_of(DecidedBy by) {
  switch (by) {
    case DecidedBy::outer_bound: return "outer_bound";
    case DecidedBy::inner_bound: return "inner_bound";
    case DecidedBy::gjk: return "gjk";
    case DecidedBy::double_double: return "double_double";
    case DecidedBy::exact: return "exact";
    case DecidedBy::peer: break;
  }
  return "peer";
}

constexpr std::string_view name_of(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::none: return "none";
    case UndecidedReason::rounding: return "rounding";
    case UndecidedReason::iteration_cap: break;
  }
  return "iteration_cap";
}

}  // namespace vex
