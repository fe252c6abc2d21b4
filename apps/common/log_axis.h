// Logarithmic axes of a picture.
#pragma once

#include <string>
#include <vector>

#include "apps/common/svg.h"

namespace vex {

struct LogAxis {
  double from, to;    // logarithms to base 10
  double begin, end;  // pixels

  double pixel(double value) const;
  /// Powers of ten within the axis, or their multiples between.
  std::vector<double> powers() const;
  std::vector<double> multiples() const;
};

/// A power of ten as it is printed: 1, 10, 100, 1000, or with an exponent.
std::string power_of_ten(double value);

/// A label's attributes with where its text stands: start, middle, end.
std::string anchored(const char* anchor, const std::string& attributes);

/// Grid, numbers and lines of the axes; y.begin is the lower end.
void draw_log_axes(Svg& svg, const LogAxis& x, const LogAxis& y, int font_size = 14);

/// `text` upright, beside the axis.
void upright_label(Svg& svg, const Pixel& middle, const std::string& text, const std::string& attributes);

}  // namespace vex
