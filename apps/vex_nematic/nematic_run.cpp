#include "apps/vex_nematic/nematic_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

constexpr std::size_t kHighestDegree = 256;  // as many as the doubled grid has
constexpr double kNone = 1e-9;               // of a coefficient, relative to <V_ex>: what rounding makes of 0

/// How far the body reaches along an axis, both ways.
double width_along(const ConvexBody& body, const Vec3d& axis) {
  return dot(axis, body.support(axis)) + dot(-axis, body.support(-axis));
}

/// Which of x and y tells itself from the two others more clearly than z does; empty where z does.
std::string better_axis(const ConvexBody& body) {
  const std::array<Vec3d, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  std::array<double, 3> widths;
  for (std::size_t k = 0; k < 3; ++k) widths[k] = width_along(body, axes[k]);
  const auto apart = [&widths](std::size_t k) {
    const auto [thin, wide] = std::minmax(widths[(k + 1) % 3], widths[(k + 2) % 3]);
    return std::max(widths[k] / wide, thin / widths[k]);
  };
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    if (apart(k) > 1.05 * apart(2)) return k == 0 ? "x" : "y";
  }
  return "";
}

void note_the_body(NematicRun& run, double largest_odd) {
  if (largest_odd > kNone) {
    run.notes.emplace_back(
        "the body's two ends differ: V_ex(gamma) is the mean of gamma and 180 degrees - gamma, as for a fluid with as "
        "many axes up as down");
  }
  if (const std::string axis = better_axis(run.body.shape.body); !axis.empty()) {
    run.notes.push_back("the body is longest or thinnest along " + axis +
                        ", but its z axis is taken for the one that aligns: turn it");
  }
  const EvenSeries& of_angle = run.fluid.series;
  if (of_angle.size() > 2 && of_angle[2] < -kNone && of_angle[2] * 5.0 / 9.0 < of_angle[1]) {
    run.notes.emplace_back(
        "order of the fourth rank, as cubes have it, would come before the nematic one: this theory does not look for "
        "it");
  }
}

void note_the_result(NematicRun& run) {
  if (!run.result.found || !(run.volume() > 0.0)) return;
  const double packing = run.result.found->nematic.reduced_density * run.fluid.volume_by_b2;
  constexpr double kSpheres = 0.7405;  // pi / sqrt(18)
  if (packing >= 1.0) {
    run.notes.emplace_back("the nematic fluid's volume fraction is above 1: there is no such fluid of this body" +
                           std::string(run.fluid.theory == NematicTheory::onsager
                                           ? ", it is too short for Onsager's theory - try --theory parsons-lee"
                                           : ""));
  } else if (packing > kSpheres) {
    run.notes.emplace_back("the nematic fluid is denser than spheres can be packed: a crystal is more likely");
  }
}

}  // namespace

EvenPart even_part_of(const LoadedBody& a, const LoadedBody& b) {
  const std::string names = a.source == b.source ? a.source : a.source + " and " + b.source;
  const std::optional<LegendreSeries> series = excluded_volume_series(a.shape, b.shape, kHighestDegree);
  if (!series) {
    throw InputError("V_ex(gamma) would take too long (" + names +
                     ") - give a body of fewer vertices, or an ellipsoid that is less thin");
  }
  EvenPart part;
  part.excluded_volume = series->front();
  if (!(part.excluded_volume > 0.0)) {
    throw InputError("bodies that exclude no volume have no transition (" + names +
                     ") - give a thin one of a small radius: capsule:1000,0.5");
  }
  if (!std::isfinite(part.excluded_volume)) {
    throw InputError("a result would overflow (the excluded volume of " + names + ") - choose another unit of length");
  }
  for (std::size_t l = 0; l < series->size(); l += 2) part.series.push_back((*series)[l] / part.excluded_volume);
  for (std::size_t l = 3; l < series->size(); l += 2) {
    part.largest_odd = std::max(part.largest_odd, std::fabs((*series)[l]) / part.excluded_volume);
  }
  return part;
}

NematicRun run_nematic(const NematicOptions& options, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  NematicRun run{command, options, load_body(options.body, options.body_options)};
  if (options.dump_vertices) require_vertices_to_list({&run.body, 1});
  const EvenPart part = even_part_of(run.body, run.body);
  run.excluded_volume = part.excluded_volume;
  run.fluid.series = part.series;
  run.fluid.volume_by_b2 = run.volume() / run.b();
  run.fluid.theory = options.theory;
  run.fluid.trial_function = options.trial_function;
  if (options.theory == NematicTheory::parsons_lee && !(run.volume() > 0.0)) {
    throw UsageError("a flat body has no volume, which the scaling of Parsons and Lee is about (" + options.body +
                     " for --theory parsons-lee) - use --theory onsager");
  }
  note_the_body(run, part.largest_odd);
  run.result = coexistence(run.fluid);
  note_the_result(run);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace vex
