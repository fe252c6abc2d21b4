// A plot of curves over two logarithmic axes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vex {

struct Curve {
  std::string name;
  std::string colour;
  bool is_dashed = false;
  bool is_bold = false;
  std::vector<std::pair<double, double>> points;  // all above 0, in the order of x
};

struct LogPlot {
  std::string title, subtitle;
  std::string x_label, y_label;
  std::vector<Curve> curves;
};

/// The text of an SVG file. The upright axis reaches to the powers of ten about the points; each curve's name stands at
/// its end.
std::string svg_of(const LogPlot& plot);

}  // namespace vex
