#include "apps/common/estimate_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/common/common_options.h"
#include "engine/sampling/run_state_text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

bool has_hits(const ExcludedVolume& result) { return result.estimator != nullptr && result.estimator->samples_poses; }
bool runs_gjk(const ExcludedVolume& result) { return result.estimator == nullptr || result.estimator->runs_gjk; }

}  // namespace

double sampling_volume(const ExcludedVolume& result) {
  const Tally& tally = result.record.tally;
  return result.stratified && tally.n_trials > 0 ? tally.by_class.unit : mean_sampling_volume(tally, result.domain);
}

void set_tallied(Json& estimate, const ExcludedVolume& result) {
  const Tally& tally = result.record.tally;
  const bool is_known = !std::isnan(result.value);
  estimate["excluded_volume"] = number_or_null(result.value);
  estimate["std_error"] = is_known ? number_or_null(result.std_error) : Json(nullptr);
  const Interval95& ci95 = result.ci95;  // of one trial it is without end
  estimate["ci95"] = is_known && std::isfinite(ci95.upper) ? Json{ci95.lower, ci95.upper} : Json(nullptr);
  estimate["reduced"] = number_or_null(result.reduced);
  estimate["b2"] = number_or_null(result.b2);
  estimate["trials"] = tally.n_trials;
  estimate["hits"] = has_hits(result) ? Json(tally.n_hits) : Json(nullptr);
  estimate["undecided"] = tally.n_undecided;
  estimate["sampling_volume"] = has_hits(result) ? Json(sampling_volume(result)) : Json(nullptr);
  estimate["seconds"] = result.record.seconds;
  estimate["trials_per_second"] = number_or_null(static_cast<double>(tally.n_trials) / result.record.seconds);
  estimate["stopped_by"] = result.no_run_reason.empty() ? std::string(name_of(result.record.stopped_by)) : "no-volume";
  Json& decided_by = estimate["decided_by"] = Json::object();
  for (const DecidedBy by : kAllDecidedBy) {
    decided_by[std::string(name_of(by))] =
        runs_gjk(result) ? tally.n_decided_by[static_cast<std::size_t>(by)] : std::uint64_t{0};
  }
  if (!runs_gjk(result)) decided_by["support_values"] = tally.n_trials;
  Json& undecided = estimate["undecided_trials"] = Json::array();
  for (const UndecidedTrial& trial : result.record.undecided.kept) {
    undecided.push_back({{"index", trial.index}, {"reason", name_of(trial.reason)}});
  }
}

void set_comparison(Json& document, const ExcludedVolume& result) {
  if (result.z) {
    document["z"] = *result.z;
    document.erase("z_reason");
  } else {
    document["z"] = nullptr;
    document["z_reason"] = result.z_reason;
  }
}

Json tally_json(const std::vector<std::string>& of, const ExcludedVolume& result) {
  RunState state;
  state.first_trial = result.record.first_trial;
  state.done = result.record;
  // A default one where the estimator draws from none.
  state.domain = result.domain.kind;
  state.domain_volume = result.domain.volume;
  state.seconds = result.record.seconds;
  return tally_json(of, state);
}

Json tally_json(const std::vector<std::string>& of, const RunState& state) {
  Json lines = Json::array();
  const std::string text = run_state_text(state);
  for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
    lines.push_back(rest.substr(0, rest.find('\n')));
  }
  return {{"first_trial", state.first_trial}, {"trials", state.done.tally.n_trials}, {"of", of}, {"state", lines}};
}

Json disagreements_json(const RunRecord& record, const std::vector<std::string>& names) {
  Json list = Json::array();
  for (const Disagreement& found : record.disagreements.kept) {
    Json verdicts;
    for (std::size_t k = 0; k < names.size(); ++k) verdicts[names[k]] = name_of(found.outcomes[k]);
    list.push_back({{"index", found.index}, {"matrix", twelve_numbers(found.a_from_b)}, {"verdicts", verdicts}});
  }
  return list;
}

Json verification_json(const RunRecord& record) {
  const FirstOf<UnprovenTrial>& unproven = record.unproven;
  Json json{{"proven", record.n_proven_again},
            {"unproven", unproven.n_all},
            {"undecided", record.tally.n_undecided},
            {"faults", Json::array()}};
  for (const UnprovenTrial& trial : unproven.kept) {
    json["faults"].push_back({{"index", trial.index},
                              {"matrix", twelve_numbers(trial.a_from_b)},
                              {"verdict", name_of(trial.outcome)},
                              {"fault", trial.fault}});
  }
  return json;
}

std::string why_incomplete(StopReason reason) {
  switch (reason) {
    case StopReason::trials:
    case StopReason::relative_error:
    case StopReason::seconds: return "";
    case StopReason::max_trials: return "incomplete: --max-trials was reached first";
    case StopReason::undecided: return "incomplete: undecided trials alone keep the error above what was asked for";
    case StopReason::rounding: return "incomplete: rounding alone keeps the error above what was asked for";
    case StopReason::in_vain: return "incomplete: more than --max-trials would be needed";
    case StopReason::interrupted: return "interrupted: this is what was done until then";
  }
  return "";
}

}  // namespace vex
