// The picture of vex_nematic: how the nematic fluid's axes are distributed, and the pressure of both fluids.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/plot_axis.h"
#include "apps/vex_nematic/nematic_run.h"

namespace vex {
namespace {

constexpr double kTop = 92.0, kBottom = 420.0;
constexpr int kWidth = 980, kHeight = 490;
constexpr const char *kIsotropic = "#1f6fb4", *kNematic = "#b2182b";

std::string curve_style(const char* colour, const char* width, const char* more = "") {
  return "fill=\"none\" stroke=\"" + std::string(colour) + "\" stroke-width=\"" + width + "\"" + more;
}

void draw_density(Svg& svg, const NematicPhase& nematic) {
  constexpr double kLeft = 84.0, kRight = 440.0;
  std::vector<Pixel> points;
  const double highest = *std::ranges::max_element(nematic.density);
  const PlotAxis x{0.0, 90.0, kLeft, kRight}, y{0.0, 1.06 * highest, kBottom, kTop};
  draw_plot_axes(svg, x, y);
  for (std::size_t i = 0; i < nematic.cosines.size(); ++i) {
    points.push_back({x.pixel(std::acos(nematic.cosines[i]) * 180.0 / std::numbers::pi), y.pixel(nematic.density[i])});
  }
  svg.line({kLeft, y.pixel(1.0)}, {kRight, y.pixel(1.0)}, curve_style(kIsotropic, "2"));
  svg.path(svg_path(points, false), curve_style(kNematic, "2.4"));
  svg.label({0.5 * (kLeft + kRight), kBottom + 46.0}, "angle from the director, degrees", text_style(15, kPlotInk));
  upright_label(svg, {26.0, 0.5 * (kTop + kBottom)}, "density 4&#960; f(&#952;)", text_style(15, kPlotInk));
  svg.label({kRight - 8.0, kTop + 14.0}, "nematic", anchored("end", text_style(14, kNematic)));
  svg.label({kRight - 8.0, kTop + 34.0}, "isotropic", anchored("end", text_style(14, kIsotropic)));
}

void draw_isotherm(Svg& svg, const NematicRun& run) {
  constexpr double kLeft = 560.0, kRight = 950.0;
  const Coexistence& found = *run.found.result.found;
  const double c_i = found.isotropic.reduced_density, c_n = found.nematic.reduced_density;
  double last = std::max(c_n + 1.5 * (c_n - c_i), 1.15 * c_n);
  if (run.found.fluid.theory == NematicTheory::parsons_lee) {
    last = std::min(last, 0.5 * (c_n + 1.0 / run.found.fluid.volume_by_b2));  // eta stays below 1
  }
  const auto pixel_of = [](const PlotAxis& x, const PlotAxis& y, const NematicPhase& phase) -> Pixel {
    return {x.pixel(phase.reduced_density), y.pixel(phase.pressure)};
  };
  const double first = std::max(0.0, c_i - 2.5 * (c_n - c_i));
  const PlotAxis x{first, last, kLeft, kRight};
  const double lowest = isotropic_phase(run.found.fluid, first).pressure;
  double highest = isotropic_phase(run.found.fluid, c_n).pressure;
  for (const NematicPhase& phase : found.branch) {
    if (phase.reduced_density <= last) highest = std::max(highest, phase.pressure);
  }
  const PlotAxis y{lowest, lowest + 1.05 * (highest - lowest), kBottom, kTop};
  draw_plot_axes(svg, x, y);
  std::vector<Pixel> stable, beyond, nematic = {pixel_of(x, y, found.nematic)};
  constexpr int kPoints = 80;
  for (int k = 0; k <= kPoints; ++k) {
    stable.push_back(pixel_of(x, y, isotropic_phase(run.found.fluid, first + (c_i - first) * k / kPoints)));
    beyond.push_back(pixel_of(x, y, isotropic_phase(run.found.fluid, c_i + (c_n - c_i) * k / kPoints)));
  }
  for (const NematicPhase& phase : found.branch) {
    if (phase.reduced_density > c_n && phase.reduced_density <= last) nematic.push_back(pixel_of(x, y, phase));
  }
  svg.path(svg_path(stable, false), curve_style(kIsotropic, "2.4"));
  svg.path(svg_path(beyond, false), curve_style(kIsotropic, "1.4", " stroke-dasharray=\"5 4\""));
  svg.path(svg_path(nematic, false), curve_style(kNematic, "2.4"));
  const Pixel from = pixel_of(x, y, found.isotropic), to = pixel_of(x, y, found.nematic);
  svg.line(from, to, curve_style(kPlotGrey, "1.4"));
  svg.dot(from, 4.0, "fill=\"#fff\" stroke=\"" + std::string(kIsotropic) + "\" stroke-width=\"1.8\"");
  svg.dot(to, 4.0, "fill=\"#fff\" stroke=\"" + std::string(kNematic) + "\" stroke-width=\"1.8\"");
  svg.label({0.5 * (kLeft + kRight), kBottom + 46.0}, "reduced density c = n &lt;V_ex&gt; / 2",
            text_style(15, kPlotInk));
  upright_label(svg, {kLeft - 62.0, 0.5 * (kTop + kBottom)}, "pressure P &lt;V_ex&gt; / 2kT", text_style(15, kPlotInk));
}

}  // namespace

std::string picture_of(const NematicRun& run) {
  Svg svg(kWidth, kHeight, "Isotropic and nematic fluid");
  svg.label({24.0, 30.0}, "Isotropic and nematic fluid of " + in_xml(run.body.source),
            anchored("start", "font-size=\"20\" font-weight=\"bold\" fill=\"#111\""));
  if (!run.found.result.found) {
    svg.label({24.0, 60.0}, in_xml("none: " + run.found.result.reason), anchored("start", text_style(15, kPlotGrey)));
    return svg.text();
  }
  const Coexistence& found = *run.found.result.found;
  svg.label({24.0, 60.0},
            "c = " + short_number(found.isotropic.reduced_density, 5) + " and " +
                short_number(found.nematic.reduced_density, 5) +
                ", S = " + short_number(found.nematic.order_parameter, 4) + ", theory " + name_of(run.options.theory),
            anchored("start", text_style(15, kPlotGrey)));
  draw_density(svg, found.nematic);
  draw_isotherm(svg, run);
  return svg.text();
}

}  // namespace vex
