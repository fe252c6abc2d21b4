#include "engine/sampling/run_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/run_state_text.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

const ConvexBody kA = Box(1, 2, 3), kB = Ellipsoid(1, 1, 2);

enum class WayToSave { hit_or_miss, fitted, stratified, sobol_hits };
constexpr WayToSave kWaysToSave[] = {WayToSave::hit_or_miss, WayToSave::fitted, WayToSave::stratified,
                                     WayToSave::sobol_hits};

// Every third verdict is wrong, or none: what lists are made of.
class Unsure final : public OverlapBackend {
 public:
  void decide(std::span<const Pose> poses, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const double x = poses[k].a_from_b().translation.x;
      verdicts[k] = x < -1.0  ? Verdict::undecided(DecidedBy::peer, UndecidedReason::rounding)
                    : x < 0.0 ? Verdict::overlap(DecidedBy::peer)
                              : Verdict::disjoint(DecidedBy::peer);
    }
  }
};
const BackendKind kUnsure{"unsure", true,
                          [](const ConvexBody&, const ConvexBody&) { return std::make_unique<Unsure>(); }};

MonteCarloSettings settings_of(WayToSave way, std::uint64_t trials) {
  MonteCarloSettings settings;
  settings.stop.trials = trials;
  settings.domain = ball_domain(kA, kB);
  if (way == WayToSave::fitted) settings.domain = {Domain::Kind::fitted, {}, 0.0, {}, settings.domain.volume};
  settings.stratified = way == WayToSave::stratified;
  if (way == WayToSave::sobol_hits) settings.sequence = Sequence::sobol;
  return settings;
}

RunState state_of(MonteCarloSettings settings) {
  RunState last;
  settings.on_state = [&last](const RunState& state) { last = state; };
  run_monte_carlo(kA, kB, settings);
  return last;
}

std::vector<RunState> states_of_all_kinds() {
  std::vector<RunState> states = {RunState{}};
  for (const WayToSave way : kWaysToSave) {
    MonteCarloSettings settings = settings_of(way, 2000);
    states.push_back(state_of(settings));
    settings.first_trial = 64000;
    states.push_back(state_of(settings));
    settings.cross_check = {kUnsure};
    settings.stop.trials = 200;
    states.push_back(state_of(settings));
    settings.verify = true;
    settings.backend = kUnsure;
    settings.cross_check = {gjk_backend()};
    states.push_back(state_of(settings));
  }
  return states;
}

TEST(RunState, ReadsBackAsItIs) {
  for (const RunState& state : states_of_all_kinds()) {
    const std::string text = run_state_text(state);
    const RunState again = read_run_state(text);
    EXPECT_EQ(again.done.tally, state.done.tally);
    EXPECT_EQ(again.done.comparisons, state.done.comparisons);
    EXPECT_EQ(again.first_trial, state.first_trial);
    EXPECT_EQ(again.domain, state.domain);
    EXPECT_EQ(again.domain_volume, state.domain_volume);
    EXPECT_EQ(again.seconds, state.seconds);
    EXPECT_EQ(again.done.unproven.n_all, state.done.unproven.n_all);
    EXPECT_EQ(run_state_text(again), text);
  }
}

TEST(RunState, SumsOfEitherSignAndAnySizeAreKeptInFull) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    RunState state;
    Tally& tally = state.done.tally;
    tally.n_trials = tally.n_decided_by[0] = 3;
    tally.by_class.kind = ClassTally::Kind::one;
    tally.by_class.is_signed = true;
    tally.by_class.unit = 1.0;
    tally.by_class.classes.resize(1);
    ClassSums& sums = tally.by_class.classes[0];
    sums.n = 3;
    for (int j = 0; j < 3; ++j) {
      const int exponent = static_cast<int>(random() % 400) - 380;
      sums.values.add(std::ldexp(static_cast<double>(random() >> 11) - 0x1p52, exponent - 52));
    }
    EXPECT_EQ(read_run_state(run_state_text(state)).done.tally, tally);
  }
}

// A text with one change is another state, or is refused; nothing else happens to it.
TEST(RunState, DamagedTextIsRefused) {
  std::mt19937_64 random(2);
  const std::string letters = "0123456789abcdefp-+. \nxz\xff";
  std::size_t n_refused = 0, n_all = 0;
  for (const RunState& state : states_of_all_kinds()) {
    const std::string text = run_state_text(state);
    for (int k = 0; k < 300; ++k) {
      std::string damaged = text;
      const std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0: damaged[at] = letters[random() % letters.size()]; break;
        case 1: damaged.erase(at, 1 + random() % 20); break;
        case 2: damaged.insert(at, 1 + random() % 3, letters[random() % letters.size()]); break;
        default: damaged.resize(at);
      }
      if (damaged == text) continue;
      ++n_all;
      try {
        EXPECT_EQ(run_state_text(read_run_state(damaged)), damaged);
      } catch (const InputError& error) {
        ++n_refused;
        EXPECT_NE(std::string(error.what()).find(" - "), std::string::npos) << error.what();
      }
    }
    for (std::size_t n = 0; n < text.size(); n += 1 + n / 16) {
      EXPECT_THROW(read_run_state(text.substr(0, n)), InputError) << n;
    }
  }
  EXPECT_GT(n_refused, n_all / 3);  // the others are other sums, whose last digits nobody can know: hence a checksum
}

TEST(RunState, NumbersThatNoRunHasAreRefused) {
  const std::string text = run_state_text(state_of(settings_of(WayToSave::sobol_hits, 2000)));
  const auto with = [&text](const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return text.substr(0, at) + after + text.substr(at + before.size());
  };
  EXPECT_NO_THROW(read_run_state(with("seconds ", "seconds ")));
  for (const auto& [before, after] :
       std::vector<std::pair<std::string, std::string>>{{"trials 2000 ", "trials 2001 "},
                                                        {"trials 2000 ", "trials 99999999999999999999 "},
                                                        {"trials 2000 ", "trials -1 "},
                                                        {"trials 2000 ", "trials 02000 "},
                                                        {"first-trial 0", "first-trial 7"},
                                                        {"seconds ", "seconds -"},
                                                        {"domain 0", "domain 3"},
                                                        {"class 63 ", "class 64 "},
                                                        {"vex-run-state 1", "vex-run-state 2"},
                                                        {"seconds ", "seconds inf"}}) {
    EXPECT_THROW(read_run_state(with(before, after)), InputError) << before << " -> " << after;
  }
}

// Sums that reach the bit of their sign, or whose exponents leave their type: each word of a state that is a sum.
TEST(RunState, SumsThatNothingHoldsAreRefused) {
  MonteCarloSettings settings = settings_of(WayToSave::sobol_hits, 2000);
  settings.backend = kUnsure;
  const std::string text = run_state_text(state_of(settings));
  std::size_t n_sums = 0;
  for (std::size_t at = text.find('p'); at != std::string::npos; at = text.find('p', at + 1)) {
    const std::size_t begin = text.rfind(' ', at) + 1, end = text.find_first_of(" \n", at);
    const std::string word = text.substr(begin, end - begin);
    if (word.find_first_not_of("0123456789abcdefp-") != std::string::npos || word.find('p') + 1 == word.size())
      continue;
    for (const std::string& sum :
         {"8" + std::string(143, '0') + "p-448", "-8" + std::string(143, '0') + "p-448", std::string("8p124"),
          std::string("-8p124"), std::string("7p124"), std::string("1p128"), std::string("1p2147483640"),
          std::string("1p-2147483648"), std::string("1p-452")}) {
      EXPECT_THROW(read_run_state(text.substr(0, begin) + sum + text.substr(end)), InputError) << word << " -> " << sum;
    }
    ++n_sums;
  }
  EXPECT_GE(n_sums, 64u);
}

TEST(RunState, ARunThatGoesOnEndsAsOneWithoutABreak) {
  for (const WayToSave way : kWaysToSave) {
    MonteCarloSettings settings = settings_of(way, 50000);
    const RunState whole = state_of(settings);
    for (const std::uint64_t n : {0u, 32u, 4096u, 31968u, 50000u}) {
      for (const int n_threads : {1, 3}) {
        settings.n_threads = n_threads;
        RunState part;  // no trial yet
        part.domain = settings.domain.kind;
        part.domain_volume = settings.domain.volume;
        if (n > 0) part = state_of(settings_of(way, n));
        part = read_run_state(run_state_text(part));
        settings.resume = &part;
        const RunState again = state_of(settings);
        settings.resume = nullptr;
        EXPECT_EQ(again.done.tally, whole.done.tally) << static_cast<int>(way) << ", " << n;
        EXPECT_GE(again.seconds, part.seconds);
      }
    }
  }
}

TEST(RunState, ARunThatIsInterruptedAndGoesOnStopsAtTheSameTrial) {
  std::mt19937_64 random(3);
  std::size_t n_interrupted = 0;
  for (const WayToSave way : kWaysToSave) {
    MonteCarloSettings settings = settings_of(way, 1);
    settings.stop.trials.reset();
    settings.stop.relative_error = 1e-3;
    const RunState whole = state_of(settings);
    RunState state;
    state.domain = settings.domain.kind;
    state.domain_volume = settings.domain.volume;
    std::atomic<int> interrupt{0};
    settings.interrupt = &interrupt;
    std::size_t n_runs = 0;
    for (bool complete = false; !complete; ++n_runs) {
      ASSERT_LT(n_runs, 10000u);
      interrupt = 0;
      settings.n_threads = 1 + static_cast<int>(random() % 3);
      settings.resume = &state;
      std::jthread other([&interrupt, wait = 1 + random() % 8] {
        std::this_thread::sleep_for(std::chrono::milliseconds(wait));
        interrupt = SIGTERM;
      });
      RunState next;
      settings.on_state = [&next](const RunState& now) { next = now; };
      complete = run_monte_carlo(kA, kB, settings).complete;
      state = read_run_state(run_state_text(next));
    }
    EXPECT_EQ(state.done.tally, whole.done.tally) << static_cast<int>(way) << " in " << n_runs << " runs";
    n_interrupted += n_runs - 1;
  }
  // One way or another may be through before the clock comes, of a busy machine; not all of them.
  EXPECT_GT(n_interrupted, 0u);
}

TEST(RunState, AStateOfAnotherRunIsRefused) {
  const RunState state = state_of(settings_of(WayToSave::hit_or_miss, 1000));
  const auto refuses = [&state](MonteCarloSettings settings) {
    settings.resume = &state;
    EXPECT_THROW(run_monte_carlo(kA, kB, settings), InputError);
  };
  refuses(settings_of(WayToSave::fitted, 2000));
  refuses(settings_of(WayToSave::sobol_hits, 2000));
  refuses(settings_of(WayToSave::stratified, 2000));
  refuses(settings_of(WayToSave::hit_or_miss, 999));
  MonteCarloSettings settings = settings_of(WayToSave::hit_or_miss, 2000);
  settings.first_trial = 5;
  refuses(settings);
  settings = settings_of(WayToSave::hit_or_miss, 2000);
  settings.cross_check = {kUnsure};
  refuses(settings);
  settings = settings_of(WayToSave::hit_or_miss, 2000);
  settings.verify = true;
  refuses(settings);
  // Of 1000 trials there are 31 or 32 of each class, and the next one is of the ninth: no block begins there.
  const RunState sobol = state_of(settings_of(WayToSave::sobol_hits, 1000));
  settings = settings_of(WayToSave::sobol_hits, 2000);
  settings.resume = &sobol;
  EXPECT_THROW(run_monte_carlo(kA, kB, settings), InputError);
}

TEST(RunState, RangesAddToOneRunInWhateverOrderTheyWereDone) {
  for (const WayToSave way : kWaysToSave) {
    const RunState whole = state_of(settings_of(way, 10000));
    std::vector<RunState> ranges;
    for (std::uint64_t first = 0; first < 10000; first += 1024) {
      MonteCarloSettings settings = settings_of(way, std::min<std::uint64_t>(1024, 10000 - first));
      settings.first_trial = first;
      settings.n_threads = 1 + static_cast<int>(first / 1024 % 3);
      ranges.push_back(state_of(settings));
    }
    RunState sum = ranges.front();
    EXPECT_THROW(sum.append(RunState(ranges[2])), InputError);
    for (std::size_t k = 1; k < ranges.size(); ++k) sum.append(std::move(ranges[k]));
    EXPECT_EQ(sum.done.tally, whole.done.tally) << static_cast<int>(way);
  }
}

TEST(RunState, RangesBeginWithWholeClassesAndHaveNoOtherStopRule) {
  for (const WayToSave way : {WayToSave::sobol_hits, WayToSave::stratified}) {
    MonteCarloSettings settings = settings_of(way, 64);
    settings.first_trial = 33;
    EXPECT_THROW(run_monte_carlo(kA, kB, settings), UsageError);
  }
  MonteCarloSettings settings = settings_of(WayToSave::hit_or_miss, 64);
  settings.first_trial = 33;
  EXPECT_NO_THROW(run_monte_carlo(kA, kB, settings));
  settings.stop.relative_error = 0.1;
  EXPECT_THROW(run_monte_carlo(kA, kB, settings), UsageError);
  settings.stop = {};
  EXPECT_THROW(run_monte_carlo(kA, kB, settings), UsageError);
  settings.stop.trials = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW(run_monte_carlo(kA, kB, settings), UsageError);
}

TEST(RunState, IsGivenWhileTheRunGoesOn) {
  MonteCarloSettings settings = settings_of(WayToSave::hit_or_miss, 1);
  settings.stop.trials.reset();
  settings.stop.seconds = 0.5;
  settings.n_threads = 2;
  settings.seconds_between_states = 0.1;
  std::uint64_t n_states = 0, last = 0;
  settings.on_state = [&](const RunState& state) {
    ++n_states;
    EXPECT_GE(state.end(), last);
    last = state.end();
    EXPECT_NO_THROW(read_run_state(run_state_text(state)));
  };
  const RunRecord record = run_monte_carlo(kA, kB, settings);
  EXPECT_EQ(record.tally.n_trials, last);
  EXPECT_GE(n_states, 3u);
}

}  // namespace
}  // namespace vex
