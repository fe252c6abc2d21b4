// Axes of a plot, and how its lines and letters look.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/common/svg.h"

namespace vex {

struct PlotAxis {
  double from, to;    // values
  double begin, end;  // pixels
  bool is_logarithmic = false;

  double pixel(double value) const;
  /// Some six round numbers within the axis, or powers of ten and, where these are few, their multiples.
  std::vector<double> ticks() const;
};

/// An axis that these values lie on, with a margin at each end; logarithmic where all are positive and the largest is
/// `decades_from` powers of ten above the smallest, or more.
PlotAxis axis_of(const std::vector<double>& values, double begin, double end, double decades_from);

/// Grid, numbers and lines; y.begin is the lower end.
void draw_plot_axes(Svg& svg, const PlotAxis& x, const PlotAxis& y);
/// The same of one axis: for plots whose other one is of another kind.
void draw_x_axis(Svg& svg, const PlotAxis& x, double bottom, double top);
void draw_y_axis(Svg& svg, const PlotAxis& y, double left, double right);

inline constexpr const char* kPlotInk = "#1f2933";
inline constexpr const char* kPlotGrey = "#5b6773";
std::string text_style(int size, const char* colour);
/// Of the k-th curve; seven unlike ones.
std::string colour_of_curve(std::size_t k);

}  // namespace vex
