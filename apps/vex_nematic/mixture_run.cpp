#include "apps/vex_nematic/mixture_run.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

Json phase_json(const NematicMixtureRun& run, const MixturePhase& phase, bool is_ordered) {
  Json json = {{"number_density", phase.number_density()},
               {"composition", phase.composition()},
               {"volume_fraction", number_or_null(run.found.volume_fraction(phase))},
               {"reduced_density", run.found.reduced_density(phase)}};
  if (is_ordered) json["order_parameters"] = phase.order_parameters;
  return json;
}

}  // namespace

NematicMixtureRun run_mixture(const NematicOptions& options, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  auto [a, b] = load_two_bodies(options.body, options.other, options.body_options);
  NematicMixtureRun run{command, options, std::move(a), std::move(b)};
  if (options.dump_vertices) require_vertices_to_list(run.a, run.b);
  std::vector<double> shares;
  for (const std::string& share : options.compositions) shares.push_back(parse_number(share, "--composition"));
  run.found = mixture_transition(run.a.shape, run.b.shape, shares, options.theory);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

std::string report_text(const NematicMixtureRun& run) {
  std::string text =
      body_text(run.a, "A", run.options.dump_vertices) + body_text(run.b, "B", run.options.dump_vertices);
  text += std::string("\nIsotropic and nematic fluids of A and B, by ") +
          (run.options.theory == NematicTheory::onsager ? "Onsager's second virial theory"
                                                        : "the scaling of Parsons and Lee") +
          "; c = n <V_ex>/2\n";
  std::vector<std::vector<std::string>> lines = {
      {"share of B: isotropic", "nematic", "c isotropic", "c nematic", "S of A", "S of B", "P / kT"}};
  for (const MixtureCoexistence& one : run.found.result.found) {
    lines.push_back({short_number(one.composition, 6), short_number(one.nematic.composition(), 6),
                     short_number(run.found.reduced_density(one.isotropic), 6),
                     short_number(run.found.reduced_density(one.nematic), 6),
                     short_number(one.nematic.order_parameters[0], 5), short_number(one.nematic.order_parameters[1], 5),
                     short_number(one.nematic.pressure, 7)});
  }
  if (lines.size() > 1) text += table_text(lines);
  if (!run.found.result.reason.empty()) text += "   NOT TO THE END: " + run.found.result.reason + "\n";
  for (const ThreeFluids& three : run.found.result.three) {
    text += "   three fluids in equilibrium at P / kT " + short_number(three.isotropic.pressure, 7) +
            ": an isotropic one with a share of B of " + short_number(three.isotropic.composition(), 6) +
            ", and nematic ones with " + short_number(three.nematic[0].composition(), 6) + " and " +
            short_number(three.nematic[1].composition(), 6) + "\n";
  }
  const auto& found = run.found.result.found;
  if (std::ranges::any_of(found, [](const auto& one) { return one.composition == 0.0 || one.composition == 1.0; })) {
    text += "   shares of 0 and 1 stand for a trace of the other kind, 1e-7 at most\n";
  }
  text += "   equilibria of two nematic fluids without an isotropic one are not looked for\n";
  return text;
}

std::string report_json(const NematicMixtureRun& run) {
  Json json = document_head(run.command, run.options, run.found.result.reason.empty(), run.seconds);
  json["bodies"] = {body_json(run.a, run.options.dump_vertices), body_json(run.b, run.options.dump_vertices)};
  json["theory"] = name_of(run.options.theory);
  const NematicMixture& mixture = run.found.mixture;
  json["excluded_volumes"] = {mixture.aa.excluded_volume, mixture.ab.excluded_volume,
                              mixture.bb.excluded_volume};  // A with A, A with B, B with B
  json["mixture"] = Json::array();
  for (const MixtureCoexistence& one : run.found.result.found) {
    json["mixture"].push_back({{"composition", one.composition},
                               {"isotropic", phase_json(run, one.isotropic, false)},
                               {"nematic", phase_json(run, one.nematic, true)},
                               {"pressure", one.nematic.pressure},
                               {"chemical_potentials", one.nematic.chemical_potentials},
                               {"residual", one.residual}});
  }
  json["three_fluids"] = Json::array();
  for (const ThreeFluids& three : run.found.result.three) {
    json["three_fluids"].push_back(
        {{"isotropic", phase_json(run, three.isotropic, false)},
         {"nematic", {phase_json(run, three.nematic[0], true), phase_json(run, three.nematic[1], true)}},
         {"pressure", three.isotropic.pressure}});
  }
  json["reason"] = run.found.result.reason.empty() ? Json(nullptr) : Json(run.found.result.reason);
  return document_text(json);
}

}  // namespace vex
