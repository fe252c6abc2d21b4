#include "tests/bench/log_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/log_axis.h"
#include "apps/common/svg.h"

namespace vex {
namespace {

constexpr int kWidth = 960, kHeight = 540;  // 16:9, as slides are
constexpr double kLeft = 78.0, kRight = 700.0, kTop = 84.0, kBottom = 476.0;
constexpr double kNameHeight = 17.0;  // of a line of a curve's name

// Names at the curves' ends, pushed apart where they would touch; the order stays.
std::vector<double> spread_out(std::vector<double> wanted, const std::vector<double>& heights) {
  std::vector<std::size_t> order(wanted.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return wanted[i] < wanted[j]; });
  for (std::size_t pass = 0; pass < 100; ++pass) {
    for (std::size_t k = 1; k < order.size(); ++k) {
      double &above = wanted[order[k - 1]], &below = wanted[order[k]];
      const double missing = above + 0.5 * (heights[order[k - 1]] + heights[order[k]]) + 4.0 - below;
      if (missing > 0.0) above -= 0.5 * missing, below += 0.5 * missing;
    }
  }
  return wanted;
}

std::vector<std::string> lines_of(const std::string& name) {
  std::vector<std::string> lines = {""};
  for (const char c : name) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

void draw_axes(Svg& svg, const LogPlot& plot, const LogAxis& x, const LogAxis& y) {
  draw_log_axes(svg, x, y);
  svg.label({0.5 * (x.begin + x.end), y.begin + 44.0}, plot.x_label, "font-size=\"15\" fill=\"#111\"");
  upright_label(svg, {24.0, 0.5 * (y.begin + y.end)}, plot.y_label, "font-size=\"15\" fill=\"#111\"");
}

}  // namespace

std::string svg_of(const LogPlot& plot) {
  double least_x = std::numeric_limits<double>::infinity(), most_x = 0.0, least_y = least_x, most_y = 0.0;
  for (const Curve& curve : plot.curves) {
    for (const auto& [x, y] : curve.points) {
      least_x = std::min(least_x, x), most_x = std::max(most_x, x);
      least_y = std::min(least_y, y), most_y = std::max(most_y, y);
    }
  }
  const double beside = 0.12, from_y = std::floor(std::log10(least_y));
  const LogAxis x{std::log10(least_x) - beside, std::log10(most_x) + beside, kLeft, kRight};
  const LogAxis y{from_y, std::max(std::ceil(std::log10(most_y)), from_y + 1.0), kBottom, kTop};

  Svg svg(kWidth, kHeight, plot.title);
  svg.label({kLeft, 32.0}, plot.title, anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  svg.label({kLeft, 58.0}, plot.subtitle, anchored("start", "font-size=\"13\" fill=\"#555\""));
  draw_axes(svg, plot, x, y);
  std::vector<double> name_places, name_heights;
  for (const Curve& curve : plot.curves) {
    std::vector<Pixel> pixels;
    for (const auto& [at_x, at_y] : curve.points) pixels.push_back({x.pixel(at_x), y.pixel(at_y)});
    name_places.push_back(pixels.back().y);
    name_heights.push_back(kNameHeight * static_cast<double>(lines_of(curve.name).size()));
    svg.path(svg_path(pixels, false), "fill=\"none\" stroke=\"" + curve.colour + "\" stroke-width=\"" +
                                          (curve.is_bold ? "3.5" : "2") + "\" stroke-linejoin=\"round\"" +
                                          (curve.is_dashed ? " stroke-dasharray=\"7 4\"" : ""));
    for (const Pixel& pixel : pixels) svg.dot(pixel, curve.is_bold ? 4.5 : 3.5, "fill=\"" + curve.colour + "\"");
  }
  name_places = spread_out(std::move(name_places), name_heights);
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const Curve& curve = plot.curves[k];
    const Pixel end{x.pixel(curve.points.back().first), y.pixel(curve.points.back().second)};
    const double name_x = kRight + 22.0;
    // From where the curve ends to its name.
    svg.line({end.x + 7.0, end.y}, {name_x - 6.0, name_places[k]},
             "stroke=\"" + curve.colour + "\" stroke-width=\"1\" stroke-opacity=\".45\" stroke-dasharray=\"2 3\"");
    double line_y = name_places[k] - 0.5 * name_heights[k] + 0.5 * kNameHeight;
    for (const std::string& line : lines_of(curve.name)) {
      svg.label({name_x, line_y}, line,
                anchored("start", "font-size=\"14\" fill=\"" + curve.colour + "\"" +
                                      (curve.is_bold ? " font-weight=\"bold\"" : "")));
      line_y += kNameHeight;
    }
  }
  return svg.text();
}

}  // namespace vex
