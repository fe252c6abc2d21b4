// What a run counts. Whole numbers only, fixed-point sums among them: the same for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "engine/numeric/fixed_point_sum.h"
#include "engine/query/verdict.h"

namespace vex {

/// Of the sampling volumes of some of the trials, in units of Domain::volume; or of other values.
struct ShareSums {
  FixedPointSum first;   // of the shares
  FixedPointSum second;  // of their squares

  void add(double share) {
    first.add(share);
    second.add(share * share);
  }
  void add(std::span<const double> shares) {
    first.add(shares);
    std::array<double, 256> squares;
    while (!shares.empty()) {
      const std::size_t n = std::min(shares.size(), squares.size());
      for (std::size_t k = 0; k < n; ++k) squares[k] = shares[k] * shares[k];
      second.add(std::span<const double>(squares).first(n));
      shares = shares.subspan(n);
    }
  }
  ShareSums& operator+=(const ShareSums& other) {
    first += other.first;
    second += other.second;
    return *this;
  }
  friend bool operator==(const ShareSums&, const ShareSums&) = default;
};

/// Of the values of one class of trials (trial_points.h), in units.
struct ClassSums {
  std::uint64_t n = 0;
  ShareSums values;
  ShareSums undecided;  // trials of hit or miss, not among the values: they count half

  ClassSums& operator+=(const ClassSums& other) {
    n += other.n;
    values += other.values;
    undecided += other.undecided;
    return *this;
  }
  friend bool operator==(const ClassSums&, const ClassSums&) = default;
};

/// A run whose estimate is `offset` + `unit` times the mean of values.
struct ClassTally {
  enum class Kind : std::uint8_t {
    none,         // nothing is counted here
    one,          // independent trials
    scramblings,  // each class has a scrambling of its own: the classes' means are independent, trials are not
    strata,       // each class has its share of the values: trials are independent, the mean is that of the classes'
  };

  Kind kind = Kind::none;
  bool is_signed = false;          // the mean may be below 0
  bool are_hits = false;           // a value is a share of the domain, or nothing
  double offset = 0.0;             // length^3
  double unit = 0.0;               // length^3
  double relative_rounding = 0.0;  // of an integrand's values; the other one in length^3
  double absolute_rounding = 0.0;
  std::vector<ClassSums> classes;
  FixedPointSum half_widths;  // of what undecided values of an integrand lie between

  /// Whether values of both are counted in the same way: from one offset, in one unit, in as many classes of one kind.
  bool is_like(const ClassTally& other) const {
    return kind == other.kind && is_signed == other.is_signed && are_hits == other.are_hits && offset == other.offset &&
           unit == other.unit && relative_rounding == other.relative_rounding &&
           absolute_rounding == other.absolute_rounding && classes.size() == other.classes.size();
  }
  /// What an average of this size is off by besides its standard error and its doubts, length^3.
  double rounding_of(double volume) const { return relative_rounding * std::fabs(volume) + absolute_rounding; }

  /// Throws std::logic_error where the other one is not like this: the sum of the two would be of nothing, and no
  /// standard error would show it.
  ClassTally& operator+=(const ClassTally& other) {
    if (!is_like(other)) throw std::logic_error("tallies of unlike offsets, units or kinds were to be added");
    for (std::size_t k = 0; k < other.classes.size(); ++k) classes[k] += other.classes[k];
    half_widths += other.half_widths;
    return *this;
  }
  friend bool operator==(const ClassTally&, const ClassTally&) = default;
};

struct Tally {
  std::uint64_t n_trials = 0;
  std::uint64_t n_hits = 0;
  std::uint64_t n_undecided = 0;
  std::array<std::uint64_t, kNDecidedBy> n_decided_by{};  // by DecidedBy; undecided trials are in none of them

  /// What an integrand counts besides its values (Integrand::count), by places of its own.
  static constexpr std::size_t kNCounted = 5;
  std::array<std::uint64_t, kNCounted> counted{};

  /// With a fitted domain only; a constant one's follow from the counts.
  ShareSums all, hits, undecided;
  ClassTally by_class;

  std::uint64_t n_misses() const { return n_trials - n_hits - n_undecided; }

  void add(std::span<const Verdict> verdicts) {
    // Nearly all are one of two: counted as words, and the rest apart.
    constexpr auto kApart = std::bit_cast<std::uint32_t>(Verdict::disjoint(DecidedBy::gjk));
    constexpr auto kMeet = std::bit_cast<std::uint32_t>(Verdict::overlap(DecidedBy::gjk));
    std::uint32_t n_apart = 0, n_meet = 0;
    for (const Verdict& verdict : verdicts) {
      const auto word = std::bit_cast<std::uint32_t>(verdict);
      n_apart += word == kApart ? 1u : 0u;
      n_meet += word == kMeet ? 1u : 0u;
    }
    add(DecidedBy::gjk, n_apart, n_meet);
    if (n_apart + n_meet == verdicts.size()) return;
    for (const Verdict& verdict : verdicts) {
      const auto word = std::bit_cast<std::uint32_t>(verdict);
      if (word == kApart || word == kMeet) continue;
      ++n_trials;
      if (verdict.outcome == Outcome::undecided) {
        ++n_undecided;
      } else {
        ++n_decided_by[static_cast<std::size_t>(verdict.by)];
        if (verdict.outcome == Outcome::overlap) ++n_hits;
      }
    }
  }
  void add(const Verdict& verdict) { add({&verdict, 1}); }

  /// So many trials at once.
  void add(DecidedBy by, std::uint64_t n_disjoint, std::uint64_t n_overlap) {
    n_trials += n_disjoint + n_overlap;
    n_hits += n_overlap;
    n_decided_by[static_cast<std::size_t>(by)] += n_disjoint + n_overlap;
  }

  /// A trial of a fitted domain, of this share.
  void add(const Verdict& verdict, double share) {
    add(verdict);
    all.add(share);
    if (verdict.outcome == Outcome::overlap) hits.add(share);
    if (verdict.outcome == Outcome::undecided) undecided.add(share);
  }

  /// Throws std::logic_error where both have trials that were counted in unlike ways (ClassTally).
  Tally& operator+=(const Tally& other) {
    if (other.n_trials == 0) return *this;
    if (n_trials == 0) return *this = other;
    by_class += other.by_class;
    n_trials += other.n_trials;
    n_hits += other.n_hits;
    n_undecided += other.n_undecided;
    for (std::size_t k = 0; k < n_decided_by.size(); ++k) n_decided_by[k] += other.n_decided_by[k];
    for (std::size_t k = 0; k < counted.size(); ++k) counted[k] += other.counted[k];
    all += other.all;
    hits += other.hits;
    undecided += other.undecided;
    return *this;
  }

  friend bool operator==(const Tally&, const Tally&) = default;
};

/// How another backend answered the trials of a run.
struct Comparison {
  std::uint64_t n_undecided = 0;   // of the other backend
  std::uint64_t n_compared = 0;    // trials that both decided
  std::uint64_t n_only_run = 0;    // hits of the run's backend that the other one missed
  std::uint64_t n_only_other = 0;  // hits of the other one that the run's missed
  ShareSums only_run, only_other;

  void add(const Verdict& run, const Verdict& other, double share) {
    if (other.outcome == Outcome::undecided) ++n_undecided;
    if (other.outcome == Outcome::undecided || run.outcome == Outcome::undecided) return;
    ++n_compared;
    if (run.outcome == other.outcome) return;
    const bool is_hit = run.outcome == Outcome::overlap;
    ++(is_hit ? n_only_run : n_only_other);
    (is_hit ? only_run : only_other).add(share);
  }

  Comparison& operator+=(const Comparison& other) {
    n_undecided += other.n_undecided;
    n_compared += other.n_compared;
    n_only_run += other.n_only_run;
    n_only_other += other.n_only_other;
    only_run += other.only_run;
    only_other += other.only_other;
    return *this;
  }

  friend bool operator==(const Comparison&, const Comparison&) = default;
};

}  // namespace vex
