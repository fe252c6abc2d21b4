// The picture of vex_bench: error over run time, a panel for each body, one legend for all.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "apps/vex_bench/report.h"

namespace vex {
namespace {

constexpr double kLegendWidth = 230.0, kMargin = 24.0, kTitle = 74.0, kBelow = 58.0, kBeside = 62.0, kHead = 24.0;

struct Style {
  std::string colour, dashes;
  double width = 2.0;
};

// A colour for each estimator, dashes for random points, grey for peers: told apart in black and white too.
Style style_of(const ErrorCurve& curve) {
  if (curve.backend != gjk_backend().name) {
    if (!curve.is_library) return {"#c07a9a", "2 2", 1.8};
    if (curve.backend == "fcl") return {"#6b7280", "9 3 2 3", 1.8};
    return {curve.backend == "ccd-gjk" ? "#9ca3af" : "#374151", curve.backend == "ccd-gjk" ? "2 3" : "6 3", 1.8};
  }
  const std::string dashes = curve.sequence == Sequence::random ? "5 3" : "";
  // By their place in the list, so that a new one has a colour.
  static constexpr std::array kColours = {"#b2182b", "#2a9d8f", "#1f6fb4", "#8e5ea2", "#d98c00", "#6a8f00", "#a0522d"};
  const auto place = static_cast<std::size_t>(std::ranges::find(estimators(), curve.estimator) - estimators().begin());
  const bool is_main_one = place == 0 && curve.sequence == curve.estimator->usual_sequence;
  return {kColours[place % kColours.size()], dashes, is_main_one ? 3.2 : 2.0};
}

std::string stroke(const Style& style) {
  return "fill=\"none\" stroke=\"" + style.colour + "\" stroke-width=\"" + short_number(style.width, 3) +
         "\" stroke-linejoin=\"round\"" + (style.dashes.empty() ? "" : " stroke-dasharray=\"" + style.dashes + "\"");
}

// Nothing outside the axes: an error above 1 is none, and below the last that anybody asks for is rounding.
bool is_drawn(const Rung& rung) {
  constexpr double kLeast = 1e-8;
  return rung.relative_error >= kLeast && rung.relative_error <= 1.0 && rung.seconds > 0.0;
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

// A guide to the eye.
struct Slope {
  double slope;
  const char* name;
  Style style;
};
const std::array<Slope, 2> kSlopes = {Slope{-0.5, "slope &#8722;1/2", {"#111", "1 4", 1.0}},
                                      Slope{-1.0, "slope &#8722;1", {"#111", "1 9", 1.0}}};

// What a reader asks first: the paper's way with each library, and how much faster it gets. Five curves at most.
bool is_main(const ErrorCurve& curve) {
  if (curve.backend != gjk_backend().name) return curve.is_library && curve.backend != "ccd-gjk";
  return curve.estimator->runs_gjk && curve.sequence == curve.estimator->pilot_sequence &&
         curve.estimator->name != "stratified";
}

bool is_in(const ErrorCurve& curve, Curves which) { return is_main(curve) == (which == Curves::main); }

// A line of this slope through a point of the panel, cut off at its edges.
void draw_slope(Svg& svg, const LogAxis& x, const LogAxis& y, const Slope& guide, double at_x, double at_y) {
  const double slope = guide.slope;
  double from = x.from, to = x.to;
  const auto height = [&](double place) { return at_y + slope * (place - at_x); };
  if (height(from) > y.to) from = at_x + (y.to - at_y) / slope;
  if (height(to) < y.from) to = at_x + (y.from - at_y) / slope;
  if (!(from < to)) return;
  const auto pixel = [&](double place) {
    return Pixel{x.pixel(std::pow(10.0, place)), y.pixel(std::pow(10.0, height(place)))};
  };
  svg.line(pixel(from), pixel(to), stroke(guide.style));
}

void draw_panel(Svg& svg, const BodyCurves& body, Curves which, const LogAxis& x, const LogAxis& y) {
  draw_log_axes(svg, x, y, 12);
  svg.label({0.5 * (x.begin + x.end), y.end - 12.0}, in_xml(std::filesystem::path(body.body.name).filename().string()),
            "font-size=\"15\" font-weight=\"bold\" fill=\"#111\"");
  const double at_y = y.from + 0.45 * (y.to - y.from);
  for (const Slope& slope : kSlopes) draw_slope(svg, x, y, slope, x.from, at_y);
  for (const ErrorCurve& curve : body.curves) {
    if (!is_in(curve, which)) continue;
    const Style style = style_of(curve);
    std::vector<Pixel> pixels;
    for (const Rung& rung : curve.rungs) {
      if (is_drawn(rung)) pixels.push_back({x.pixel(rung.seconds), y.pixel(rung.relative_error)});
    }
    if (pixels.size() > 1) svg.path(svg_path(pixels, false), stroke(style));
    for (const Rung& rung : curve.rungs) {
      if (!is_drawn(rung)) continue;
      svg.dot({x.pixel(rung.seconds), y.pixel(rung.relative_error)}, 2.6, "fill=\"" + style.colour + "\"");
      const double off = std::log10(rung.true_relative_error);
      if (off > y.from && off < y.to) {  // a circle may lie below
        svg.dot({x.pixel(rung.seconds), y.pixel(rung.true_relative_error)}, 2.6,
                "fill=\"#fff\" stroke=\"" + style.colour + "\" stroke-width=\"1\"");
      }
    }
  }
}

}  // namespace

std::string picture_of(const BenchRun& run, Curves which) {
  const std::size_t n = std::max<std::size_t>(1, run.bodies.size());
  const std::size_t n_across = n == 1 ? 1 : n <= 4 ? 2 : 3, n_down = (n + n_across - 1) / n_across;
  const double panel_width = n == 1 ? 660.0 : n_across == 2 ? 420.0 : 330.0, panel_height = n == 1 ? 470.0 : 300.0;
  const double width = kMargin + static_cast<double>(n_across) * (panel_width + kBeside) + kLegendWidth;
  const double height = kTitle + static_cast<double>(n_down) * (panel_height + kHead + kBelow);

  Range seconds, errors;
  std::vector<ErrorCurve> legend;
  for (const BodyCurves& body : run.bodies) {
    for (const ErrorCurve& curve : body.curves) {
      if (!is_in(curve, which)) continue;
      for (const Rung& rung : curve.rungs) {
        if (!is_drawn(rung)) continue;
        seconds.add(rung.seconds);
        errors.add(rung.relative_error);
      }
      if (std::ranges::none_of(legend, [&](const ErrorCurve& one) { return one.name() == curve.name(); })) {
        legend.push_back(curve);
      }
    }
  }
  Svg svg(static_cast<int>(width), static_cast<int>(height), "Run time against error");
  svg.label({kMargin, 26.0}, "Excluded volume of two convex bodies: error against run time",
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  svg.label({kMargin, 50.0},
            processor() + ", " + std::to_string(run.options.n_threads) +
                (run.options.n_threads == 1 ? " thread" : " threads") +
                "; each body with itself, random orientations. Dots: standard error as estimated; circles: against the "
                "formula.",
            anchored("start", "font-size=\"13\" fill=\"#555\""));
  if (legend.empty()) return svg.text();

  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    const double left = kMargin + kBeside - 8.0 + static_cast<double>(k % n_across) * (panel_width + kBeside);
    const double top = kTitle + kHead + static_cast<double>(k / n_across) * (panel_height + kHead + kBelow);
    const LogAxis x{std::log10(seconds.least) - 0.1, std::log10(seconds.most) + 0.1, left, left + panel_width - 16.0};
    const LogAxis y{std::floor(std::log10(errors.least)), std::min(0.0, std::ceil(std::log10(errors.most))),
                    top + panel_height, top};
    draw_panel(svg, run.bodies[k], which, x, y);
    svg.label({0.5 * (x.begin + x.end), y.begin + 36.0}, "run time / s", "font-size=\"13\" fill=\"#111\"");
    if (k % n_across == 0) {
      upright_label(svg, {left - 48.0, 0.5 * (y.begin + y.end)}, "relative standard error",
                    "font-size=\"13\" fill=\"#111\"");
    }
  }
  double at = kTitle + kHead + 10.0;
  const double legend_left = width - kLegendWidth + 8.0;
  for (const ErrorCurve& curve : legend) {
    const Style style = style_of(curve);
    svg.line({legend_left, at}, {legend_left + 30.0, at}, stroke(style));
    svg.label({legend_left + 38.0, at}, curve.name(), anchored("start", "font-size=\"13\" fill=\"#111\""));
    at += 22.0;
  }
  for (const Slope& slope : kSlopes) {
    svg.line({legend_left, at}, {legend_left + 30.0, at}, stroke(slope.style));
    svg.label({legend_left + 38.0, at}, slope.name, anchored("start", "font-size=\"13\" fill=\"#111\""));
    at += 22.0;
  }
  return svg.text();
}

}  // namespace vex
