#include "apps/common/log_axis.h"

#include <cmath>

namespace vex {
namespace {

std::vector<double> values_within(const LogAxis& axis, int first_digit, int last_digit) {
  std::vector<double> values;
  for (int decade = static_cast<int>(std::floor(axis.from)); decade <= static_cast<int>(std::floor(axis.to + 1e-9));
       ++decade) {
    for (int digit = first_digit; digit <= last_digit; ++digit) {
      const double value = digit * std::pow(10.0, decade), place = std::log10(value);
      if (place > axis.from - 1e-9 && place < axis.to + 1e-9) values.push_back(value);
    }
  }
  return values;
}

}  // namespace

double LogAxis::pixel(double value) const { return begin + (std::log10(value) - from) / (to - from) * (end - begin); }

std::vector<double> LogAxis::powers() const { return values_within(*this, 1, 1); }
std::vector<double> LogAxis::multiples() const { return values_within(*this, 2, 9); }

std::string power_of_ten(double value) {
  const int exponent = static_cast<int>(std::lround(std::log10(value)));
  if (exponent >= 0 && exponent <= 3) return std::to_string(std::lround(value));
  return "10<tspan dy=\"-.45em\" font-size=\"75%\">" + std::to_string(exponent) + "</tspan>";
}

std::string anchored(const char* anchor, const std::string& attributes) {
  return "style=\"text-anchor:" + std::string(anchor) + "\" " + attributes;
}

void draw_log_axes(Svg& svg, const LogAxis& x, const LogAxis& y, int font_size) {
  const std::string text = "font-size=\"" + std::to_string(font_size) + "\" fill=\"#333\"";
  for (const bool is_major : {false, true}) {
    const std::string style =
        is_major ? "stroke=\"#cfd6df\" stroke-width=\"1\"" : "stroke=\"#eef1f5\" stroke-width=\"1\"";
    for (const double value : is_major ? x.powers() : x.multiples()) {
      svg.line({x.pixel(value), y.begin}, {x.pixel(value), y.end}, style);
      if (is_major) svg.label({x.pixel(value), y.begin + 1.3 * font_size}, power_of_ten(value), text);
    }
    for (const double value : is_major ? y.powers() : y.multiples()) {
      svg.line({x.begin, y.pixel(value)}, {x.end, y.pixel(value)}, style);
      if (is_major) svg.label({x.begin - 0.6 * font_size, y.pixel(value)}, power_of_ten(value), anchored("end", text));
    }
  }
  svg.path("M" + svg_number(x.begin) + "," + svg_number(y.end) + "V" + svg_number(y.begin) + "H" + svg_number(x.end),
           "fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"");
}

void upright_label(Svg& svg, const Pixel& middle, const std::string& text, const std::string& attributes) {
  svg.label(middle, text,
            attributes + " transform=\"rotate(-90 " + svg_number(middle.x) + " " + svg_number(middle.y) + ")\"");
}

}  // namespace vex
