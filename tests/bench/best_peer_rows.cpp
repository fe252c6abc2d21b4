#include "tests/bench/best_peers.h"
#include "tests/bench/pair_result.h"
#include "tests/bench/trial_rows.h"

namespace vex {

BenchReport compare_best_peers(const BenchSettings& settings) {
  using Json = nlohmann::ordered_json;
  constexpr double kTurnSeconds = 0.2;  // of a peer; some scan 10 000 vertices a support call
  const std::vector<BestPeer> peers = best_peers();
  std::vector<PeerEntry> entries;
  std::vector<std::string> of_ccd, of_fcl;
  std::string legend;
  for (const BestPeer& peer : peers) {
    entries.push_back({peer.kind, kTurnSeconds});
    (peer.kind.name.rfind("ccd-", 0) == 0 ? of_ccd : of_fcl).push_back(peer.kind.name);
    legend += "- `" + peer.kind.name + "`: " + peer.setting + ".\n";
  }
  MarkdownTable table({"pair", "contender", "ns", "times a whole trial", "times a query", "against proven verdicts"});
  MarkdownTable fastest_table(
      {"pair", "libccd's fastest", "times a whole trial", "FCL's fastest", "times a whole trial"});
  Json rows = Json::array();
  for (const BenchPair& pair : bench_pairs()) {
    const MonteCarloSettings trial = trial_settings(pair.body, settings.seed, n_poses_of(pair, settings));
    const PairResult result = run_pair(pair, settings, {trial_contender(kTrial, pair.body, trial)},
                                       {renamed(gjk_backend(), kQuery)}, entries);
    Json row = result.json();
    for (const std::string& name : result.names) {
      const double to_trial = result.ratio_of(name), to_query = result.ratio_of(name, kQuery);
      const auto against = result.against.find(name);
      table.add(
          {pair.name, name, result.timing_cell(name), three_digits(to_trial), three_digits(to_query),
           against == result.against.end()
               ? "proven"
               : against->second.text() + " of " + grouped(against->second.n_compared + against->second.n_given_up)});
      row["contenders"][name]["ratio_to_trial"] = to_trial;
      row["contenders"][name]["ratio_to_query"] = to_query;
    }
    for (const BestPeer& peer : peers) {
      if (result.find(peer.kind.name) != nullptr) row["contenders"][peer.kind.name]["setting"] = peer.setting;
    }
    std::vector<std::string> cells = {pair.name};
    for (const std::vector<std::string>* library : {&of_ccd, &of_fcl}) {
      const std::string* const fastest = result.fastest(*library);
      cells.push_back(fastest == nullptr ? "-" : "`" + *fastest + "`");
      cells.push_back(fastest == nullptr ? "-" : three_digits(result.ratio_of(*fastest)));
    }
    fastest_table.add(cells);
    rows.push_back(row);
  }
  return {"### The peers' own best settings\n\n" + std::string(kHowTimed) +
              "Verdicts against the engine's, which are proven: overlaps missed + overlaps invented, in brackets poses "
              "given up.\n\n- `trial`, `query`: the engine, a whole trial and its query alone.\n" +
              legend + "\n" + table.text() + "\nThe fastest of each library:\n\n" + fastest_table.text(),
          rows};
}

}  // namespace vex
