// The page of --report.
#include <cmath>

#include "apps/common/html/page.h"
#include "apps/common/html/plot.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_percolate/report.h"

namespace vex {
namespace {

std::string shown(const Estimated& one) { return with_error(one.value, one.std_error); }

std::string eta_name(const PercolateRun& run) { return run.is_flat() ? "number density n" : "reduced density η = n V"; }

void add_headline(HtmlPage& page, const PercolateRun& run, const std::optional<CriticalValues>& values) {
  const std::string meaning =
      "the density at which overlapping bodies, placed at random, first form a cluster without end";
  if (!values) {
    page.headline("No threshold yet");
    page.verdict(Tone::wait, "Not known: " + run.no_threshold_reason);
  } else if (values->eta) {
    page.headline(PageNumber{"η", "/eta_c/value", shown(*values->eta), "the critical reduced density n V: " + meaning});
  } else {
    page.headline(PageNumber{"n", "/number_density_c/value", shown(values->number_density),
                             "the critical number of bodies in a unit of volume: " + meaning});
  }
  if (!run.complete)
    page.verdict(Tone::wait, "Incomplete: the run was interrupted, and this is what was done until then");
  if (!run.stopped_because.empty()) page.verdict(Tone::wait, run.stopped_because);
  if (!run.threshold) return;
  if (!run.threshold->is_extrapolated) {
    page.verdict(Tone::wait, "One size: not extrapolated to infinite space");
  } else if (run.threshold->p_value < 1e-3) {
    page.verdict(Tone::bad, "The sizes do NOT fit the law of extrapolation: give larger ones");
  } else {
    page.verdict(Tone::good, "Extrapolated to infinite space from " + plural(run.sizes.size(), "size", "sizes") +
                                 ", which fit the law (p = " + short_number(run.threshold->p_value, 2) + ")");
  }
}

void add_numbers(HtmlPage& page, const PercolateRun& run, const std::optional<CriticalValues>& values) {
  std::vector<PageNumber> rows;
  if (values) {
    if (values->eta) {
      rows.push_back({"η, critical", "/eta_c/value", shown(*values->eta),
                      "Number density times the mean volume of a body; overlaps count twice. The digits in parentheses "
                      "are one standard error, in units of the last digits shown."});
    }
    if (values->phi) {
      rows.push_back(
          {"φ, critical", "/phi_c/value", shown(*values->phi), "The share of space that is covered: 1 − exp(−η)."});
    }
    rows.push_back(
        {"n, critical", "/number_density_c/value", shown(values->number_density), "Bodies in a unit of volume."});
    if (values->b) {
      rows.push_back({"B, critical", "/b_c/value", shown(*values->b),
                      "n ⟨V_ex⟩: how many others a body overlaps on average. It tends to 1 for very long rods."});
    }
  }
  if (run.excluded_volume.reason.empty() && run.excluded_volume.value > 0.0) {
    rows.push_back({"⟨V_ex⟩", "/excluded_volume",
                    run.excluded_volume.std_error > 1e-11 * run.excluded_volume.value
                        ? with_error(run.excluded_volume.value, run.excluded_volume.std_error)
                        : short_number(run.excluded_volume.value, 10),
                    "The mean excluded volume of two bodies as they are turned here."});
  }
  rows.push_back({"bodies placed", "/bodies_placed", short_count(static_cast<double>(run.counts().n_bodies)),
                  "In all realisations together."});
  rows.push_back({"seconds", "/seconds", short_number(run.seconds_before + run.seconds, 3),
                  "On " + plural(static_cast<std::uint64_t>(run.options.n_threads), "thread", "threads") + "."});
  page.begin_section("What came out", true);
  page.numbers("Lengths are in the unit of the bodies.", rows);
}

void add_curves(HtmlPage& page, const PercolateRun& run) {
  constexpr int kPoints = 120;
  Plot plot;
  plot.title =
      "The probability that a cluster wraps around the cube along an axis, against the density, for each size.";
  plot.x_label = eta_name(run);
  plot.y_label = "wrapping probability";
  if (run.threshold) {
    const auto [from, to] = plotted_range(run);
    for (const SizeRun& size : run.sizes) {
      if (size.found.empty()) continue;
      PlotSeries curve{"cube’s edge " + short_number(size.edge, 5), {}, true, false, false};
      for (int k = 0; k <= kPoints; ++k) {
        const double eta = from + (to - from) * k / kPoints, lambda = eta / run.eta_unit() * size.volume();
        if (lambda > 0.0) curve.points.push_back({eta, wrapping_probability(size.found, WrappingCriterion::x, lambda)});
      }
      plot.series.push_back(std::move(curve));
    }
    if (!run.crossing)
      plot.levels.push_back({"at the threshold, of every system", universal_probability(WrappingCriterion::x).value});
  }
  page.begin_section("Where clusters first wrap around", false);
  page.figure(plot_svg(plot), "The larger the cube, the steeper; the curves cross at the threshold.",
              "Too few realisations to draw anything.");
}

void add_extrapolation(HtmlPage& page, const PercolateRun& run) {
  if (!run.threshold) return;
  Plot plot;
  plot.title = "The threshold told by each size of the cube, and the one in infinite space.";
  plot.x_label = "size of the cube, in extents of the largest body";
  plot.y_label = run.is_flat() ? "n of the size" : "η of the size";
  plot.log_x = true;
  PlotSeries sizes{"by wraps along an axis", {}, true, true, false};
  const double unit = run.eta_unit();
  for (std::size_t k = 0; k < run.sizes.size(); ++k) {
    if (run.crossing) {
      const Crossing::OfSize& of_size = run.crossing->sizes[k];
      sizes.points.push_back({run.sizes[k].size, of_size.density[0] * unit, of_size.std_error[0] * unit});
    } else if (k < run.thresholds.size()) {
      const SizedThreshold& one = run.thresholds[k];
      sizes.points.push_back({run.sizes[k].size, one.density[0] * unit, std::sqrt(one.covariance[0][0]) * unit});
    }
  }
  plot.series.push_back(std::move(sizes));
  plot.levels.push_back(
      {run.threshold->is_extrapolated ? "extrapolated" : "the result", run.threshold->density * unit});
  page.begin_section("On the way to infinite space", false);
  page.figure(plot_svg(plot), "One standard error to either side.");
}

void add_sizes(HtmlPage& page, const PercolateRun& run) {
  PageTable table;
  table.caption = "Sizes in units of " + short_number(run.extent) + ", the largest body’s extent.";
  table.columns = {"size", "cube’s edge", "realisations"};
  for (const SizeRun& size : run.sizes) {
    table.rows.push_back({short_number(size.size), short_number(size.edge, 6), std::to_string(size.found.size())});
  }
  page.begin_section("The cubes", false);
  page.table(table);
}

void add_bodies(HtmlPage& page, const PercolateRun& run) {
  PageTable table;
  table.caption =
      "Orientations " + run.options.law +
      (run.options.shell > 0.0 ? "; connected where the gap is at most " + short_number(run.options.shell) + "." : ".");
  table.columns = {"body", "parts", "volume V", "surface area S"};
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    const Measures& m = run.bodies[k].shape.measures;
    table.rows.push_back({run.bodies[k].source == "-" ? "standard input" : run.bodies[k].source,
                          short_number(run.options.bodies[k].fraction, 6), short_number(m.volume, 10),
                          short_number(m.surface_area, 10)});
  }
  page.begin_section("The bodies", false);
  page.table(table);
}

}  // namespace

std::string html_report(const PercolateRun& run, const std::string& document_text) {
  std::string bodies;
  for (const LoadedBody& body : run.bodies)
    bodies += (bodies.empty() ? "" : ", ") + (body.source == "-" ? std::string("standard input") : body.source);
  const std::string title = "Percolation threshold of overlapping bodies: " + bodies;
  HtmlPage page("vex: " + title, title, document_text);
  const std::optional<CriticalValues> values = critical_values(run);
  add_headline(page, run, values);
  const std::string with_shell = run.options.shell > 0.0 ? " with its shell" : "";
  const std::size_t other = run.bodies.size() > 1 ? 1 : 0;
  page.begin_section("Two bodies, and where they are connected", true);
  PairView view = pair_view(run.connecting[0], run.bodies[0].source + with_shell, run.connecting[other],
                            other == 0 ? "" : run.bodies[other].source + with_shell, run.options.orientations.law,
                            run.options.seed);
  view.surface_name = "the surface within which B’s centre connects them";
  page.pair(view);
  add_numbers(page, run, values);
  add_curves(page, run);
  add_extrapolation(page, run);
  add_sizes(page, run);
  add_bodies(page, run);
  return page.text(run.command);
}

}  // namespace vex
