// What vex_nematic says: on the screen and in JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_nematic/nematic_run.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

Json phase_json(const NematicRun& run, const NematicPhase& phase) {
  Json json = {{"number_density", number_or_null(run.found.number_density(phase))}};
  json["volume_fraction"] = number_or_null(run.found.volume_fraction(phase));
  json["reduced_density"] = phase.reduced_density;
  return json;
}

std::string line(const std::string& name, const std::vector<std::string>& values) {
  std::string text = "   " + name + std::string(name.size() < 34 ? 34 - name.size() : 1, ' ');
  for (const std::string& value : values) text += value + std::string(value.size() < 16 ? 16 - value.size() : 1, ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string theory_text(const NematicRun& run) {
  std::string text = run.options.theory == NematicTheory::onsager ? "Onsager's second virial theory"
                                                                  : "the scaling of Parsons and Lee";
  if (run.options.trial_function) text += ", with his trial function";
  return text;
}

}  // namespace

std::string report_text(const NematicRun& run) {
  std::string text = body_text(run.body, "BODY", run.options.dump_vertices);
  const NematicTransition& found = run.found;
  text += line("<V_ex>, random orientations", {short_number(found.excluded_volume, 12)});
  const EvenSeries& of_angle = found.fluid.series;
  text += line("V_ex(gamma) / <V_ex>", {"1 " + std::string(of_angle[1] < 0.0 ? "- " : "+ ") +
                                        short_number(std::fabs(of_angle[1]), 8) + " P2(cos gamma) ..."});
  text += "\nIsotropic and nematic fluid, by " + theory_text(run) + "\n";
  if (!found.result.found) {
    text += "   none: " + found.result.reason + "\n";
  } else {
    const NematicPhase &isotropic = found.result.found->isotropic, &nematic = found.result.found->nematic;
    const auto both = [&](const std::string& name, double of_isotropic, double of_nematic) {
      text += line(name, {short_number(of_isotropic, 8), short_number(of_nematic, 8)});
    };
    text += line("", {"isotropic", "nematic"});
    both("number density n", found.number_density(isotropic), found.number_density(nematic));
    if (found.volume > 0.0) {
      both("volume fraction n V", found.volume_fraction(isotropic), found.volume_fraction(nematic));
    }
    both("reduced density c = n <V_ex>/2", isotropic.reduced_density, nematic.reduced_density);
    text += line("order parameter S = <P2>", {"0", short_number(nematic.order_parameter, 8)});
    text += line("pressure P / kT", {short_number(found.pressure(nematic), 8)});
    text += line("pressure P <V_ex> / 2 kT", {short_number(nematic.pressure, 8)});
    text +=
        line("chemical potential / kT", {short_number(nematic.chemical_potential, 8) + "   (of an ideal gas: ln c)"});
    text +=
        "   half of the grid changes them by " + short_number(found.result.found->grid_error, 2) + " of their size\n";
  }
  for (const std::string& note : found.notes) text += "   note: " + note + "\n";
  return text;
}

std::string report_json(const NematicRun& run) {
  Json json = document_head(run.command, run.options, true, run.seconds);
  const NematicTransition& transition = run.found;
  json["bodies"] = {body_json(run.body, run.options.dump_vertices)};
  json["theory"] = name_of(run.options.theory);
  json["trial_function"] = run.options.trial_function ? Json("onsager") : Json(nullptr);
  json["excluded_volume"] = number_or_null(transition.excluded_volume);
  json["isotropic"] = nullptr;
  json["nematic"] = nullptr;
  json["pressure"] = nullptr;
  json["reduced_pressure"] = nullptr;
  json["chemical_potential"] = nullptr;
  json["grid_error"] = nullptr;
  if (transition.result.found) {
    const Coexistence& found = *transition.result.found;
    json["isotropic"] = phase_json(run, found.isotropic);
    json["nematic"] = phase_json(run, found.nematic);
    json["nematic"]["order_parameter"] = found.nematic.order_parameter;
    json["pressure"] = number_or_null(transition.pressure(found.nematic));
    json["reduced_pressure"] = found.nematic.pressure;
    json["chemical_potential"] = found.nematic.chemical_potential;
    json["grid_error"] = found.grid_error;
    Json density = Json::array();
    for (std::size_t i = 0; i < found.nematic.cosines.size(); ++i) {
      density.push_back({found.nematic.cosines[i], found.nematic.density[i]});
    }
    json["density"] = std::move(density);  // [cos theta, 4 pi f]
  } else {
    json["no_transition_reason"] = transition.result.reason;
  }
  json["excluded_volume_series"] = Json::array();  // of P_0, P_2, P_4 ... over <V_ex>
  const EvenSeries& series = transition.fluid.series;
  for (std::size_t k = 0; k < series.size() && k <= 16; ++k) json["excluded_volume_series"].push_back(series[k]);
  json["notes"] = transition.notes;
  return document_text(json);
}

}  // namespace vex
