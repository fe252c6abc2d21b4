#include "apps/vex_merge/merged_document.h"

#include <limits>
#include <optional>
#include <vector>

#include "apps/common/estimate_report.h"
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

ExcludedVolume result_of(const MergedTrials& merged) {
  const Json& document = merged.first;
  const std::string estimator = document.at("estimate").at("estimator").get<std::string>();
  ExcludedVolume result;
  result.estimator = find_estimator(estimator);
  if (result.estimator == nullptr) {
    throw InputError("a document of an estimator that is none (" + estimator + ") - it is of another version of vex");
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

}  // namespace

MergedResult merged_result(const MergedTrials& merged, const std::string& command) {
  try {
    MergedResult all{result_of(merged), merged.first};
    Json& document = all.document;
    const RunRecord& record = all.result.record;
    document["command"] = command;
    document["seconds"] = record.seconds;
    set_tallied(document["estimate"], all.result);
    set_comparison(document, all.result);
    forget_times(document);
    document["tally"] = tally_json(merged.of, all.result);
    if (document.contains("verification")) document["verification"] = verification_json(record);
    if (document.contains("cross_check")) {
      document["n_disagreements"] = record.disagreements.n_all;
      document["disagreements"] = disagreements_json(record, document["cross_check"].get<std::vector<std::string>>());
    }
    return all;
  } catch (const Json::exception& error) {
    throw InputError("a document lacks what vex_mesh writes (" + std::string(error.what()) +
                     ") - give what it wrote with --json");
  }
}

}  // namespace vex
