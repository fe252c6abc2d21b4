// The picture of vex_scan: <V_ex> against a variable, or for each body, with error bars and the exact curve.
#include <algorithm>
#include <cmath>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/plot_axis.h"
#include "apps/common/text.h"
#include "apps/vex_scan/curves.h"

namespace vex {
namespace {

constexpr double kLeft = 100.0, kRight = 660.0, kTop = 76.0, kBottom = 500.0;
constexpr int kWidth = 900, kHeight = 570;
constexpr double kDecades = 1.7;           // from which on an axis is logarithmic
constexpr std::size_t kMostInLegend = 18;  // as many lines as fit

std::string stroke(std::size_t k, const char* width) {
  return "fill=\"none\" stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"" + width + "\"";
}

void draw_curve(Svg& svg, const std::vector<ScanPoint>& points, std::size_t k, const PlotAxis& x, const PlotAxis& y,
                bool is_joined) {
  std::vector<Pixel> exact;
  for (const ScanPoint& point : points) {
    if (std::isfinite(point.reference)) exact.push_back({x.pixel(point.x), y.pixel(point.reference)});
  }
  if (is_joined) svg.path(svg_path(exact, false), stroke(k, "1.6"));
  for (const ScanPoint& point : points) {
    const double at = x.pixel(point.x);
    if (!is_joined && std::isfinite(point.reference)) {
      svg.line({at - 9.0, y.pixel(point.reference)}, {at + 9.0, y.pixel(point.reference)}, stroke(k, "1.6"));
    }
    if (std::isfinite(point.std_error)) {
      const double low = std::max(point.y - point.std_error, y.from), high = std::min(point.y + point.std_error, y.to);
      svg.line({at, y.pixel(low)}, {at, y.pixel(high)}, stroke(k, "1.6"));
      for (const double end : {low, high})
        svg.line({at - 4.0, y.pixel(end)}, {at + 4.0, y.pixel(end)}, stroke(k, "1.2"));
    }
    svg.dot({at, y.pixel(point.y)}, 3.4, "fill=\"#fff\" stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"1.6\"");
  }
}

void draw_legend(Svg& svg, const Curves& curves, bool has_reference) {
  double at = kTop + 8.0;
  const double left = kRight + 22.0;
  const auto line = [&](const std::string& text, const char* colour) {
    svg.label({left + 20.0, at}, in_xml(text), anchored("start", text_style(13, colour)));
  };
  for (std::size_t k = 0; k < std::min(curves.size(), kMostInLegend); ++k, at += 20.0) {
    if (curves[k].first.empty()) continue;
    svg.dot({left + 6.0, at}, 3.4, "fill=\"#fff\" stroke=\"" + colour_of_curve(k) + "\" stroke-width=\"1.6\"");
    const std::string_view shown = first_bytes(curves[k].first, 28);
    line(std::string(shown) + (shown.size() < curves[k].first.size() ? "..." : ""), kPlotInk);
  }
  if (curves.size() > kMostInLegend) line("and " + std::to_string(curves.size() - kMostInLegend) + " more", kPlotGrey);
  at += 24.0;
  line("points: Monte Carlo, one", kPlotGrey);
  at += 17.0;
  line("standard error either way", kPlotGrey);
  if (!has_reference) return;
  at += 20.0;
  line("lines: formula or exact average", kPlotGrey);
}

/// Bodies along x, each with its name.
void draw_names(Svg& svg, const ScanRun& run, const PlotAxis& x) {
  svg.line({kLeft, kBottom}, {kRight, kBottom}, "stroke=\"#333\" stroke-width=\"1.5\"");
  constexpr std::size_t kMostNames = 24;
  if (run.rows.size() > kMostNames) return;
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const ScanRow& row = run.rows[k];
    const std::string name = row.a == row.b ? row.a : row.a + " " + row.b;
    const Pixel at{x.pixel(static_cast<double>(k)), kBottom + 12.0};
    svg.label(at, in_xml(first_bytes(name, 22)),
              anchored("end", text_style(11, kPlotInk)) + " transform=\"rotate(-30 " + svg_number(at.x) + " " +
                  svg_number(at.y) + ")\"");
  }
}

}  // namespace

std::string picture_of(const ScanRun& run) {
  Svg svg(kWidth, kHeight, "Excluded volume");
  std::string title = run.scan.pairs.front().first;
  if (run.scan.pairs.size() > 1) title = plural(run.scan.pairs.size(), "pair", "pairs") + " of bodies";
  svg.label({24.0, 30.0}, "Excluded volume of " + in_xml(first_bytes(title, 60)),
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  const std::size_t along_x = variable_along_x(run.scan);
  const Curves curves = curves_of(run, along_x);
  std::vector<double> xs, ys;
  bool has_reference = false;
  for (const auto& [name, points] : curves) {
    for (const ScanPoint& point : points) {
      xs.push_back(point.x);
      ys.push_back(point.y);
      if (!std::isfinite(point.reference)) continue;
      has_reference = true;
      ys.push_back(point.reference);
    }
  }
  if (xs.empty()) {
    svg.label({24.0, 58.0}, "no case was done", anchored("start", text_style(15, kPlotGrey)));
    return svg.text();
  }
  const bool has_x = along_x != kNoVariable;
  const PlotAxis x = axis_of(xs, kLeft, kRight, has_x ? kDecades : 400.0), y = axis_of(ys, kBottom, kTop, kDecades);
  draw_y_axis(svg, y, kLeft, kRight);
  if (has_x) {
    draw_x_axis(svg, x, kBottom, kTop);
    svg.label(
        {0.5 * (kLeft + kRight), kBottom + 46.0},
        in_xml(run.scan.variables[along_x].name) + (run.scan.variables[along_x].name == kAngle ? " (degrees)" : ""),
        text_style(15, kPlotInk));
  } else {
    draw_names(svg, run, x);
  }
  for (std::size_t k = 0; k < curves.size(); ++k) draw_curve(svg, curves[k].second, k, x, y, has_x);
  draw_legend(svg, curves, has_reference);
  upright_label(svg, {26.0, 0.5 * (kTop + kBottom)}, "excluded volume &lt;V_ex&gt;", text_style(15, kPlotInk));
  return svg.text();
}

}  // namespace vex
