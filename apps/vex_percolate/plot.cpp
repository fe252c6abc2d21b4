// The picture of vex_percolate: wrapping probabilities against eta, which cross at the threshold.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/plot_axis.h"
#include "apps/common/svg.h"
#include "apps/vex_percolate/report.h"

namespace vex {
namespace {

constexpr double kLeft = 86.0, kRight = 690.0, kTop = 92.0, kBottom = 520.0, kWidth = 900.0, kHeight = 590.0;
void draw_curves(Svg& svg, const PercolateRun& run, const PlotAxis& x, const PlotAxis& y) {
  constexpr int kPoints = 160;
  constexpr std::array dashes = {"", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 3\""};
  for (std::size_t k = 0; k < run.sizes.size(); ++k) {
    const SizeRun& size = run.sizes[k];
    if (size.found.empty()) continue;
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      std::vector<Pixel> points;
      for (int j = 0; j <= kPoints; ++j) {
        const double eta = x.from + (x.to - x.from) * j / kPoints;
        const double lambda = eta / run.eta_unit() * size.volume();
        if (!(lambda > 0.0)) continue;
        const double r = wrapping_probability(size.found, static_cast<WrappingCriterion>(c), lambda);
        points.push_back({x.pixel(eta), y.pixel(r)});
      }
      svg.path(svg_path(points, false), "fill=\"none\" stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"" +
                                            std::string(c == 0 ? "2.4" : "1.4") + "\"" + dashes[c]);
    }
  }
}

// R at the threshold, of the curves' criteria; where it is another one along each axis the mean of these is all.
double probability_at_threshold(const PercolateRun& run, std::size_t c) {
  if (!run.crossing) return universal_probability(static_cast<WrappingCriterion>(c)).value;
  const std::array<double, kNCrossingCriteria>& r = run.crossing->probability;
  return (r[0] + r[1] + r[2]) / 3.0;
}

void draw_threshold(Svg& svg, const PercolateRun& run, const PlotAxis& x, const PlotAxis& y) {
  const double eta = run.threshold->density * run.eta_unit();
  svg.line({x.pixel(eta), kBottom}, {x.pixel(eta), kTop}, "stroke=\"#111\" stroke-width=\"1\"");
  for (std::size_t c = 0; c < (run.crossing ? 1 : kNWrappingCriteria); ++c) {
    const double r = probability_at_threshold(run, c);
    svg.dot({x.pixel(eta), y.pixel(r)}, 4.5, "fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\"");
  }
}

void draw_legend(Svg& svg, const PercolateRun& run) {
  double at = kTop + 8.0;
  const double left = kRight + 22.0;
  svg.label({left, at}, "cube's edge", anchored("start", text_style(14, kPlotGrey)));
  for (std::size_t k = 0; k < run.sizes.size(); ++k) {
    at += 24.0;
    svg.line({left, at}, {left + 30.0, at}, "stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"2.4\"");
    svg.label({left + 38.0, at}, short_number(run.sizes[k].edge, 5), anchored("start", text_style(14, kPlotInk)));
  }
  at += 40.0;
  svg.label({left, at}, "wraps along", anchored("start", text_style(14, kPlotGrey)));
  const std::array<std::pair<const char*, const char*>, kNWrappingCriteria> kinds = {
      {{"an axis (mean)", ""}, {"any axis", " stroke-dasharray=\"7 4\""}, {"all three", " stroke-dasharray=\"2 3\""}}};
  for (const auto& [name, dash] : kinds) {
    at += 24.0;
    svg.line({left, at}, {left + 30.0, at}, "stroke=\"#333\" stroke-width=\"1.6\"" + std::string(dash));
    svg.label({left + 38.0, at}, name, anchored("start", text_style(14, kPlotInk)));
  }
  at += 30.0;
  svg.dot({left + 15.0, at}, 4.5, "fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\"");
  svg.label({left + 38.0, at}, "threshold, and", anchored("start", text_style(14, kPlotInk)));
  svg.label({left + 38.0, at + 18.0}, run.crossing ? "fitted values" : "universal values",
            anchored("start", text_style(14, kPlotInk)));
}

std::string title_of(const PercolateRun& run) {
  std::string title;
  for (const LoadedBody& body : run.bodies) title += (title.empty() ? "" : ", ") + body.source;
  return in_xml(title.size() > 60 ? std::to_string(run.bodies.size()) + " kinds of bodies" : title);
}

}  // namespace

std::pair<double, double> plotted_range(const PercolateRun& run) {
  const SizeRun& smallest = run.sizes.front();
  const double middle = run.threshold->density * smallest.volume();
  const auto reaches = [&](double lambda, double level) {
    return wrapping_probability(smallest.found, WrappingCriterion::x, lambda) > level;
  };
  double from = middle, to = middle;
  while (from > 0.2 * middle && reaches(from, 0.05)) from *= 0.99;
  while (to < 5.0 * middle && !reaches(to, 0.9)) to *= 1.01;
  const double unit = run.eta_unit() / smallest.volume();
  return {from * unit, to * unit};
}

std::string picture_of(const PercolateRun& run) {
  Svg svg(static_cast<int>(kWidth), static_cast<int>(kHeight), "Wrapping probability");
  svg.label({24.0, 28.0}, "Percolation of " + title_of(run),
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  const std::optional<CriticalValues> values = critical_values(run);
  if (!values) {
    svg.label({24.0, 56.0}, "too few realisations", anchored("start", text_style(15, kPlotGrey)));
    return svg.text();
  }
  std::string head = run.is_flat()
                         ? "n_c = " + with_error(values->number_density.value, values->number_density.std_error)
                         : "&#951;_c = " + with_error(values->eta->value, values->eta->std_error);
  if (values->b) head += ",  B_c = " + with_error(values->b->value, values->b->std_error);
  svg.label({24.0, 56.0}, head + "; orientations " + in_xml(run.options.law),
            anchored("start", text_style(15, kPlotGrey)));
  const auto [from, to] = plotted_range(run);
  const PlotAxis x{from, to, kLeft, kRight}, y{0.0, 1.0, kBottom, kTop};
  draw_plot_axes(svg, x, y);
  draw_curves(svg, run, x, y);
  draw_threshold(svg, run, x, y);
  draw_legend(svg, run);
  svg.label({0.5 * (kLeft + kRight), kBottom + 48.0},
            run.is_flat() ? "number density n" : "reduced density &#951; = n V", text_style(15, kPlotInk));
  upright_label(svg, {28.0, 0.5 * (kTop + kBottom)}, "wrapping probability R", text_style(15, kPlotInk));
  return svg.text();
}

}  // namespace vex
