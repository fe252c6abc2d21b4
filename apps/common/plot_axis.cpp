#include "apps/common/plot_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"

namespace vex {
namespace {

constexpr const char* kGridStyle = "stroke=\"#e3e8ee\" stroke-width=\"1\"";
constexpr const char* kLineStyle = "stroke=\"#333\" stroke-width=\"1.5\"";

LogAxis logarithms_of(const PlotAxis& axis) {
  return {std::log10(axis.from), std::log10(axis.to), axis.begin, axis.end};
}

std::string tick_label(const PlotAxis& axis, double value) {
  const double power = std::log10(value);
  const bool is_power = axis.is_logarithmic && std::fabs(power - std::round(power)) < 1e-9;
  return is_power ? power_of_ten(value) : short_number(value, 6);
}

}  // namespace

double PlotAxis::pixel(double value) const {
  if (is_logarithmic) return logarithms_of(*this).pixel(value);
  return begin + (value - from) / (to - from) * (end - begin);
}

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> values;
  if (is_logarithmic) {
    const LogAxis axis = logarithms_of(*this);
    values = axis.powers();
    if (values.size() > 2) return values;
    for (const double value : axis.multiples()) {
      // Of the multiples two and five: more would touch each other.
      const double digit = std::round(value / std::pow(10.0, std::floor(std::log10(value) + 1e-9)));
      if (digit == 2.0 || digit == 5.0) values.push_back(value);
    }
    return values;
  }
  const double rough = (to - from) / 6.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough > 5.0 * power ? 10.0 : rough > 2.0 * power ? 5.0 : rough > power ? 2.0 : 1.0);
  for (double k = std::ceil(from / step); k * step <= to; ++k) values.push_back(k * step);
  return values;
}

PlotAxis axis_of(const std::vector<double>& values, double begin, double end, double decades_from) {
  if (values.empty()) return {0.0, 1.0, begin, end};
  const auto [least, most] = std::ranges::minmax(values);
  if (least > 0.0 && std::log10(most / least) >= decades_from) {
    const double margin = std::pow(most / least, 0.04);
    return {least / margin, most * margin, begin, end, true};
  }
  const double largest = std::max(std::fabs(least), std::fabs(most));
  const double width = most - least > 1e-9 * largest ? most - least : largest > 0.0 ? 0.1 * largest : 1.0;
  return {least - 0.05 * width, most + 0.05 * width, begin, end};
}

void draw_x_axis(Svg& svg, const PlotAxis& x, double bottom, double top) {
  for (const double value : x.ticks()) {
    svg.line({x.pixel(value), bottom}, {x.pixel(value), top}, kGridStyle);
    svg.label({x.pixel(value), bottom + 20.0}, tick_label(x, value), text_style(14, kPlotInk));
  }
  svg.line({x.begin, bottom}, {x.end, bottom}, kLineStyle);
}

void draw_y_axis(Svg& svg, const PlotAxis& y, double left, double right) {
  for (const double value : y.ticks()) {
    svg.line({left, y.pixel(value)}, {right, y.pixel(value)}, kGridStyle);
    svg.label({left - 10.0, y.pixel(value)}, tick_label(y, value), anchored("end", text_style(14, kPlotInk)));
  }
  svg.line({left, y.begin}, {left, y.end}, kLineStyle);
}

void draw_plot_axes(Svg& svg, const PlotAxis& x, const PlotAxis& y) {
  draw_x_axis(svg, x, y.begin, y.end);
  draw_y_axis(svg, y, x.begin, x.end);
}

std::string text_style(int size, const char* colour) {
  return "font-size=\"" + std::to_string(size) + "\" fill=\"" + std::string(colour) + "\"";
}

std::string colour_of_curve(std::size_t k) {
  static constexpr std::array kColours = {"#8e5ea2", "#1f6fb4", "#2a9d8f", "#d98c00", "#b2182b", "#6a8f00", "#a0522d"};
  return kColours[k % kColours.size()];
}

}  // namespace vex
