// The page of --report.
#include <cmath>

#include "apps/common/html/page.h"
#include "apps/common/html/plot.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_virial/report.h"

namespace vex {
namespace {

std::string name_of(const LoadedBody& body) { return body.source == "-" ? "standard input" : body.source; }

std::string shown(double value, double error) {
  return std::isfinite(error) ? with_error(value, error) : short_number(value, 4) + " (error unknown)";
}

/// B₃ / B₂², of an order from 3 to 8.
std::string in_units_of(int n, const std::string& unit) {
  static constexpr const char* kLow[] = {"₃", "₄", "₅", "₆", "₇", "₈"};
  static constexpr const char* kHigh[] = {"²", "³", "⁴", "⁵", "⁶", "⁷"};
  const auto k = static_cast<std::size_t>(n - 3);
  return std::string("B") + kLow[k] + " / " + unit + kHigh[k];
}

const VirialCoefficient* last_settled(const VirialRun& run) {
  const VirialCoefficient* last = nullptr;
  for (const VirialCoefficient& found : run.found.higher) {
    if (std::isfinite(found.reduced) && found.sign_is_settled()) last = &found;
  }
  return last;
}

void add_headline(HtmlPage& page, const VirialRun& run) {
  if (run.options.is_mixture()) {
    const MixedVirial& mixed = run.mixed[1];
    if (std::isfinite(mixed.value)) {
      page.headline(PageNumber{"B_" + mixed.name, "/mixture/1/value", shown(mixed.value, mixed.std_error),
                               "the third virial coefficient of two bodies A and one B"});
    } else {
      page.headline("No coefficient yet");
    }
  } else if (const VirialCoefficient* const last = last_settled(run)) {
    page.headline(PageNumber{
        in_units_of(last->n, "B₂"), "/coefficients/" + std::to_string(last - run.found.higher.data()) + "/reduced",
        shown(last->reduced, last->std_error),
        "the virial coefficient of order " + std::to_string(last->n) + " of hard bodies, in units of the second one"});
  } else {
    page.headline("No coefficient yet");
  }
  if (!run.complete)
    page.verdict(Tone::wait, "Incomplete: interrupted, or given up before the error that was asked for");
  for (const VirialCoefficient& found : run.found.higher) {
    if (std::isfinite(found.reduced) && found.sign_is_settled()) continue;
    page.verdict(Tone::wait, "The sign of B" + std::to_string(found.n) +
                                 " is not settled: it is within three standard errors of 0. Give more time");
  }
}

void add_numbers(HtmlPage& page, const VirialRun& run) {
  std::vector<PageNumber> rows;
  const auto add = [&rows](const std::string& name, const std::string& path, double value, double error,
                           const std::string& meaning) {
    if (std::isfinite(value)) rows.push_back({name, path, shown(value, error), meaning});
  };
  if (run.options.is_mixture()) {
    for (std::size_t k = 0; k < run.mixed.size(); ++k) {
      const MixedVirial& mixed = run.mixed[k];
      const std::string here = "/mixture/" + std::to_string(k);
      add("B_" + mixed.name, here + "/value", mixed.value, mixed.std_error,
          "In length⁶. The digits in parentheses are one standard error, in units of the last digits shown.");
      add("the same, reduced", here + "/reduced", mixed.reduced, mixed.reduced_std_error,
          "In units of the second coefficients of its pairs.");
    }
  } else {
    if (std::isfinite(run.found.b2)) {
      rows.push_back({"B₂", "/b2", b2_text(run.found, run.found.b2), "⟨V_ex⟩/2, exact: it is no result of the run."});
    }
    if (std::isfinite(run.found.b2_per_volume)) {
      rows.push_back({"B₂ / V", "/b2_per_volume", b2_text(run.found, run.found.b2_per_volume),
                      "The same in units of the body’s volume: 4 for spheres, more for all others."});
    }
    for (std::size_t k = 0; k < run.found.higher.size(); ++k) {
      const VirialCoefficient& found = run.found.higher[k];
      const std::string here = "/coefficients/" + std::to_string(k);
      add(in_units_of(found.n, "B₂"), here + "/reduced", found.reduced, found.std_error,
          k == 0 ? "The digits in parentheses are one standard error, in units of the last digits shown."
                 : short_count(static_cast<double>(found.samples)) + " clusters.");
      add(in_units_of(found.n, "V"), here + "/per_volume", found.per_volume, found.per_volume_std_error,
          "What the series in the volume fraction has.");
    }
  }
  rows.push_back({"seconds", "/seconds", short_number(run.seconds, 3),
                  "On " + plural(static_cast<std::uint64_t>(run.options.n_threads), "thread", "threads") + "."});
  page.begin_section("What came out", true);
  page.numbers("Lengths are in the unit of the bodies.", rows);
}

void add_compressibility(HtmlPage& page, const VirialRun& run) {
  if (run.options.is_mixture() || !std::isfinite(run.found.b2_per_volume) || !run.found.is_series()) return;
  constexpr int kPoints = 80;
  constexpr double kMostPhi = 0.45, kMostZ = 20.0;
  Plot plot;
  plot.title = "The compressibility factor of the virial series, and equations of state beside it.";
  plot.x_label = "volume fraction φ = n V";
  plot.y_label = "Z = p / (n k T)";
  const auto add = [&plot](const std::string& label, const auto& z) {
    PlotSeries curve{label, {}, true, false, false};
    for (int k = 0; k <= kPoints; ++k) {
      const double phi = kMostPhi * k / kPoints, value = z(phi);
      if (!(std::fabs(value) <= kMostZ)) break;
      curve.points.push_back({phi, value});
    }
    plot.series.push_back(std::move(curve));
  };
  add("series to B" + std::to_string(run.found.higher.size() + 2),
      [&run](double phi) { return run.found.compressibility_factor(phi); });
  for (const EquationOfState& other : equations_of_state(run)) {
    add(other.name, [&](double phi) { return other.z(run, phi); });
  }
  page.begin_section("The equation of state", false);
  page.figure(plot_svg(plot), "The series ends too early where φ is large; the others are fits that know B₂ alone.");
}

void add_sizes_of_terms(HtmlPage& page, const VirialRun& run) {
  if (run.options.is_mixture()) return;
  Plot plot;
  plot.title = "The virial coefficients, in units of powers of the second one.";
  plot.x_label = "order n";
  plot.y_label = "Bₙ / B₂ⁿ⁻¹";
  PlotSeries found{"one standard error to either side", {}, false, true, false};
  for (const VirialCoefficient& one : run.found.higher) {
    if (std::isfinite(one.reduced) && std::isfinite(one.std_error))
      found.points.push_back({static_cast<double>(one.n), one.reduced, one.std_error});
  }
  plot.series.push_back(std::move(found));
  plot.levels.push_back({"0", 0.0});
  page.begin_section("From order to order", false);
  page.figure(plot_svg(plot), "Of long rods all vanish but the second: then Onsager’s theory is exact.",
              "No coefficient has an error yet.");
}

void add_bodies(HtmlPage& page, const VirialRun& run) {
  PageTable table;
  table.caption = "Orientations " + run.options.settings.law.name() + ".";
  table.columns = {"body", "volume V", "surface area S", "integrated mean curvature M"};
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    const Measures& m = run.bodies[k].shape.measures;
    const std::string here = "/bodies/" + std::to_string(k) + "/";
    table.rows.push_back({name_of(run.bodies[k]), short_number(m.volume, 12), short_number(m.surface_area, 12),
                          short_number(m.integrated_mean_curvature, 12)});
    table.paths.push_back({"", here + "volume", here + "surface_area", here + "integrated_mean_curvature"});
  }
  page.begin_section("The bodies", true);
  page.table(table);
}

}  // namespace

std::string html_report(const VirialRun& run, const std::string& document_text) {
  std::string bodies;
  for (const LoadedBody& body : run.bodies) bodies += (bodies.empty() ? "" : " and ") + name_of(body);
  const std::string title = "Virial coefficients of hard bodies: " + bodies;
  HtmlPage page("vex: " + title, title, document_text);
  add_headline(page, run);
  const LoadedBody &a = run.bodies.front(), &b = run.bodies.back();
  page.begin_section("Two bodies, and where the second one cannot be", true);
  page.pair(pair_view(a.shape, name_of(a), b.shape, run.bodies.size() > 1 ? name_of(b) : "", run.options.settings.law,
                      run.options.seed));
  add_numbers(page, run);
  add_compressibility(page, run);
  add_sizes_of_terms(page, run);
  add_bodies(page, run);
  return page.text(run.command);
}

}  // namespace vex
