#include "apps/vex_mesh/html_report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/html/page.h"
#include "apps/common/html/plot.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

std::string name_of(const LoadedBody& body) { return body.source == "-" ? "standard input" : body.source; }

bool has_result(const MeshRun& run) {
  return run.result.record.tally.n_trials > 0 || !run.result.no_run_reason.empty();
}

std::string reference_name(const MeshRun& run) {
  if (!run.result.reference) return "";
  return run.result.reference->kind == Reference::Kind::formula ? "the formula" : "the exact average";
}

std::string exact_or_with_error(double value, double error) {
  return error > 1e-11 * std::fabs(value) ? with_error(value, error) : short_number(value, 12);
}

std::string laws_words(const OrientationLaw& law) {
  switch (law.kind()) {
    case OrientationLaw::Kind::isotropic: return "random orientations, all equally likely";
    case OrientationLaw::Kind::aligned: return "parallel bodies";
    case OrientationLaw::Kind::fixed: return "one orientation, " + law.name();
    case OrientationLaw::Kind::cone: return "axes within a cone, " + law.name();
    case OrientationLaw::Kind::angle: return "axes at one angle, " + law.name();
    case OrientationLaw::Kind::onsager: return "Onsager’s trial function, " + law.name();
    case OrientationLaw::Kind::maier_saupe: return "axes by Maier’s and Saupe’s law, " + law.name();
    case OrientationLaw::Kind::table: return "axes by a density given by points, " + law.name();
    case OrientationLaw::Kind::each: return "axes by laws of their own, " + law.name();
  }
  return law.name();
}

void add_headline(HtmlPage& page, const MeshRun& run) {
  const ExcludedVolume& result = run.result;
  if (!has_result(run)) {
    page.headline("No trial was done");
  } else {
    page.headline(PageNumber{"⟨V_ex⟩", "/estimate/excluded_volume", with_error(result.value, result.std_error),
                             "the volume around A that is forbidden to the centre of B, averaged over " +
                                 laws_words(run.options.settings.law)});
  }
  if (!result.no_run_reason.empty()) page.verdict(Tone::good, result.no_run_reason);
  if (!result.complete) {
    page.verdict(Tone::wait, result.record.stopped_by == StopReason::interrupted
                                 ? "Incomplete: the run was interrupted, and this is what was done until then"
                                 : "Incomplete: stopped by " + std::string(name_of(result.record.stopped_by)));
  }
  if (result.z) {
    const bool agrees = std::fabs(*result.z) <= run.options.max_z;
    page.verdict(agrees ? Tone::good : Tone::bad, std::string(agrees ? "Agrees with " : "DISAGREES with ") +
                                                      reference_name(run) + ": " +
                                                      short_number(std::fabs(*result.z), 2) + " standard errors apart");
  } else if (result.no_run_reason.empty()) {
    page.verdict(Tone::wait, "Not compared: " + result.z_reason);
  }
}

void add_results(HtmlPage& page, const MeshRun& run) {
  const ExcludedVolume& result = run.result;
  std::vector<PageNumber> rows;
  const double error = result.std_error;
  const auto add = [&](const std::string& name, const std::string& path, const std::string& shown,
                       const std::string& meaning) {
    rows.push_back({name, path, shown, meaning});
  };
  if (has_result(run)) {
    add("⟨V_ex⟩, Monte Carlo", "/estimate/excluded_volume", with_error(result.value, error),
        "The result. The digits in parentheses are one standard error, in units of the last digits shown.");
    add("standard error", "/estimate/std_error",
        std::isfinite(error) ? short_number(error, 3) : std::string("not known: too few trials"),
        "Two of three such runs, with other seeds, lie within this of the truth.");
  }
  if (result.reference) {
    const Reference& reference = *result.reference;
    add("⟨V_ex⟩, " + reference_name(run), "/reference/excluded_volume",
        exact_or_with_error(reference.value, reference.std_error),
        reference.kind == Reference::Kind::formula
            ? "From volume V, surface S and integrated mean curvature M alone: V_A + V_B + (M_A S_B + M_B S_A)/4π. It "
              "shares nothing with the run."
            : "From mixed volumes, without any overlap test.");
  }
  if (result.z) {
    add("z", "/z", short_number(*result.z, 3),
        "How far the two are apart, in standard errors; beyond " + short_number(run.options.max_z) +
            " they are said to disagree.");
  }
  if (has_result(run)) {
    add("B₂", "/estimate/b2", with_error(result.b2, 0.5 * error),
        "The second virial coefficient of hard bodies, ⟨V_ex⟩/2: the first correction to the ideal gas.");
    if (std::isfinite(result.reduced) && result.value > 0.0) {
      add("⟨V_ex⟩ / √(V_A V_B)", "/estimate/reduced",
          with_error(result.reduced, error * (result.reduced / result.value)),
          "The same in units of the bodies’ volume: 8 for equal spheres, more for every other pair of equal bodies.");
    }
    if (result.record.tally.n_trials > 0) {
      add("trials", "/estimate/trials", short_count(static_cast<double>(result.record.tally.n_trials)),
          "Of the estimator " + std::string(result.estimator->name) + " (" + std::string(result.estimator->meaning) +
              "): " + result.chosen_because + ".");
    }
    if (result.record.tally.n_undecided > 0) {
      add("undecided", "/estimate/undecided", std::to_string(result.record.tally.n_undecided),
          "Trials within rounding of contact that no proof decides; what they leave open is part of the error.");
    }
    add("seconds", "/estimate/seconds", short_number(result.record.seconds, 3),
        "On " + plural(static_cast<std::uint64_t>(run.options.n_threads), "thread", "threads") + ".");
  }
  page.begin_section("What came out", true);
  page.numbers("Lengths are in the unit of the bodies, volumes in its cube.", rows);
}

void add_convergence(HtmlPage& page, const MeshRun& run, const std::vector<HistoryPoint>& history) {
  if (run.result.estimator == nullptr) return;
  Plot plot;
  plot.title = "The estimate and its standard error against the number of trials.";
  plot.x_label = "trials";
  plot.y_label = "⟨Vₑₓ⟩";
  plot.log_x = true;
  PlotSeries estimate{"Monte Carlo, and its standard error", {}, true, true, true};
  for (const HistoryPoint& point : history)
    estimate.points.push_back({static_cast<double>(point.n_trials), point.value, point.std_error});
  plot.series.push_back(std::move(estimate));
  if (run.result.reference && run.result.reference->value > 0.0)
    plot.levels.push_back({reference_name(run), run.result.reference->value});
  page.begin_section("On the way to the result", false);
  page.figure(plot_svg(plot), "What the run would have said, had it ended after so many of its trials.",
              "The run was too short to say anything on its way.");
}

void add_orientations(HtmlPage& page, const MeshRun& run, const PairView& view) {
  Plot plot;
  plot.title = "The excluded volume at orientations that the law draws, from the smallest to the largest.";
  plot.x_label = "share of orientations, in percent";
  plot.y_label = "Vₑₓ of the orientation";
  PlotSeries values{"single orientations", {}, true, true, false};
  const std::size_t n = view.orientations.size();
  for (std::size_t k = 0; k < n; ++k) {
    const OrientationView& one = view.orientations[k];
    if (one.excluded_volume)
      values.points.push_back({100.0 * (static_cast<double>(k) + 0.5) / static_cast<double>(n), *one.excluded_volume,
                               one.error > 1e-11 * *one.excluded_volume ? one.error : 0.0});
  }
  if (n < 2 || values.points.size() < n) return;
  plot.series.push_back(std::move(values));
  if (run.result.reference) {
    plot.levels.push_back({"the average, by " + reference_name(run), run.result.reference->value});
  } else if (std::isfinite(run.result.value)) {
    plot.levels.push_back({"the average, by Monte Carlo", run.result.value});
  }
  page.begin_section("How much the orientation matters", false);
  page.figure(plot_svg(plot), plural(n, "orientation", "orientations") +
                                  ", those of the slider above: how the excluded volume is spread about its average.");
}

void add_costs(HtmlPage& page, const MeshRun& run, const nlohmann::ordered_json& document) {
  if (!document.contains("pilot") || !std::isfinite(run.result.std_error / run.result.value)) return;
  PageTable table;
  table.caption = "Told by a pilot of each before the run: about how many seconds to this run’s error of " +
                  short_number(100.0 * run.result.std_error / run.result.value, 2) +
                  " %, on as many threads. What uses the geometry of the formula is no check of it.";
  table.columns = {"estimator", "seconds to this error, about", "microseconds a trial", "with the formula’s geometry"};
  const auto number = [](const nlohmann::ordered_json& value, double factor) {
    return value.is_number() ? short_number(factor * value.get<double>(), 2) : std::string("unknown");
  };
  for (const auto& row : document.at("pilot")) {
    const auto name = row.at("estimator").get<std::string>();
    const Estimator* const estimator = find_estimator(name);
    const bool is_this = estimator == run.result.estimator;
    const std::string how = estimator != nullptr ? ": " + std::string(estimator->meaning) : std::string();
    table.rows.push_back(
        {name + (is_this ? " (this run)" : "") + how,
         is_this ? short_number(run.result.record.seconds, 2) : number(row.at("seconds_to_this_error"), 1.0),
         number(row.at("seconds_per_trial"), 1e6), row.at("runs_gjk").get<bool>() ? "no" : "yes"});
  }
  page.begin_section("What other ways would have cost", true);
  page.table(table);
}

void add_bodies(HtmlPage& page, const MeshRun& run) {
  PageTable table;
  table.caption = "V, S and M are what the formula is made from.";
  table.columns = {"quantity"};
  table.rows = {{"kind"},         {"corners"}, {"volume V"}, {"surface area S"}, {"integrated mean curvature M"},
                {"circumradius"}, {"inradius"}};
  const auto add = [&](const std::string& label, const LoadedBody& body) {
    const Measures& m = body.shape.measures;
    const std::size_t n = vertices_of(body.shape.body).size();
    table.columns.push_back(label + ": " + name_of(body));
    const std::vector<std::string> cells = {body.shape.kind,
                                            n > 0 ? std::to_string(n) : "curved",
                                            short_number(m.volume, 12),
                                            short_number(m.surface_area, 12),
                                            short_number(m.integrated_mean_curvature, 12),
                                            short_number(body.shape.body.circumradius(), 12),
                                            short_number(body.shape.body.inradius(), 12)};
    for (std::size_t k = 0; k < cells.size(); ++k) table.rows[k].push_back(cells[k]);
  };
  add("A", run.a);
  if (!are_copies(run.a, run.b)) add("B", run.b);
  page.begin_section("The bodies", true);
  page.table(table);
  for (const LoadedBody* const body : {&run.a, &run.b}) {
    if (!body->mesh || (body == &run.b && are_copies(run.a, run.b))) continue;
    for (const std::string& note : body->mesh->notes) page.paragraph(name_of(*body) + ": " + note);
  }
}

}  // namespace

std::string html_report(const MeshRun& run, const std::vector<HistoryPoint>& history,
                        const std::string& document_text) {
  const bool is_one_body = are_copies(run.a, run.b);
  const std::string name_a = name_of(run.a), name_b = is_one_body ? "" : name_of(run.b);
  const std::string title = "Excluded volume of " + name_a + (is_one_body ? " with itself" : " and " + name_b);
  HtmlPage page("vex: " + title, title, document_text);
  add_headline(page, run);
  const PairView view = pair_view(run.a.shape, name_a, run.b.shape, name_b, run.options.settings.law, run.options.seed);
  page.begin_section("Two bodies, and where the second one cannot be", true);
  page.pair(view);
  add_results(page, run);
  add_convergence(page, run, history);
  add_orientations(page, run, view);
  add_costs(page, run, nlohmann::ordered_json::parse(document_text));
  add_bodies(page, run);
  return page.text(run.command);
}

}  // namespace vex
