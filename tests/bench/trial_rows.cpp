#include "tests/bench/trial_rows.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <map>

#include "apps/common/numbers.h"
#include "apps/peers/peers.h"
#include "tests/bench/bench_pairs.h"
#include "tests/bench/best_peers.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

const char* const kTrial = "trial";
const char* const kTrialWithoutQuick = "trial without quick verdicts";
const char* const kQuery = "query";
const char* const kOneAtATime = "one at a time";

std::string trial_with(InstructionSet set) {
  return set == best_instruction_set() ? kTrial : std::string(kTrial) + ", " + std::string(name_of(set));
}

// The contenders of one pair by name, after their rounds.
struct PairResult {
  BenchPair pair;
  std::size_t n_poses = 0, n_hits = 0;
  Tally tally;
  std::vector<std::string> names;  // in the order of their turns
  std::map<std::string, Timing> timings;
  std::map<std::string, Differences> against;  // of peers

  const Timing* find(const std::string& name) const {
    const auto at = timings.find(name);
    return at == timings.end() ? nullptr : &at->second;
  }
  const Timing& of(const std::string& name) const { return timings.at(name); }
  std::string text(const std::string& name) const {
    const Timing* const timing = find(name);
    return timing == nullptr ? "-" : timing_text(*timing);
  }
  double ratio_of(const std::string& name, const std::string& base = kTrial) const { return ratio(of(name), of(base)); }
};

PairResult run_pair(const BenchPair& pair, const BenchSettings& settings, const std::vector<Contender>& trials,
                    const std::vector<Transformd>& poses, const std::vector<BackendKind>& engine_kinds,
                    const std::vector<BackendKind>& peer_kinds, double most_peer_seconds) {
  PairResult result{pair, poses.size(), 0, {}, {}, {}, {}};
  result.tally = run_hit_or_miss(pair.body, pair.body, trial_settings(pair.body, settings.seed, poses.size())).tally;
  std::vector<Contender> contenders = trials;
  std::deque<StoredQuery> queries;  // stay where they are
  for (const std::vector<BackendKind>* kinds : {&engine_kinds, &peer_kinds}) {
    for (const BackendKind& kind : *kinds) {
      if (!kind.takes(pair.body, pair.body)) continue;
      queries.emplace_back(kind, pair.body, poses);
      const bool is_limited = kind.is_peer && most_peer_seconds < std::numeric_limits<double>::infinity();
      contenders.push_back(
          queries.back().contender(is_limited ? queries.back().n_answered_in(most_peer_seconds) : poses.size()));
    }
  }
  const std::vector<Timing> timings = take_turns(contenders, settings.n_rounds);
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    result.names.push_back(contenders[k].name);
    result.timings[contenders[k].name] = timings[k];
  }
  const std::vector<Verdict>& proven = queries.front().verdicts();
  result.n_hits = n_hits(proven);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (k < engine_kinds.size()) continue;
    const std::size_t n = contenders[trials.size() + k].n_trials;
    result.against[queries[k].name()] = differences(proven, queries[k].verdicts(), n);
  }
  return result;
}

BackendKind renamed(BackendKind kind, const char* name) {
  kind.name = name;
  return kind;
}

std::size_t n_poses_of(const BenchPair& pair, const BenchSettings& settings) {
  return settings.n_poses.value_or(pair.n_poses);
}

// The faster of libccd's two, null where the build has neither.
const char* faster_ccd(const PairResult& result) {
  const Timing *const gjk = result.find("ccd-gjk"), *const mpr = result.find("ccd-mpr");
  if (gjk == nullptr || mpr == nullptr) return nullptr;
  return gjk->median() < mpr->median() ? "ccd-gjk" : "ccd-mpr";
}

Json json_of(const PairResult& result) {
  Json contenders = Json::object();
  for (const std::string& name : result.names) {
    contenders[name] = timing_json(result.of(name));
    const auto against = result.against.find(name);
    if (against != result.against.end()) contenders[name]["verdicts_against_proven"] = against->second.json();
  }
  Json decided = Json::object();
  for (int by = 0; by < kNDecidedBy; ++by) {
    decided[std::string(name_of(static_cast<DecidedBy>(by)))] = result.tally.n_decided_by[static_cast<std::size_t>(by)];
  }
  return {{"pair", result.pair.name}, {"poses", result.n_poses},
          {"hits", result.n_hits},    {"hits_of_trials", result.tally.n_hits},
          {"decided_by", decided},    {"undecided", result.tally.n_undecided},
          {"contenders", contenders}};
}

std::string with_goal(double value, double goal) { return three_digits(value) + " (" + short_number(goal) + ")"; }

std::string share_text(const PairResult& result, DecidedBy by) {
  return percent(static_cast<double>(result.tally.n_decided_by[static_cast<std::size_t>(by)]) /
                 static_cast<double>(result.tally.n_trials));
}

const std::string kHowTimed =
    "Nanoseconds a trial of processor time: the median of the rounds, in brackets what lies between the quartiles; in "
    "each round "
    "every contender of a pair takes its turn. A ratio is the median of the rounds' ratios.\n\n";

}  // namespace

BenchReport compare_trials(const BenchSettings& settings) {
  const std::vector<BackendKind> engine_kinds = {renamed(gjk_backend(), kQuery),
                                                 renamed(gjk_backend(InstructionSet::scalar), kOneAtATime)};
  const std::vector<BackendKind> peers = peer_backends();
  std::vector<std::string> sets;
  for (const InstructionSet set : instruction_sets()) sets.emplace_back(name_of(set));

  MarkdownTable times({"pair", "poses", "whole trial", "without quick verdicts", "query", "query one at a time",
                       "libccd GJK", "libccd MPR", "FCL"});
  MarkdownTable ratios({"pair", "faster libccd query / whole trial", "the same without quick verdicts",
                        "FCL query / whole trial", "the same without quick verdicts"});
  MarkdownTable verdicts({"pair", "hits", "libccd GJK", "libccd MPR", "FCL"});
  std::vector<std::string> set_heads = {"pair"};
  for (const std::string& set : sets) set_heads.push_back(set);
  for (const std::string& set : sets) set_heads.push_back("faster peer / " + set);
  MarkdownTable by_set(set_heads);
  MarkdownTable quick({"pair", "outer balls", "inner balls", "search", "with, ns", "without, ns", "saved"});
  Json rows = Json::array();
  for (const BenchPair& pair : bench_pairs()) {
    const std::vector<Transformd> poses = stored_poses(pair.body, settings.seed, n_poses_of(pair, settings));
    MonteCarloSettings trial = trial_settings(pair.body, settings.seed, poses.size());
    std::vector<Contender> trials = {trial_contender(kTrial, pair.body, trial)};
    trial.quick_verdicts = false;
    trials.push_back(trial_contender(kTrialWithoutQuick, pair.body, trial));
    for (const InstructionSet set : instruction_sets()) {
      if (set == best_instruction_set()) continue;
      trials.push_back(
          trial_contender(trial_with(set), pair.body, trial_settings(pair.body, settings.seed, poses.size(), set)));
    }
    const PairResult result =
        run_pair(pair, settings, trials, poses, engine_kinds, peers, std::numeric_limits<double>::infinity());

    times.add({pair.name, grouped(poses.size()), result.text(kTrial), result.text(kTrialWithoutQuick),
               result.text(kQuery), result.text(kOneAtATime), result.text("ccd-gjk"), result.text("ccd-mpr"),
               result.text("fcl")});
    Json row = json_of(result);
    Json ratio_rows = Json::array();
    std::vector<std::string> cells = {pair.name};
    const char* const ccd = faster_ccd(result);
    const char* const fcl = result.find("fcl") == nullptr ? nullptr : "fcl";
    for (const auto& [peer, goal] : {std::pair(ccd, pair.goal_ccd), std::pair(fcl, pair.goal_fcl)}) {
      for (const char* base : {kTrial, kTrialWithoutQuick}) {
        if (peer == nullptr) {
          cells.emplace_back("-");
          continue;
        }
        const double asked = base == kTrial ? goal : kGoalWithoutQuickVerdicts;
        const double value = result.ratio_of(peer, base);
        cells.push_back(with_goal(value, asked));
        ratio_rows.push_back({{"of", peer}, {"to", base}, {"ratio", value}, {"goal", asked}});
      }
    }
    ratios.add(cells);
    row["ratios"] = ratio_rows;
    const auto against = [&](const char* peer) {
      const auto found = result.against.find(peer);
      return found == result.against.end() ? std::string("-") : found->second.text();
    };
    verdicts.add({pair.name, grouped(result.n_hits), against("ccd-gjk"), against("ccd-mpr"), against("fcl")});
    cells = {pair.name};
    Json by_set_json = Json::object();
    for (const InstructionSet set : instruction_sets()) cells.push_back(result.text(trial_with(set)));
    for (const InstructionSet set : instruction_sets()) {
      if (ccd == nullptr) {
        cells.emplace_back("-");
        continue;
      }
      const double value = result.ratio_of(ccd, trial_with(set));
      cells.push_back(three_digits(value));
      by_set_json[std::string(name_of(set))] = value;
    }
    row["faster_ccd_to_trial_by_instruction_set"] = by_set_json;
    by_set.add(cells);
    const double with = result.of(kTrial).median(), without = result.of(kTrialWithoutQuick).median();
    quick.add({pair.name, share_text(result, DecidedBy::outer_bound), share_text(result, DecidedBy::inner_bound),
               share_text(result, DecidedBy::gjk), three_digits(with), three_digits(without),
               (without >= with ? "" : "-") + percent(std::abs(without - with) / without)});
    row["quick_verdicts_saved"] = 1.0 - with / without;
    rows.push_back(row);
  }
  return {
      "### Whole trials and queries\n\n" + kHowTimed + times.text() +
          "\n### Ratios\n\nIn brackets what was asked for.\n\n" + ratios.text() +
          "\n### Verdicts against proven ones\n\nOverlaps that a peer misses + overlaps that it invents, in "
          "brackets poses that it gives up.\n\n" +
          verdicts.text() +
          "\n### Whole trials by instruction set\n\nAnd the faster of libccd's queries beside them. Where AVX2 is "
          "the best set, 60 % of what is asked for above is asked for.\n\n" +
          by_set.text() +
          "\n### Quick verdicts\n\nShares of the trials by what decided them, and what a whole trial takes with and "
          "without.\n\n" +
          quick.text(),
      rows};
}

BenchReport compare_best_peers(const BenchSettings& settings) {
  const std::vector<BestPeer> peers = best_peers();
  std::vector<BackendKind> kinds;
  std::string legend;
  for (const BestPeer& peer : peers) {
    kinds.push_back(peer.kind);
    legend += "- `" + peer.kind.name + "`: " + peer.setting + ".\n";
  }
  const std::vector<BackendKind> engine_kinds = {renamed(gjk_backend(), kQuery)};
  MarkdownTable fastest_table(
      {"pair", "libccd's fastest", "times a whole trial", "FCL's fastest", "times a whole trial"});
  MarkdownTable table({"pair", "contender", "ns", "times a whole trial", "times a query", "against proven verdicts"});
  Json rows = Json::array();
  for (const BenchPair& pair : bench_pairs()) {
    constexpr double kTurnSeconds = 0.2;  // of a peer; some scan 10 000 vertices a support call
    const std::size_t n = n_poses_of(pair, settings);
    const std::vector<Transformd> poses = stored_poses(pair.body, settings.seed, n);
    const std::vector<Contender> trials = {
        trial_contender(kTrial, pair.body, trial_settings(pair.body, settings.seed, n))};
    const PairResult result = run_pair(pair, settings, trials, poses, engine_kinds, kinds, kTurnSeconds);
    for (const std::string& name : result.names) {
      const auto against = result.against.find(name);
      table.add(
          {pair.name, name, result.text(name), three_digits(result.ratio_of(name)),
           three_digits(result.ratio_of(name, kQuery)),
           against == result.against.end()
               ? "proven"
               : against->second.text() + " of " + grouped(against->second.n_compared + against->second.n_given_up)});
    }
    std::vector<std::string> cells = {pair.name};
    for (const std::string library : {"ccd-", "fcl-"}) {
      const std::string* fastest = nullptr;
      for (const std::string& name : result.names) {
        if (name.rfind(library, 0) != 0) continue;
        if (fastest == nullptr || result.of(name).median() < result.of(*fastest).median()) fastest = &name;
      }
      cells.push_back(fastest == nullptr ? "-" : "`" + *fastest + "`");
      cells.push_back(fastest == nullptr ? "-" : three_digits(result.ratio_of(*fastest)));
    }
    fastest_table.add(cells);
    Json row = json_of(result);
    for (const std::string& name : result.names) {
      row["contenders"][name]["ratio_to_trial"] = result.ratio_of(name);
      row["contenders"][name]["ratio_to_query"] = result.ratio_of(name, kQuery);
    }
    for (const BestPeer& peer : peers) {
      if (result.find(peer.kind.name) != nullptr) row["contenders"][peer.kind.name]["setting"] = peer.setting;
    }
    rows.push_back(row);
  }
  return {"### The peers' own best settings\n\n" + kHowTimed +
              "Verdicts against the engine's, which are proven: overlaps missed + overlaps invented, in brackets poses "
              "given "
              "up.\n\n- `trial`, `query`: the engine, a whole trial and its query alone.\n" +
              legend + "\n" + table.text() + "\nThe fastest of each library:\n\n" + fastest_table.text(),
          rows};
}

}  // namespace vex
