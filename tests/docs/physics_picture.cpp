#include "tests/docs/physics_picture.h"

#include <algorithm>
#include <cmath>

#include "apps/common/html/pair_picture.h"
#include "apps/common/numbers.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {
namespace {

constexpr int kPhysicsWidth = 900, kPhysicsHeight = 392;
constexpr double kPlotLeft = 522.0, kPlotRightEnd = 776.0, kPlotLow = 326.0, kPlotHigh = 62.0;
constexpr double kLeast = 8.0, kMost = 20.0;  // of V_ex / V
constexpr std::string_view kTitleStyle = "font-size=\"16\" font-weight=\"bold\" fill=\"#17202b\"";
constexpr std::string_view kSoft = "font-size=\"13\" fill=\"#4d5966\"";

Pixel place(const RodValue& value) {
  return {kPlotLeft + (kPlotRightEnd - kPlotLeft) * value.degrees / 90.0,
          kPlotLow + (kPlotHigh - kPlotLow) * (value.value - kLeast) / (kMost - kLeast)};
}

std::string coloured(const std::string& colour, const char* more) { return more + (" fill=\"" + colour + "\""); }

void draw_bodies(Svg& svg) {
  const Body a = parse_shape("box:1.1,1.5,2.4"), b = parse_shape("capsule:1.5,0.42");
  const PairView view = pair_view(a, "A", b, "B", OrientationLaw::fixed(0.75, 0.55, 0.15, -0.2), 1);
  svg.label({222.0, 30.0}, "Where the second body cannot be", kTitleStyle);
  svg.begin_group({222.0, 196.0}, "");
  draw_pair(svg, view, view.orientations.front(), 400.0, 286.0);
  svg.end_group();
  svg.label({222.0, 358.0}, "box A, capsule B, and the surface that B's centre may not enter;", kSoft);
  svg.label({222.0, 376.0}, "the volume inside, over all orientations: &#10216;V_ex&#10217;", kSoft);
}

void draw_axes_of_angles(Svg& svg) {
  for (double value = kLeast; value <= kMost; value += 4.0) {
    const double y = place({0.0, value}).y;
    svg.line({kPlotLeft, y}, {kPlotRightEnd, y}, "stroke=\"#e1e6ec\"");
    svg.label_at_end({kPlotLeft - 8.0, y}, short_number(value), kSoft);
  }
  for (double degrees = 0.0; degrees <= 90.0; degrees += 15.0) {
    const double x = place({degrees, kLeast}).x;
    svg.line({x, kPlotLow}, {x, kPlotHigh}, "stroke=\"#e1e6ec\"");
    svg.label({x, kPlotLow + 16.0}, short_number(degrees) + "&#176;", kSoft);
  }
  svg.line({kPlotLeft, kPlotLow}, {kPlotRightEnd, kPlotLow}, "stroke=\"#4d5966\" stroke-width=\"1.3\"");
  svg.line({kPlotLeft, kPlotLow}, {kPlotLeft, kPlotHigh}, "stroke=\"#4d5966\" stroke-width=\"1.3\"");
  svg.label({0.5 * (kPlotLeft + kPlotRightEnd), kPlotLow + 34.0},
            "angle &#947; between two equal rods, 5 long and 1 thick", kSoft);
  svg.label({0.5 * (kPlotLeft + kPlotRightEnd), kPlotLow + 51.0},
            "lines: exact; points: Monte Carlo, errors within the dots", kSoft);
  const Pixel middle{470.0, 0.5 * (kPlotLow + kPlotHigh)};
  svg.label(
      middle, "V_ex(&#947;) / V",
      std::string(kSoft) + " transform=\"rotate(-90 " + svg_number(middle.x) + " " + svg_number(middle.y) + ")\"");
}

}  // namespace

std::vector<Rod> rods() {
  std::vector<Rod> all = {{"box:1,1,5", "square prism", "#a23b72", {}, {}},
                          {"cylinder:5,0.5", "cylinder", "#0072b2", {}, {}},
                          {"capsule:4,0.5", "spherocylinder", "#c8500a", {}, {}}};
  for (Rod& rod : all) {
    const Body body = parse_shape(rod.text);
    const double volume = body.measures.volume;
    ExactAverageSettings exact;
    exact.n_randomisations = 8;
    exact.largest_cost = 1e7;
    for (double degrees = 0.0; degrees <= 90.0; degrees += degrees < 10.0 ? 2.5 : 5.0) {
      const ExactAverage found = exact_average(body, body, OrientationLaw::angle(degrees), exact);
      rod.exact.push_back({degrees, found.excluded_volume / volume, found.error / volume});
    }
    ExcludedVolumeSettings run;
    run.estimator = "radial";
    run.trials = 1u << 14;
    run.exact_average = false;
    for (double degrees = 7.5; degrees < 90.0; degrees += 15.0) {
      run.law = OrientationLaw::angle(degrees);
      const ExcludedVolume found = excluded_volume(body, body, run);
      rod.monte_carlo.push_back({degrees, found.value / volume, found.std_error / volume});
    }
  }
  return all;
}

std::string physics_picture() {
  Svg svg(kPhysicsWidth, kPhysicsHeight,
          "Two bodies with the surface that the centre of one may not enter; and the "
          "excluded volume of three rods against the angle between them");
  draw_bodies(svg);
  svg.label({0.5 * (kPlotLeft + kPlotRightEnd), 30.0}, "Rods at an angle", kTitleStyle);
  draw_axes_of_angles(svg);
  double label_at = 0.0;  // no label on another
  for (const Rod& rod : rods()) {
    std::vector<Pixel> curve;
    for (const RodValue& value : rod.exact) curve.push_back(place(value));
    svg.path(svg_path(curve, false), "fill=\"none\" stroke-width=\"2.2\" stroke=\"" + rod.colour + "\"");
    for (const RodValue& value : rod.monte_carlo)
      svg.dot(place(value), 3.6, "fill=\"#fff\" stroke-width=\"1.8\" stroke=\"" + rod.colour + "\"");
    label_at = std::max(label_at + 17.0, curve.back().y);
    svg.label_at_start({kPlotRightEnd + 8.0, label_at}, rod.label, coloured(rod.colour, "font-size=\"14\""));
  }
  return svg.text();
}

}  // namespace vex
