// The picture of vex_depletion: the overlap volume, or the potential, against the distance, a curve for each angle.
#include <cmath>
#include <map>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/plot_axis.h"
#include "apps/vex_depletion/depletion_run.h"

namespace vex {

std::string picture_of(const DepletionRun& run) {
  constexpr double kLeft = 100.0, kRight = 660.0, kTop = 76.0, kBottom = 500.0;
  constexpr std::size_t kMostInLegend = 18;
  Svg svg(860, 570, "Depletion");
  const bool has_potential = run.options.fraction.has_value();
  const std::string names = are_copies(run.a, run.b) ? run.a.source : run.a.source + " and " + run.b.source;
  svg.label({24.0, 30.0}, "Depletion of " + in_xml(names),
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  struct Place {
    double x, y, error;
  };
  std::vector<std::pair<std::string, std::vector<Place>>> curves;
  std::map<std::string, std::size_t> places;
  std::vector<double> xs, ys = {0.0};
  for (const DepletionCase& one : run.cases) {
    const double y = has_potential ? run.potential(one) : one.overlap_volume;
    const double error = has_potential ? run.potential_error(one) : one.std_error;
    if (!std::isfinite(y)) continue;
    const auto [place, is_new] = places.emplace(one.angle, curves.size());
    if (is_new) curves.emplace_back(one.angle, std::vector<Place>());
    const double x = parse_number(one.distance, "--distance");
    curves[place->second].second.push_back({x, y, std::isfinite(error) ? error : 0.0});
    xs.push_back(x);
    ys.push_back(y);
  }
  if (xs.empty()) {
    svg.label({24.0, 58.0}, "no case has a number to draw", anchored("start", text_style(15, kPlotGrey)));
    return svg.text();
  }
  const PlotAxis x = axis_of(xs, kLeft, kRight, 400.0), y = axis_of(ys, kBottom, kTop, 400.0);
  draw_plot_axes(svg, x, y);
  double at = kTop + 8.0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const std::string stroke = "fill=\"none\" stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"1.6\"";
    std::vector<Pixel> line;
    for (const Place& p : curves[k].second) {
      line.push_back({x.pixel(p.x), y.pixel(p.y)});
      svg.line({x.pixel(p.x), y.pixel(p.y - p.error)}, {x.pixel(p.x), y.pixel(p.y + p.error)}, stroke);
      svg.dot(line.back(), 3.0, "fill=\"#fff\" " + stroke.substr(stroke.find("stroke")));
    }
    svg.path(svg_path(line, false), stroke);
    if (k >= kMostInLegend) continue;
    svg.dot({kRight + 28.0, at}, 3.4, "fill=\"" + colour_of_curve(k) + "\"");
    svg.label({kRight + 42.0, at}, curves[k].first.empty() ? "mean over orientations" : curves[k].first + " degrees",
              anchored("start", text_style(13, kPlotInk)));
    at += 20.0;
  }
  svg.label({0.5 * (kLeft + kRight), kBottom + 46.0}, "distance of the origins", text_style(15, kPlotInk));
  upright_label(svg, {26.0, 0.5 * (kTop + kBottom)}, has_potential ? "potential / kT" : "overlap volume of the shells",
                text_style(15, kPlotInk));
  return svg.text();
}

}  // namespace vex
