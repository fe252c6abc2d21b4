#include "apps/common/html/plot.h"

#include <algorithm>
#include <cmath>

#include "apps/common/numbers.h"
#include "apps/common/svg.h"

namespace vex {
namespace {

constexpr int kPlotWidth = 420, kPlotHeight = 300;
constexpr double kPlotTop = 14.0, kPlotRight = 408.0, kPlotBottom = 246.0;
constexpr double kKeyLine = 18.0;

// From data to pixels.
class PlotAxis {
 public:
  PlotAxis(double from, double to, bool is_log, bool is_whole, double begin, double end)
      : is_log_(is_log), is_whole_(is_whole), from_(place(from)), to_(place(to)), begin_(begin), end_(end) {}

  double pixel(double value) const {
    const double t = (place(value) - from_) / (to_ - from_);
    return begin_ + std::clamp(t, -0.0, 1.0) * (end_ - begin_);
  }

  // About `n` round numbers; of a logarithmic axis powers of ten, with halves and fifths where there are few.
  std::vector<double> ticks(double n) const {
    std::vector<double> values;
    if (is_log_ && to_ - from_ > 0.7) {
      const double every = std::max(1.0, std::ceil((to_ - from_) / n));
      for (double k = std::ceil(from_); k <= to_; k += every) values.push_back(std::pow(10.0, k));
      if (values.size() < 3) {
        values.clear();
        for (double k = std::floor(from_); k <= to_; ++k) {
          for (const double m : {1.0, 2.0, 5.0}) {
            const double value = m * std::pow(10.0, k);
            if (place(value) >= from_ && place(value) <= to_) values.push_back(value);
          }
        }
      }
      return values;
    }
    const double low = is_log_ ? std::pow(10.0, from_) : from_, high = is_log_ ? std::pow(10.0, to_) : to_;
    const double rough = (high - low) / n, power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = power * (rough > 5.0 * power ? 10.0 : rough > 2.0 * power ? 5.0 : rough > power ? 2.0 : 1.0);
    if (is_whole_) step = std::max(step, 1.0);  // there is nothing between two orders, or two cases
    for (double k = std::ceil(low / step); k * step <= high; ++k) values.push_back(k * step);
    return values;
  }

 private:
  double place(double value) const { return is_log_ ? std::log10(value) : value; }

  bool is_log_, is_whole_;
  double from_, to_, begin_, end_;
};

struct PlotRange {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
};

// So that no line lies on the frame.
PlotRange widened(const PlotRange& range, bool is_log) {
  if (is_log) {
    const double factor = range.high > range.low ? std::pow(range.high / range.low, 0.04) : 2.0;
    return {range.low / factor, range.high * factor};
  }
  const double margin = range.high > range.low ? 0.06 * (range.high - range.low)
                        : range.high != 0.0    ? 0.1 * std::fabs(range.high)
                                               : 1.0;
  return {range.low - margin, range.high + margin};
}

bool fits(const Plot& plot, const PlotPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.error) && (!plot.log_x || p.x > 0.0) &&
         (!plot.log_y || p.y > 0.0);
}

bool is_whole(const Plot& plot) {
  return std::ranges::all_of(plot.series, [&plot](const PlotSeries& series) {
    return std::ranges::all_of(series.points,
                               [&plot](const PlotPoint& p) { return !fits(plot, p) || p.x == std::floor(p.x); });
  });
}

class PlotDrawing {
 public:
  PlotDrawing(const Plot& plot, const PlotRange& x, const PlotRange& y, double left)
      : plot_(plot),
        left_(left),
        x_(x.low, x.high, plot.log_x, is_whole(plot), left, kPlotRight),
        y_(y.low, y.high, plot.log_y, false, kPlotBottom, kPlotTop),
        range_y_(y),
        svg_(Svg::in_page(kPlotWidth, kPlotHeight + height_of_key(plot), in_xml(plot.title))) {}

  std::string text() {
    grid();
    for (const PlotLevel& level : plot_.levels) {
      if (std::isfinite(level.y) && (!plot_.log_y || level.y > 0.0)) {
        svg_.line({left_, y_.pixel(level.y)}, {kPlotRight, y_.pixel(level.y)}, "class=\"level\"");
      }
    }
    for (std::size_t k = 0; k < plot_.series.size(); ++k) series(plot_.series[k], name_of_class(k));
    key();
    return svg_.text();
  }

  static double left_of(const std::vector<std::string>& labels) {
    std::size_t longest = 1;
    for (const std::string& label : labels) longest = std::max(longest, label.size());
    return 34.0 + 7.4 * static_cast<double>(longest);
  }

 private:
  static std::string name_of_class(std::size_t k) { return "line-" + std::to_string(k % 6); }

  static int height_of_key(const Plot& plot) {
    const auto n =
        static_cast<int>(plot.levels.size()) +
        static_cast<int>(std::ranges::count_if(plot.series, [](const PlotSeries& s) { return !s.label.empty(); }));
    return n > 0 ? static_cast<int>(kKeyLine) * n : 0;
  }

  void grid() {
    for (const double value : x_.ticks(6.0)) {
      svg_.line({x_.pixel(value), kPlotTop}, {x_.pixel(value), kPlotBottom}, "class=\"grid\"");
      const bool is_count = plot_.log_x && value >= 1e5;
      svg_.label({x_.pixel(value), kPlotBottom + 16.0}, is_count ? short_count(value) : short_number(value, 6),
                 "class=\"tick\"");
    }
    for (const double value : y_.ticks(5.0)) {
      svg_.line({left_, y_.pixel(value)}, {kPlotRight, y_.pixel(value)}, "class=\"grid\"");
      svg_.label_at_end({left_ - 7.0, y_.pixel(value)}, short_number(value, 7), "class=\"tick\"");
    }
    svg_.path("M" + svg_number(left_) + "," + svg_number(kPlotTop) + "V" + svg_number(kPlotBottom) + "H" +
                  svg_number(kPlotRight),
              "class=\"axis\"");
    svg_.label({0.5 * (left_ + kPlotRight), kPlotBottom + 40.0}, in_xml(plot_.x_label), "class=\"name\"");
    const Pixel middle{12.0, 0.5 * (kPlotTop + kPlotBottom)};
    svg_.label(middle, in_xml(plot_.y_label),
               "class=\"name\" transform=\"rotate(-90 " + svg_number(middle.x) + " " + svg_number(middle.y) + ")\"");
  }

  // Of the errors what is within the plot.
  double within(double y) const { return y_.pixel(std::clamp(y, range_y_.low, range_y_.high)); }

  void series(const PlotSeries& one, const std::string& name) {
    std::vector<Pixel> line, band;
    for (const PlotPoint& p : one.points) {
      if (!fits(plot_, p)) continue;
      const Pixel at{x_.pixel(p.x), y_.pixel(p.y)};
      line.push_back(at);
      band.push_back({at.x, within(p.y + p.error)});
      if (!one.has_band && p.error > 0.0)
        svg_.line({at.x, within(p.y - p.error)}, {at.x, within(p.y + p.error)}, "class=\"bar " + name + "\"");
    }
    for (auto p = one.points.rbegin(); p != one.points.rend(); ++p) {
      if (fits(plot_, *p)) band.push_back({x_.pixel(p->x), within(p->y - p->error)});
    }
    if (one.has_band) svg_.path(svg_path(band, true), "class=\"band " + name + "\"");
    if (one.has_line) svg_.path(svg_path(line, false), "class=\"curve " + name + "\"");
    if (!one.has_dots) return;
    for (const Pixel& p : line) svg_.dot(p, 2.8, "class=\"dot " + name + "\"");
  }

  void key() {
    double y = kPlotBottom + 64.0;
    const auto line = [&](const std::string& label, const std::string& shape, bool is_dot) {
      if (is_dot) {
        svg_.dot({left_ + 12.0, y}, 3.2, "class=\"" + shape + "\"");
      } else {
        svg_.line({left_, y}, {left_ + 24.0, y}, "class=\"" + shape + "\"");
      }
      svg_.label_at_start({left_ + 32.0, y}, in_xml(label), "class=\"name\"");
      y += kKeyLine;
    };
    for (const PlotLevel& level : plot_.levels) line(level.label, "level", false);
    for (std::size_t k = 0; k < plot_.series.size(); ++k) {
      const PlotSeries& one = plot_.series[k];
      if (one.label.empty()) continue;
      line(one.label, (one.has_line ? "curve " : "dot ") + name_of_class(k), !one.has_line);
    }
  }

  const Plot& plot_;
  double left_;
  PlotAxis x_, y_;
  PlotRange range_y_;
  Svg svg_;
};

}  // namespace

std::string plot_svg(const Plot& plot) {
  PlotRange x, y;
  for (const PlotSeries& one : plot.series) {
    for (const PlotPoint& p : one.points) {
      if (!fits(plot, p)) continue;
      x.include(p.x);
      y.include(p.y);
      // A first error may be as large as the rest of the plot, and larger.
      const double most = plot.log_y ? 0.5 * p.y : 0.25 * std::fabs(p.y);
      y.include(p.y - std::min(p.error, most));
      y.include(p.y + std::min(p.error, most));
    }
  }
  if (!(x.low <= x.high)) return "";
  for (const PlotLevel& level : plot.levels) {
    if (std::isfinite(level.y) && (!plot.log_y || level.y > 0.0)) y.include(level.y);
  }
  x = widened(x, plot.log_x);
  y = widened(y, plot.log_y);
  std::vector<std::string> labels;
  for (const double value : PlotAxis(y.low, y.high, plot.log_y, false, 0.0, 1.0).ticks(5.0))
    labels.push_back(short_number(value, 7));
  return PlotDrawing(plot, x, y, PlotDrawing::left_of(labels)).text();
}

}  // namespace vex
