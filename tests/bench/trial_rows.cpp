#include "tests/bench/trial_rows.h"

#include <algorithm>
#include <cmath>

#include "apps/common/numbers.h"
#include "apps/peers/peers.h"
#include "tests/bench/best_peers.h"
#include "tests/bench/pair_result.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

// As apps/peers asks them, on the engine's support mappings; and as a user does who has written his own.
const std::vector<std::string> kCcd = {"ccd-gjk", "ccd-mpr"}, kPlainCcd = {"ccd-gjk-plain", "ccd-mpr-plain"},
                               kFcl = {"fcl"};

std::string trial_with(InstructionSet set) {
  return set == best_instruction_set() ? kTrial : std::string(kTrial) + ", " + std::string(name_of(set));
}

std::vector<PeerEntry> peers() {
  constexpr double kScanSeconds = 0.2;  // plain functions scan a hull's vertices
  std::vector<PeerEntry> all;
  for (BackendKind& kind : peer_backends()) all.push_back({std::move(kind)});
  for (BestPeer& peer : best_peers()) {
    if (std::ranges::find(kPlainCcd, peer.kind.name) != kPlainCcd.end()) {
      all.push_back({std::move(peer.kind), kScanSeconds});
    }
  }
  return all;
}

// A whole trial as it is, without quick verdicts, and by every instruction set.
std::vector<Contender> trials_of(const BenchPair& pair, const BenchSettings& settings) {
  const std::size_t n = n_poses_of(pair, settings);
  MonteCarloSettings trial = trial_settings(pair.body, settings.seed, n);
  std::vector<Contender> trials = {trial_contender(kTrial, pair.body, trial)};
  trial.quick_verdicts = false;
  trials.push_back(trial_contender(kTrialWithoutQuick, pair.body, trial));
  for (const InstructionSet set : instruction_sets()) {
    if (set == best_instruction_set()) continue;
    trials.push_back(trial_contender(trial_with(set), pair.body, trial_settings(pair.body, settings.seed, n, set)));
  }
  return trials;
}

std::string times_table(const std::vector<PairResult>& results) {
  MarkdownTable table({"pair", "poses", "whole trial", "without quick verdicts", "query", "query one at a time",
                       "libccd GJK", "libccd MPR", "plain libccd GJK", "plain libccd MPR", "FCL"});
  for (const PairResult& result : results) {
    std::vector<std::string> cells = {result.pair.name, grouped(result.n_poses)};
    for (const char* name : {kTrial, kTrialWithoutQuick, kQuery, kOneAtATime, "ccd-gjk", "ccd-mpr", "ccd-gjk-plain",
                             "ccd-mpr-plain", "fcl"}) {
      cells.push_back(result.timing_cell(name));
    }
    table.add(cells);
  }
  return table.text();
}

struct AskedRatio {
  const std::vector<std::string>& peers;  // the fastest of them
  const char* base;
  double goal;
};

std::vector<AskedRatio> asked_ratios(const BenchPair& pair) {
  return {{kCcd, kTrial, pair.goal_ccd},      {kCcd, kTrialWithoutQuick, kGoalWithoutQuickVerdicts},
          {kPlainCcd, kTrial, pair.goal_ccd}, {kPlainCcd, kTrialWithoutQuick, kGoalWithoutQuickVerdicts},
          {kFcl, kTrial, pair.goal_fcl},      {kFcl, kTrialWithoutQuick, kGoalWithoutQuickVerdicts}};
}

std::string ratios_table(const std::vector<PairResult>& results) {
  const char* const without = "without quick verdicts";
  MarkdownTable table(
      {"pair", "libccd / whole trial", without, "plain libccd / whole trial", without, "FCL / whole trial", without});
  for (const PairResult& result : results) {
    std::vector<std::string> cells = {result.pair.name};
    for (const AskedRatio& asked : asked_ratios(result.pair)) {
      const std::string* const peer = result.fastest(asked.peers);
      cells.push_back(peer == nullptr
                          ? "-"
                          : three_digits(result.ratio_of(*peer, asked.base)) + " (" + short_number(asked.goal) + ")");
    }
    table.add(cells);
  }
  return table.text();
}

std::string verdicts_table(const std::vector<PairResult>& results) {
  MarkdownTable table({"pair", "hits", "libccd GJK", "libccd MPR", "plain libccd GJK", "plain libccd MPR", "FCL"});
  for (const PairResult& result : results) {
    std::vector<std::string> cells = {result.pair.name, grouped(result.n_hits) + " of " + grouped(result.n_poses)};
    for (const char* name : {"ccd-gjk", "ccd-mpr", "ccd-gjk-plain", "ccd-mpr-plain", "fcl"}) {
      cells.push_back(result.differences_cell(name));
    }
    table.add(cells);
  }
  return table.text();
}

std::string sets_table(const std::vector<PairResult>& results) {
  std::vector<std::string> heads = {"pair"};
  for (const InstructionSet set : instruction_sets()) heads.emplace_back(name_of(set));
  for (const InstructionSet set : instruction_sets()) heads.push_back("libccd / " + std::string(name_of(set)));
  MarkdownTable table(heads);
  for (const PairResult& result : results) {
    std::vector<std::string> cells = {result.pair.name};
    for (const InstructionSet set : instruction_sets()) cells.push_back(result.timing_cell(trial_with(set)));
    const std::string* const ccd = result.fastest(kCcd);
    for (const InstructionSet set : instruction_sets()) {
      cells.push_back(ccd == nullptr ? "-" : three_digits(result.ratio_of(*ccd, trial_with(set))));
    }
    table.add(cells);
  }
  return table.text();
}

// By everything that decided any trial.
std::string quick_table(const std::vector<PairResult>& results) {
  std::vector<std::size_t> ways;
  for (std::size_t by = 0; by < static_cast<std::size_t>(kNDecidedBy); ++by) {
    if (std::ranges::any_of(results, [by](const PairResult& r) { return r.tally.n_decided_by[by] > 0; })) {
      ways.push_back(by);
    }
  }
  std::vector<std::string> heads = {"pair"};
  for (const std::size_t by : ways) heads.push_back("`" + std::string(name_of(static_cast<DecidedBy>(by))) + "`");
  for (const char* head : {"with, ns", "without, ns", "saved"}) heads.emplace_back(head);
  MarkdownTable table(heads);
  for (const PairResult& result : results) {
    std::vector<std::string> cells = {result.pair.name};
    for (const std::size_t by : ways) {
      cells.push_back(
          percent(static_cast<double>(result.tally.n_decided_by[by]) / static_cast<double>(result.tally.n_trials)));
    }
    const double saved = 1.0 - 1.0 / result.ratio_of(kTrialWithoutQuick);
    cells.push_back(three_digits(result.of(kTrial).median()));
    cells.push_back(three_digits(result.of(kTrialWithoutQuick).median()));
    cells.push_back((saved < 0.0 ? "-" : "") + percent(std::fabs(saved)));
    table.add(cells);
  }
  return table.text();
}

Json json_of(const PairResult& result) {
  Json row = result.json();
  Json ratios = Json::array();
  for (const AskedRatio& asked : asked_ratios(result.pair)) {
    const std::string* const peer = result.fastest(asked.peers);
    if (peer == nullptr) continue;
    ratios.push_back(
        {{"of", *peer}, {"to", asked.base}, {"ratio", result.ratio_of(*peer, asked.base)}, {"goal", asked.goal}});
  }
  row["ratios"] = ratios;
  Json by_set = Json::object();
  for (const InstructionSet set : instruction_sets()) {
    Json one = {{"trial", timing_json(result.of(trial_with(set)))}};
    if (const std::string* const ccd = result.fastest(kCcd)) one["ratio"] = result.ratio_of(*ccd, trial_with(set));
    by_set[std::string(name_of(set))] = one;
  }
  row["instruction_sets"] = by_set;
  row["quick_verdicts_saved"] = 1.0 - 1.0 / result.ratio_of(kTrialWithoutQuick);
  return row;
}

}  // namespace

BenchReport compare_trials(const BenchSettings& settings) {
  const std::vector<BackendKind> engine_kinds = {renamed(gjk_backend(), kQuery),
                                                 renamed(gjk_backend(InstructionSet::scalar), kOneAtATime)};
  std::vector<PairResult> results;
  Json rows = Json::array();
  for (const BenchPair& pair : bench_pairs()) {
    results.push_back(run_pair(pair, settings, trials_of(pair, settings), engine_kinds, peers()));
    rows.push_back(json_of(results.back()));
  }
  return {
      "### Whole trials and queries\n\n" + std::string(kHowTimed) +
          "libccd calls the engine's own support mappings, its tables of directions too; plain libccd calls plain C "
          "functions on structures of its user's, which scan a hull's vertices (GJK at most 100 iterations, MPR at "
          "its default tolerance).\n\n" +
          times_table(results) +
          "\n### Ratios\n\nThe faster of GJK and MPR, and FCL, alone, beside whole trials. In brackets what was asked "
          "for.\n\n" +
          ratios_table(results) +
          "\n### Verdicts against proven ones\n\nOverlaps that a peer misses + overlaps that it invents, in "
          "brackets poses that it gives up.\n\n" +
          verdicts_table(results) +
          "\n### Whole trials by instruction set\n\nAnd the faster of libccd's queries beside them. Where AVX2 is "
          "the best set, 60 % of what is asked for above is asked for.\n\n" +
          sets_table(results) +
          "\n### Quick verdicts\n\nShares of the trials by what decided them (`outer_bound` and `inner_bound` are "
          "quick verdicts), and nanoseconds of a whole trial with and without them.\n\n" +
          quick_table(results),
      rows};
}

}  // namespace vex
