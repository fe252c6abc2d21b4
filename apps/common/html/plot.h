// A plot in a page: points with errors, lines and bands over linear or logarithmic axes. Colours come from the page's
// style sheet, by class: line-0, line-1, ... and reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vex {

struct PlotPoint {
  double x, y;
  double error = 0.0;  // standard error
};

struct PlotSeries {
  std::string label;  // in the key; none where it is empty
  std::vector<PlotPoint> points;
  bool has_line = true, has_dots = true;
  bool has_band = false;  // one standard error to either side as an area, instead of bars
};

/// A level across the whole plot, such as the formula's.
struct PlotLevel {
  std::string label;
  double y;
};

struct Plot {
  std::string title;  // what is seen, for those who do not see it
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels;
};

/// An <svg> element; text of any origin is escaped. What is not finite, or not positive on a logarithmic axis, is left
/// out; errors are cut at the plot's edge. Empty where no point is left.
std::string plot_svg(const Plot& plot);

}  // namespace vex
