#include "apps/vex_stress/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

// missed+invented, and what was left open: "3+0 (12)".
std::string counts_text(const StressCounts& counts) {
  if (counts.n_pairs == 0) return "-";
  std::string text =
      counts.n_wrong() == 0 ? "0" : std::to_string(counts.n_missed) + "+" + std::to_string(counts.n_invented);
  if (counts.n_undecided > 0) text += " (" + std::to_string(counts.n_undecided) + ")";
  return text;
}

Json example_json(const std::optional<StressExample>& example) {
  if (!example) return nullptr;
  return {{"index", example->index}, {"bodies", example->pair}, {"pose", twelve_numbers(example->a_from_b)}};
}

std::string example_text(const StressExample& example) {
  std::string text = "pose " + std::to_string(example.index) + ", " + example.pair + ",";
  for (const double x : twelve_numbers(example.a_from_b)) text += " " + shortest_number(x);
  return text + "\n";
}

Json counts_json(const StressCounts& counts) {
  return {{"pairs", counts.n_pairs},
          {"wrong", counts.n_wrong()},
          {"missed", counts.n_missed},
          {"invented", counts.n_invented},
          {"undecided", counts.n_undecided},
          {"undecided_beyond_band", counts.n_beyond_band},
          {"widest_undecided", number_or_null(counts.widest_undecided)},
          {"capped", counts.n_capped},
          {"unproven", counts.n_unproven},
          {"escalated", counts.n_escalated},
          {"slowest_us", counts.slowest_us},
          {"first_wrong", example_json(counts.first_wrong)},
          {"first_beyond_band", example_json(counts.first_beyond_band)},
          {"first_unproven", example_json(counts.first_unproven)}};
}

}  // namespace

StressCounts StressRun::total(std::size_t backend) const {
  StressCounts sum;
  for (const StressRow& row : rows) sum.add(row.counts[backend]);
  return sum;
}

std::string report_json(const StressRun& run) {
  Json document = document_head(run.command, run.options, run.complete, run.seconds);
  Json strata = Json::array();
  for (const StressRow& row : run.rows) {
    Json backends = Json::object();
    for (std::size_t k = 0; k < row.counts.size(); ++k) {
      if (row.counts[k].n_pairs > 0) backends[run.options.backends[k].name] = counts_json(row.counts[k]);
    }
    strata.push_back({{"name", row.name},
                      {"bodies", row.bodies},
                      {"distance", number_or_null(row.distance)},
                      {"pairs", row.n_pairs},
                      {"overlaps", row.n_overlaps},
                      {"unjudged", row.n_unjudged},
                      {"complete", row.complete},
                      {"backends", backends}});
  }
  document["strata"] = strata;
  Json totals = Json::object();
  for (std::size_t k = 0; k < run.options.backends.size(); ++k) {
    totals[run.options.backends[k].name] = counts_json(run.total(k));
  }
  document["total"] = totals;
  return document_text(document);
}

std::string report_text(const StressRun& run) {
  std::vector<std::vector<std::string>> lines = {{"stratum", "pairs", "overlaps", "unjudged"}};
  for (const BackendKind& kind : run.options.backends) lines[0].push_back(kind.name);
  lines[0].insert(lines[0].end(), {"escalated", "slowest/us"});
  const auto add = [&](const std::string& name, const StressRow& row) {
    std::vector<std::string> line = {name, std::to_string(row.n_pairs), std::to_string(row.n_overlaps),
                                     std::to_string(row.n_unjudged)};
    for (const StressCounts& counts : row.counts) line.push_back(counts_text(counts));
    line.insert(line.end(), {std::to_string(row.counts[0].n_escalated), fixed_number(0, row.counts[0].slowest_us)});
    lines.push_back(line);
  };
  StressRow all;
  for (const StressRow& row : run.rows) {
    add(row.name, row);
    all.n_pairs += row.n_pairs;
    all.n_overlaps += row.n_overlaps;
    all.n_unjudged += row.n_unjudged;
  }
  for (std::size_t k = 0; k < run.options.backends.size(); ++k) all.counts.push_back(run.total(k));
  add("all", all);
  const StressCounts& ours = all.counts[0];
  std::string text = table_text(lines, 2) + "\n";
  text +=
      "  Of each backend: overlaps missed+invented (undecided); 0 where no answer is wrong, - where it has no such "
      "test.\n";
  text += "  escalated, slowest/us: of gjk, answers that double precision could not prove; its slowest query.\n";
  text += "  gjk: " + std::to_string(ours.n_wrong()) + " wrong, " + std::to_string(ours.n_undecided) + " undecided, " +
          std::to_string(ours.n_beyond_band) + " of them polytopes or farther than " + short_number(kUndecidedBand) +
          " (R_A + R_B) from contact, " + std::to_string(ours.n_capped) + " by an iteration cap\n";
  text += "  gjk: " + std::to_string(ours.n_pairs - ours.n_undecided) + " certificates checked in exact arithmetic, " +
          std::to_string(ours.n_unproven) + " not accepted\n";
  for (const StressRow& row : run.rows) {
    const StressCounts& counts = row.counts[0];
    if (counts.n_faults() == 0) continue;
    text += "    " + row.name + ": " + std::to_string(counts.n_wrong()) + " wrong, " +
            std::to_string(counts.n_beyond_band) + " beyond the band, " + std::to_string(counts.n_capped) +
            " capped, " + std::to_string(counts.n_unproven) + " unproven; undecided up to " +
            short_number(counts.widest_undecided, 2) + "\n";
    if (counts.first_wrong) text += "      first wrong: " + example_text(*counts.first_wrong);
    if (counts.first_beyond_band) text += "      first beyond the band: " + example_text(*counts.first_beyond_band);
    if (counts.first_unproven) text += "      first unproven: " + example_text(*counts.first_unproven);
  }
  text += "  " + fixed_number(1, run.seconds) + " s on " + std::to_string(run.options.n_threads) + " threads\n";
  if (!run.complete) text += "Interrupted: the last stratum is not complete.\n";
  return text;
}

std::string list_text(const StressOptions& options) {
  std::size_t widest = 0;
  for (const Stratum& stratum : options.strata) widest = std::max(widest, stratum.name.size());
  std::string text;
  for (const Stratum& stratum : options.strata) {
    text += stratum.name + std::string(widest + 2 - stratum.name.size(), ' ') + stratum.bodies + "\n";
  }
  return text;
}

}  // namespace vex
