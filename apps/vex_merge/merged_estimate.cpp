#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "apps/common/estimate_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_merge/documents.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

double number_or_nan(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Measures measures_of(const Json& body) {
  return {number_or_nan(body.at("volume")), number_or_nan(body.at("surface_area")),
          number_or_nan(body.at("integrated_mean_curvature"))};
}

std::optional<Reference> reference_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  const bool is_formula = json.at("kind") == name_of(Reference::Kind::formula);
  return Reference{is_formula ? Reference::Kind::formula : Reference::Kind::exact,
                   number_or_nan(json.at("excluded_volume")), number_or_nan(json.at("std_error")),
                   number_or_nan(json.at("reduced")), number_or_nan(json.at("b2"))};
}

ExcludedVolume result_of(const MergedTally& merged, const Json& document) {
  const std::string estimator = document.at("estimate").at("estimator").get<std::string>();
  ExcludedVolume result;
  result.estimator = find_estimator(estimator);
  if (result.estimator == nullptr) {
    throw InputError("a document of an estimator that is none (" + printable(estimator) +
                     ") - it is of another version of vex");
  }
  static_cast<BlockRecord&>(result.record) = merged.state.done;
  result.record.first_trial = merged.state.first_trial;
  result.record.stopped_by = StopReason::trials;
  result.record.complete = true;
  result.record.seconds = merged.state.seconds;
  const ClassTally::Kind kind = result.record.tally.by_class.kind;
  result.sequence = kind == ClassTally::Kind::scramblings ? Sequence::sobol : Sequence::random;
  result.stratified = kind == ClassTally::Kind::strata;
  result.domain.kind = merged.state.domain;
  result.domain.volume = merged.state.domain_volume;
  result.reference = reference_of(document.at("reference"));
  if (document.contains("reference_reason")) result.reference_reason = document["reference_reason"].get<std::string>();
  const bool hits_by_construction = document.contains("z_reason") && document["z_reason"] == kHitsByConstruction;
  conclude(measures_of(document.at("bodies").at(0)), measures_of(document.at("bodies").at(1)), hits_by_construction,
           &result);
  return result;
}

// What it would have cost others is a time, and times of several runs tell none of one.
void forget_times(Json& document) {
  if (!document.contains("pilot")) return;
  for (Json& candidate : document["pilot"]) candidate["seconds_to_this_error"] = nullptr;
}

std::string text_of(const RunState& merged, const ExcludedVolume& result, const MergeOptions& options) {
  const Tally& tally = result.record.tally;
  std::string text = "trials " + std::to_string(merged.first_trial) + " ... " + std::to_string(merged.end() - 1) +
                     ", " + std::string(result.estimator->name) + "\n";
  text += "   <V_ex>, Monte Carlo               " + with_error(result.value, result.std_error) + "\n";
  if (result.estimator->samples_poses) {
    text += "   hits / trials                     " + std::to_string(tally.n_hits) + " / " +
            std::to_string(tally.n_trials) + "\n";
  } else {
    text += "   values                            " + std::to_string(tally.n_trials) + "\n";
  }
  if (tally.n_undecided > 0) text += "   undecided                         " + std::to_string(tally.n_undecided) + "\n";
  text += "   time                              " + short_number(result.record.seconds, 3) + " s, of all runs\n";
  if (!result.z) return text + "z: none - " + result.z_reason + "\n";
  return text + "z = " + short_number(*result.z, 3) + " standard errors between Monte Carlo and " +
         (result.reference->kind == Reference::Kind::formula ? "formula" : "exact average") +
         (std::fabs(*result.z) > options.max_z ? ": THEY DISAGREE" : ": they agree") + "\n";
}

// Of a document's entries those that all ranges have in common, besides what its tally says in more detail.
void require_same_settings(const Document& first, const Document& other) {
  for (const char* const key : {"estimator", "sequence", "backend", "orientations", "domain", "quick_verdicts"}) {
    if (other.json.at("estimate").at(key) == first.json.at("estimate").at(key)) continue;
    throw InputError("documents of unlike runs (" + printable(other.file) + " has another " + key + " than " +
                     printable(first.file) + ") - give those of one run");
  }
}

}  // namespace

MergedReport merged_estimate(const std::vector<Document>& documents, const MergeOptions& options) {
  std::vector<TallyOfFile> tallies;
  for (const Document& one : documents) {
    const Json &estimate = one.json.at("estimate"), &tally = one.json.at("tally");
    if (estimate.at("trials") != tally.at("trials")) {
      refuse_document("a document's estimate is of other trials than its tally", one.file, "it is damaged");
    }
    require_ended_by_trials(one.json.at("complete") == true, estimate.at("stopped_by").get<std::string>(),
                            tally.at("first_trial").get<std::uint64_t>() + tally.at("trials").get<std::uint64_t>(),
                            one.file);
    tallies.emplace_back(one.file, &tally);
  }
  const MergedTally merged = merge_tallies(tallies, options);
  for (const Document& one : documents) require_same_settings(documents.front(), one);
  MergedReport all{documents[merged.first].json, {}};
  Json& document = all.document;
  const ExcludedVolume result = result_of(merged, document);
  const RunRecord& record = result.record;
  document["seconds"] = record.seconds;
  set_tallied(document["estimate"], result);
  set_comparison(document, result);
  forget_times(document);
  document["tally"] = tally_json(merged.of, result);
  if (document.contains("verification")) document["verification"] = verification_json(record);
  if (document.contains("cross_check")) {
    document["n_disagreements"] = record.disagreements.n_all;
    document["disagreements"] = disagreements_json(record, document["cross_check"].get<std::vector<std::string>>());
  }
  all.text = text_of(merged.state, result, options);
  all.disagrees = result.z && std::fabs(*result.z) > options.max_z;
  return all;
}

}  // namespace vex
