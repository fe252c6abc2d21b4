#include "engine/sampling/run_state_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/run_state_words.h"

namespace vex {
namespace {

constexpr std::string_view kHead = "vex-run-state 1";
constexpr std::size_t kMostText = std::size_t{1} << 23;
constexpr std::uint64_t kMostComparisons = 64;

// --- writing

void add(std::string& text, std::uint64_t number) { text += ' ' + std::to_string(number); }

void add(std::string& text, double number) {
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::hex).ptr;
  text += ' ';
  text.append(digits.data(), end);
}

// The digits that are not 0 at either end, and the power of two of the last one.
void add(std::string& text, const FixedPointSum& sum) {
  const FixedPointSum::Words size = sum.size_in_units();
  const auto digit = [&size](int k) {
    return static_cast<unsigned>(size[static_cast<std::size_t>(k / 16)] >> (4 * (k % 16)) & 15u);
  };
  int first = kSumDigits - 1, last = 0;
  while (first > 0 && digit(first) == 0) --first;
  while (last < first && digit(last) == 0) ++last;
  text += sum.is_negative() ? " -" : " ";
  for (int k = first; k >= last; --k) text += "0123456789abcdef"[digit(k)];
  text += 'p' + std::to_string(digit(last) == 0 ? 0 : 4 * last + kSumExponent);
}

void add(std::string& text, const ShareSums& sums) {
  add(text, sums.first);
  add(text, sums.second);
}

void add(std::string& text, const Transformd& pose) {
  for (const Vec3d& row : {pose.row_x, pose.row_y, pose.row_z, pose.translation}) {
    for (const double x : {row.x, row.y, row.z}) add(text, x);
  }
}

template <class T>
void add_counts(std::string& text, const FirstOf<T>& list) {
  add(text, list.n_all);
  add(text, std::uint64_t{list.kept.size()});
}

// A line of a message, whatever it holds.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, ' ');
  return text.substr(0, RunStateWords::kLongestText);
}

// What the classes count.
constexpr std::uint64_t kValues = 0, kHits = 1, kSignedValues = 2;

void add_tally(std::string& text, const Tally& tally) {
  text += "\ntrials";
  for (const std::uint64_t n : {tally.n_trials, tally.n_hits, tally.n_undecided}) add(text, n);
  text += "\ndecided-by";
  for (const std::uint64_t n : tally.n_decided_by) add(text, n);
  if (tally.counted != Tally{}.counted) {
    text += "\ncounted";
    for (const std::uint64_t n : tally.counted) add(text, n);
  }
  text += "\nshares";
  for (const ShareSums* const sums : {&tally.all, &tally.hits, &tally.undecided}) add(text, *sums);
  const ClassTally& by_class = tally.by_class;
  text += "\nclasses";
  add(text, static_cast<std::uint64_t>(by_class.kind));
  add(text, by_class.are_hits ? kHits : by_class.is_signed ? kSignedValues : kValues);
  for (const double x : {by_class.offset, by_class.unit, by_class.relative_rounding, by_class.absolute_rounding}) {
    add(text, x);
  }
  add(text, by_class.half_widths);
  add(text, std::uint64_t{by_class.classes.size()});
  for (const ClassSums& sums : by_class.classes) {
    text += "\nclass";
    add(text, sums.n);
    add(text, sums.values);
    add(text, sums.undecided);
  }
}

// --- reading

using Reader = RunStateWords;

void read_classes(Reader& from, std::uint64_t first_trial, Tally& tally) {
  ClassTally& by_class = tally.by_class;
  from.line("classes");
  by_class.kind = static_cast<ClassTally::Kind>(from.count(3));
  const std::uint64_t what = from.count(kSignedValues);
  by_class.are_hits = what == kHits;
  by_class.is_signed = what == kSignedValues;
  for (double* const x : {&by_class.offset, &by_class.unit, &by_class.relative_rounding, &by_class.absolute_rounding}) {
    *x = from.number();
  }
  by_class.half_widths = from.half_widths(tally.n_undecided);
  const std::uint64_t n_classes = from.count(kClasses);
  const bool is_none = by_class.kind == ClassTally::Kind::none;
  const std::uint64_t due = is_none ? 0 : by_class.kind == ClassTally::Kind::one ? 1 : kClasses;
  from.require(n_classes == due, "another number of classes than their kind has");
  from.require(n_classes <= 1 || first_trial % kClasses == 0, "classes that begin in their midst");
  from.require(is_none ? by_class == ClassTally{} : by_class.unit > 0.0, "a unit that is none");
  from.require(by_class.relative_rounding >= 0.0 && by_class.absolute_rounding >= 0.0, "a negative rounding");
  for (std::uint64_t k = 0; k < n_classes; ++k) {
    from.line("class");
    ClassSums sums;
    sums.n = from.count();
    from.require(sums.n == tally.n_trials / n_classes + (k < tally.n_trials % n_classes ? 1 : 0),
                 "a class of another number of trials than it has");
    sums.values = by_class.are_hits ? from.shares(sums.n) : from.values(sums.n);
    sums.undecided = from.shares(by_class.are_hits ? std::min(sums.n, tally.n_undecided) : 0);
    by_class.classes.push_back(sums);
  }
}

void read_tally(Reader& from, std::uint64_t first_trial, Tally& tally) {
  from.line("trials");
  tally.n_trials = from.count();
  tally.n_hits = from.count(tally.n_trials);
  tally.n_undecided = from.count(tally.n_trials - tally.n_hits);
  from.line("decided-by");
  std::uint64_t n_decided = 0;  // six numbers below 2^62 do not run over, for each is at most what is left
  for (std::uint64_t& n : tally.n_decided_by)
    n_decided += n = from.count(tally.n_trials - tally.n_undecided - n_decided);
  from.require(n_decided == tally.n_trials - tally.n_undecided, "decided and undecided trials are not all trials");
  if (from.has_line("counted")) {
    from.line("counted");
    for (std::uint64_t& n : tally.counted) n = from.count();
  }
  from.line("shares");
  tally.all = from.shares(tally.n_trials);
  tally.hits = from.shares(tally.n_hits);
  tally.undecided = from.shares(tally.n_undecided);
  read_classes(from, first_trial, tally);
}

void read_comparisons(Reader& from, BlockRecord& done) {
  from.line("comparisons");
  const std::uint64_t n = from.count(kMostComparisons), n_trials = done.tally.n_trials;
  for (std::uint64_t k = 0; k < n; ++k) {
    from.line("comparison");
    Comparison one;
    one.n_undecided = from.count(n_trials);
    one.n_compared = from.count(n_trials - one.n_undecided);
    one.n_only_run = from.count(one.n_compared);
    one.n_only_other = from.count(one.n_compared - one.n_only_run);
    one.only_run = from.shares(one.n_only_run);
    one.only_other = from.shares(one.n_only_other);
    done.comparisons.push_back(one);
  }
}

void read_lists(Reader& from, RunState& state) {
  BlockRecord& done = state.done;
  from.line("undecided");
  from.list(done.undecided, done.tally.n_undecided, "trial", state,
            [&from](UndecidedTrial& one) { one.reason = static_cast<UndecidedReason>(from.count(2)); });
  read_comparisons(from, done);
  from.line("disagreements");
  const std::uint64_t n_trials = done.tally.n_trials, n_backends = done.comparisons.size() + 1;
  from.list(done.disagreements, n_backends > 1 ? n_trials : 0, "trial", state, [&](Disagreement& one) {
    for (std::uint64_t k = 0; k < n_backends; ++k) one.outcomes.push_back(from.outcome());
    one.a_from_b = from.pose();
  });
  from.line("proven-again");
  done.n_proven_again = from.count(n_trials - done.tally.n_undecided);
  from.line("unproven");
  from.list(done.unproven, n_trials - done.tally.n_undecided - done.n_proven_again, "trial", state,
            [&from](UnprovenTrial& one) {
              one.outcome = from.outcome();
              one.a_from_b = from.pose();
              one.fault = from.rest_of_line();
            });
}

}  // namespace

std::string run_state_text(const RunState& state) {
  std::string text(kHead);
  text += "\nfirst-trial";
  add(text, state.first_trial);
  text += "\nseconds";
  add(text, state.seconds);
  text += "\ndomain";
  add(text, static_cast<std::uint64_t>(state.domain));
  add(text, state.domain_volume);
  const BlockRecord& done = state.done;
  add_tally(text, done.tally);
  text += "\nundecided";
  add_counts(text, done.undecided);
  for (const UndecidedTrial& one : done.undecided.kept) {
    text += "\ntrial";
    add(text, one.index);
    add(text, static_cast<std::uint64_t>(one.reason));
  }
  text += "\ncomparisons";
  add(text, std::uint64_t{done.comparisons.size()});
  for (const Comparison& one : done.comparisons) {
    text += "\ncomparison";
    for (const std::uint64_t n : {one.n_undecided, one.n_compared, one.n_only_run, one.n_only_other}) add(text, n);
    add(text, one.only_run);
    add(text, one.only_other);
  }
  text += "\ndisagreements";
  add_counts(text, done.disagreements);
  for (const Disagreement& one : done.disagreements.kept) {
    text += "\ntrial";
    add(text, one.index);
    for (const Outcome outcome : one.outcomes) add(text, static_cast<std::uint64_t>(outcome));
    add(text, one.a_from_b);
  }
  text += "\nproven-again";
  add(text, done.n_proven_again);
  text += "\nunproven";
  add_counts(text, done.unproven);
  for (const UnprovenTrial& one : done.unproven.kept) {
    text += "\ntrial";
    add(text, one.index);
    add(text, static_cast<std::uint64_t>(one.outcome));
    add(text, one.a_from_b);
    text += ' ' + one_line(one.fault);
  }
  return text + "\n";
}

RunState read_run_state(std::string_view text) {
  Reader from(text);
  from.require(text.size() <= kMostText, "it is too long");
  from.line(kHead);
  RunState state;
  from.line("first-trial");
  state.first_trial = from.count();
  from.line("seconds");
  state.seconds = from.number();
  constexpr double kLongest = 1e12;
  from.require(state.seconds >= 0.0 && state.seconds <= kLongest, "a time that is none");
  from.line("domain");
  state.domain = static_cast<Domain::Kind>(from.count(2));
  state.domain_volume = from.number();
  from.require(state.domain_volume >= 0.0, "a negative volume");
  read_tally(from, state.first_trial, state.done.tally);
  read_lists(from, state);
  from.end();
  // One text for each state, and one state for each text.
  from.require(run_state_text(state) == text, "numbers are not written as vex writes them");
  return state;
}

}  // namespace vex
