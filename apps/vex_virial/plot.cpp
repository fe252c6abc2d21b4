// The picture of vex_virial: the compressibility factor of the series, and equations of state beside it.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/svg.h"
#include "apps/vex_virial/report.h"

namespace vex {
namespace {

constexpr double kLeft = 80.0, kRight = 640.0, kTop = 84.0, kBottom = 500.0, kWidth = 860.0, kHeight = 570.0;
constexpr double kMostPhi = 0.5, kLargestZ = 20.0;
constexpr const char* kInk = "#1f2933";
constexpr const char* kGrey = "#5b6773";

double x_of(double phi) { return kLeft + (kRight - kLeft) * phi / kMostPhi; }
double y_of(double z) { return kBottom - (kBottom - kTop) * z / kLargestZ; }

std::string text_style(int size, const char* colour) {
  return "font-size=\"" + std::to_string(size) + "\" fill=\"" + std::string(colour) + "\"";
}

template <class Z>
void draw_curve(Svg& svg, const Z& z, const std::string& stroke) {
  constexpr int kPoints = 200;
  std::vector<Pixel> points;
  for (int k = 0; k <= kPoints; ++k) {
    const double phi = kMostPhi * k / kPoints, value = z(phi);
    if (!(value >= 0.0 && value <= kLargestZ)) break;
    points.push_back({x_of(phi), y_of(value)});
  }
  svg.path(svg_path(points, false), "fill=\"none\" " + stroke);
}

void draw_axes(Svg& svg) {
  for (int k = 0; k <= 5; ++k) {
    const double phi = 0.1 * k;
    svg.line({x_of(phi), kBottom}, {x_of(phi), kTop}, "stroke=\"#e3e8ee\" stroke-width=\"1\"");
    svg.label({x_of(phi), kBottom + 20.0}, short_number(phi, 2), text_style(14, kInk));
  }
  for (int k = 0; k <= 4; ++k) {
    const double z = 5.0 * k;
    svg.line({kLeft, y_of(z)}, {kRight, y_of(z)}, "stroke=\"#e3e8ee\" stroke-width=\"1\"");
    svg.label({kLeft - 10.0, y_of(z)}, short_number(z, 2), anchored("end", text_style(14, kInk)));
  }
  svg.line({kLeft, kBottom}, {kRight, kBottom}, "stroke=\"#333\" stroke-width=\"1.5\"");
  svg.line({kLeft, kBottom}, {kLeft, kTop}, "stroke=\"#333\" stroke-width=\"1.5\"");
  svg.label({0.5 * (kLeft + kRight), kBottom + 48.0}, "volume fraction &#966; = n V", text_style(15, kInk));
  upright_label(svg, {28.0, 0.5 * (kTop + kBottom)}, "compressibility factor Z = p / (n k T)", text_style(15, kInk));
}

}  // namespace

std::string picture_of(const VirialRun& run) {
  Svg svg(static_cast<int>(kWidth), static_cast<int>(kHeight), "Compressibility factor");
  svg.label({24.0, 28.0}, "Virial series of " + in_xml(run.bodies[0].source),
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  if (std::isnan(run.found.b2_per_volume)) {
    svg.label({24.0, 56.0}, "no volume fraction: the body is flat, or its B2 not known",
              anchored("start", text_style(15, kGrey)));
    return svg.text();
  }
  std::string head = "B2 / V = " + short_number(run.found.b2_per_volume, 6);
  for (const VirialCoefficient& found : run.found.higher) {
    if (found.n <= 5 && std::isfinite(found.std_error)) {
      head += ",  B" + std::to_string(found.n) + " " + with_error(found.reduced, found.std_error);
    }
  }
  svg.label({24.0, 56.0}, head, anchored("start", text_style(15, kGrey)));
  draw_axes(svg);
  constexpr std::array kDashes = {" stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 3\"",
                                  " stroke-dasharray=\"9 3 2 3\""};
  const std::vector<EquationOfState> others = equations_of_state(run);
  const double left = kRight + 20.0;
  double at = kTop + 10.0;
  const auto entry = [&](const std::string& name, const std::string& stroke) {
    svg.line({left, at}, {left + 32.0, at}, stroke);
    svg.label({left + 40.0, at}, name, anchored("start", text_style(14, kInk)));
    at += 24.0;
  };
  // The series after each of its terms, the last one strongest.
  VirialCoefficients part = run.found;
  for (std::size_t n_terms = 0; n_terms <= run.found.higher.size(); ++n_terms) {
    part.higher.assign(run.found.higher.begin(), run.found.higher.begin() + static_cast<std::ptrdiff_t>(n_terms));
    const bool is_all = n_terms == run.found.higher.size();
    const std::string stroke =
        is_all ? "stroke=\"#1f6fb4\" stroke-width=\"2.6\"" : "stroke=\"#a9c8e4\" stroke-width=\"1.4\"";
    draw_curve(
        svg, [&part](double phi) { return part.compressibility_factor(phi); }, stroke);
    entry("series to B" + std::to_string(n_terms + 2), stroke);
  }
  for (std::size_t k = 0; k < others.size(); ++k) {
    const std::string stroke = "stroke=\"#b2182b\" stroke-width=\"1.6\"" + std::string(kDashes[k]);
    draw_curve(
        svg, [&](double phi) { return others[k].z(run, phi); }, stroke);
    entry(others[k].name, stroke);
  }
  return svg.text();
}

}  // namespace vex
