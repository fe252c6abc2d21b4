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
  const double n = phase.reduced_density / run.b();
  Json json = {{"number_density", number_or_null(n)}};
  json["volume_fraction"] = run.volume() > 0.0 ? number_or_null(n * run.volume()) : Json(nullptr);
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
  text += line("<V_ex>, random orientations", {short_number(run.excluded_volume, 12)});
  const std::vector<double>& of_angle = run.fluid.series;
  text += line("V_ex(gamma) / <V_ex>", {"1 " + std::string(of_angle[1] < 0.0 ? "- " : "+ ") +
                                        short_number(std::fabs(of_angle[1]), 8) + " P2(cos gamma) ..."});
  text += "\nIsotropic and nematic fluid, by " + theory_text(run) + "\n";
  if (!run.result.found) {
    text += "   none: " + run.result.reason + "\n";
  } else {
    const NematicPhase &isotropic = run.result.found->isotropic, &nematic = run.result.found->nematic;
    const auto both = [&](const std::string& name, double factor, int digits) {
      text += line(name, {short_number(isotropic.reduced_density * factor, digits),
                          short_number(nematic.reduced_density * factor, digits)});
    };
    text += line("", {"isotropic", "nematic"});
    both("number density n", 1.0 / run.b(), 8);
    if (run.volume() > 0.0) both("volume fraction n V", run.fluid.volume_by_b2, 8);
    both("reduced density c = n <V_ex>/2", 1.0, 8);
    text += line("order parameter S = <P2>", {"0", short_number(nematic.order_parameter, 8)});
    text += line("pressure P / kT", {short_number(nematic.pressure / run.b(), 8)});
    text += line("pressure P <V_ex> / 2 kT", {short_number(nematic.pressure, 8)});
    text +=
        line("chemical potential / kT", {short_number(nematic.chemical_potential, 8) + "   (of an ideal gas: ln c)"});
    text += "   half of the grid changes them by " + short_number(run.result.found->grid_error, 2) + " of their size\n";
  }
  for (const std::string& note : run.notes) text += "   note: " + note + "\n";
  return text;
}

std::string report_json(const NematicRun& run) {
  Json json = document_head(run.command, run.options, true, run.seconds);
  json["bodies"] = {body_json(run.body, run.options.dump_vertices)};
  json["theory"] = name_of(run.options.theory);
  json["trial_function"] = run.options.trial_function ? Json("onsager") : Json(nullptr);
  json["excluded_volume"] = number_or_null(run.excluded_volume);
  json["isotropic"] = nullptr;
  json["nematic"] = nullptr;
  json["pressure"] = nullptr;
  json["reduced_pressure"] = nullptr;
  json["chemical_potential"] = nullptr;
  json["grid_error"] = nullptr;
  if (run.result.found) {
    const Coexistence& found = *run.result.found;
    json["isotropic"] = phase_json(run, found.isotropic);
    json["nematic"] = phase_json(run, found.nematic);
    json["nematic"]["order_parameter"] = found.nematic.order_parameter;
    json["pressure"] = number_or_null(found.nematic.pressure / run.b());
    json["reduced_pressure"] = found.nematic.pressure;
    json["chemical_potential"] = found.nematic.chemical_potential;
    json["grid_error"] = found.grid_error;
    Json density = Json::array();
    for (std::size_t i = 0; i < found.nematic.cosines.size(); ++i) {
      density.push_back({found.nematic.cosines[i], found.nematic.density[i]});
    }
    json["density"] = std::move(density);  // [cos theta, 4 pi f]
  } else {
    json["no_transition_reason"] = run.result.reason;
  }
  json["excluded_volume_series"] = Json::array();  // of P_0, P_2, P_4 ... over <V_ex>
  for (std::size_t k = 0; k < run.fluid.series.size() && k <= 16; ++k) {
    json["excluded_volume_series"].push_back(run.fluid.series[k]);
  }
  json["notes"] = run.notes;
  return document_text(json);
}

}  // namespace vex
