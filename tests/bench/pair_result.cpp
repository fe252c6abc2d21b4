#include "tests/bench/pair_result.h"

#include <deque>
#include <utility>

namespace vex {

const char* const kHowTimed =
    "Nanoseconds a trial of processor time: the median of the rounds, in brackets what lies between the quartiles; in "
    "each round every contender of a pair takes its turn. A ratio is the median of the rounds' ratios.\n\n";

const Timing* PairResult::find(const std::string& name) const {
  const auto at = timings.find(name);
  return at == timings.end() ? nullptr : &at->second;
}

std::string PairResult::timing_cell(const std::string& name) const {
  const Timing* const timing = find(name);
  return timing == nullptr ? "-" : timing_text(*timing);
}

std::string PairResult::differences_cell(const std::string& name) const {
  const auto at = against.find(name);
  return at == against.end() ? "-" : at->second.text();
}

const std::string* PairResult::fastest(const std::vector<std::string>& of_names) const {
  const std::string* best = nullptr;
  for (const std::string& name : of_names) {
    const auto at = timings.find(name);
    if (at != timings.end() && (best == nullptr || at->second.median() < of(*best).median())) best = &at->first;
  }
  return best;
}

nlohmann::ordered_json PairResult::json() const {
  using Json = nlohmann::ordered_json;
  Json contenders = Json::object();
  for (const std::string& name : names) {
    contenders[name] = timing_json(of(name));
    const auto at = against.find(name);
    if (at != against.end()) contenders[name]["verdicts_against_proven"] = at->second.json();
  }
  Json decided = Json::object();
  for (std::size_t by = 0; by < tally.n_decided_by.size(); ++by) {
    decided[std::string(name_of(static_cast<DecidedBy>(by)))] = tally.n_decided_by[by];
  }
  return {{"pair", pair.name},       {"poses", n_poses},
          {"hits", n_hits},          {"hits_of_trials", tally.n_hits},
          {"decided_by", decided},   {"undecided", tally.n_undecided},
          {"contenders", contenders}};
}

BackendKind renamed(BackendKind kind, const char* name) {
  kind.name = name;
  return kind;
}

std::size_t n_poses_of(const BenchPair& pair, const BenchSettings& settings) {
  return settings.n_poses.value_or(pair.n_poses);
}

PairResult run_pair(const BenchPair& pair, const BenchSettings& settings, const std::vector<Contender>& trials,
                    const std::vector<BackendKind>& engine_kinds, const std::vector<PeerEntry>& peers) {
  const std::vector<Pose> poses = stored_poses(pair.body, settings.seed, n_poses_of(pair, settings));
  PairResult result{pair, poses.size(), 0, {}, {}, {}, {}};
  result.tally = run_monte_carlo(pair.body, pair.body, trial_settings(pair.body, settings.seed, poses.size())).tally;
  std::vector<Contender> contenders = trials;
  std::deque<StoredQuery> queries;  // stay where they are
  for (const BackendKind& kind : engine_kinds) {
    queries.emplace_back(kind, pair.body, poses);
    contenders.push_back(queries.back().contender(poses.size()));
  }
  for (const PeerEntry& peer : peers) {
    if (!peer.kind.takes(pair.body, pair.body)) continue;
    queries.emplace_back(peer.kind, pair.body, poses);
    const bool is_limited = peer.most_seconds < std::numeric_limits<double>::infinity();
    contenders.push_back(
        queries.back().contender(is_limited ? queries.back().n_answered_in(peer.most_seconds) : poses.size()));
  }
  const std::vector<Timing> timings = take_turns(contenders, settings.n_rounds, settings.least_turn_ms);
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    result.names.push_back(contenders[k].name);
    result.timings[contenders[k].name] = timings[k];
  }
  const std::vector<Verdict>& proven = queries.front().verdicts();
  result.n_hits = n_hits(proven);
  for (std::size_t k = engine_kinds.size(); k < queries.size(); ++k) {
    const std::size_t n = contenders[trials.size() + k].n_trials;
    result.against[queries[k].name()] = differences(proven, queries[k].verdicts(), n);
  }
  return result;
}

}  // namespace vex
