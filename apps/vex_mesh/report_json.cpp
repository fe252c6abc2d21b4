// The document of --json.
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/common/estimate_report.h"
#include "apps/vex_mesh/report.h"
#include "apps/vex_mesh/run_facts.h"
#include "apps/vex_mesh/run_identity.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

Json pilot_json(const MeshRun& run) {
  Json list = Json::array();
  for (const Candidate& candidate : run.result.candidates) {
    list.push_back({{"estimator", candidate.estimator->name},
                    {"sequence", name_of(candidate.sequence)},
                    {"runs_gjk", candidate.estimator->runs_gjk},
                    {"trials", candidate.cost.n_trials},
                    {"seconds_per_trial", candidate.cost.seconds_per_trial},
                    {"relative_error", number_or_null(candidate.cost.relative_error)},
                    {"slope", candidate.cost.slope},
                    {"seconds_to_this_error", has_trials(run) ? number_or_null(seconds_of(candidate, run)) : Json()}});
  }
  return list;
}

Json control_json(const MeshRun& run) {
  return {{"bodies", {run.control_bodies.front().source, run.control_bodies.back().source}},
          {"excluded_volume", control_mean(run)},
          {"weight", run.result.control_weight}};
}

Json estimate_json(const MeshRun& run) {
  Json json;
  const bool has_hits = samples_poses(run);
  const bool is_run = run.result.estimator != nullptr;
  json["estimator"] = is_run ? Json(run.result.estimator->name) : Json(nullptr);
  json["sequence"] = is_run ? Json(name_of(run.result.sequence)) : Json(nullptr);
  json["backend"] = runs_gjk(run) ? run.options.settings.backend.name : "none";
  json["orientations"] = run.options.settings.law.name();
  set_tallied(json, run.result);
  if (!run.control_bodies.empty()) json["control_variate"] = control_json(run);
  json["domain"] = has_hits ? Json(name_of(run.result.domain.kind)) : Json(nullptr);
  json["quick_verdicts"] = has_hits && run.options.settings.quick_verdicts && !run.options.settings.backend.is_peer;
  json["isa"] = name_of(run.options.settings.instruction_set);
  return json;
}

Json reference_json(const Reference& reference) {
  return {{"kind", name_of(reference.kind)},
          {"excluded_volume", number_or_null(reference.value)},
          {"std_error", reference.std_error},
          {"reduced", number_or_null(reference.reduced)},
          {"b2", number_or_null(reference.b2)}};
}

}  // namespace

std::string report_json(const MeshRun& run) {
  Json json = document_head(run.command, run.options, run.result.record.complete, run.result.record.seconds);
  json["bodies"] = {body_json(run.a, run.options.dump_vertices), body_json(run.b, run.options.dump_vertices)};
  const std::optional<Reference>& reference = run.result.reference;
  const bool is_formula = reference && reference->kind == Reference::Kind::formula;
  json["formula"] = nullptr;
  if (is_formula) {
    json["formula"] = {{"excluded_volume", number_or_null(reference->value)},
                       {"reduced", number_or_null(reference->reduced)},
                       {"b2", number_or_null(reference->b2)}};
  } else {
    json["formula_reason"] = run.result.reference_reason;
    json["exact_average"] = nullptr;
    if (reference) json["exact_average"] = {{"excluded_volume", reference->value}, {"error", reference->std_error}};
  }
  json["reference"] = reference ? reference_json(*reference) : Json(nullptr);
  if (!reference) json["reference_reason"] = run.result.reference_reason;
  const std::optional<double> order_parameter = run.options.settings.law.order_parameter();
  json["order_parameter"] = order_parameter ? Json(*order_parameter) : Json(nullptr);
  if (const std::optional<std::array<double, 2>> each = run.options.settings.law.order_parameters()) {
    json["order_parameters"] = *each;
  }
  json["estimate"] = estimate_json(run);
  if (!run.result.candidates.empty()) json["pilot"] = pilot_json(run);
  set_comparison(json, run.result);
  if (has_trials(run)) json["tally"] = tally_json(trials_identity(run), run.result);
  if (run.options.settings.verify) json["verification"] = verification_json(run.result.record);
  if (run.options.is_cross_check) {
    json["n_disagreements"] = run.result.record.disagreements.n_all;
    json["disagreements"] = disagreements_json(run.result.record, backend_names(run));
    json["cross_check"] = backend_names(run);
    json["cross_check_left_out"] = run.left_out;
  }
  return document_text(json);
}

}  // namespace vex
