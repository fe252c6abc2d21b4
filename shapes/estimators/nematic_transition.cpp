#include "shapes/estimators/nematic_transition.h"

#include <algorithm>
#include <array>
#include <optional>

#include "engine/numeric/errors.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

constexpr std::size_t kHighestDegree = 256;  // as many as the doubled grid has
constexpr double kNone = 1e-9;               // of a coefficient, relative to <V_ex>: what rounding makes of 0

/// V_ex(gamma) / <V_ex> of two bodies, the mean of gamma and 180 degrees - gamma, and <V_ex>.
struct EvenPart {
  NematicMixture::Pair pair;
  double largest_odd = 0.0;  // coefficient that is left out, over <V_ex>
};

EvenPart even_part_of(const Body& a, const Body& b) {
  const std::string names = &a == &b ? a.kind : a.kind + " and " + b.kind;
  const std::optional<LegendreSeries> series = excluded_volume_series(a, b, kHighestDegree);
  if (!series) {
    throw InputError("V_ex(gamma) would take too long (" + names +
                     ") - give a body of fewer vertices, or a less thin one");
  }
  const double mean = series->front();
  if (!(mean > 0.0)) {
    throw InputError("bodies that exclude no volume have no transition (" + names +
                     ") - give a thin one of a small radius: capsule:1000,0.5");
  }
  if (!std::isfinite(mean)) {
    throw InputError("a result would overflow (the excluded volume of " + names + ") - choose another unit of length");
  }
  EvenPart part;
  part.pair.excluded_volume = mean;
  for (std::size_t l = 0; l < series->size(); l += 2) part.pair.series.push_back((*series)[l] / mean);
  for (std::size_t l = 3; l < series->size(); l += 2) {
    part.largest_odd = std::max(part.largest_odd, std::fabs((*series)[l]) / mean);
  }
  return part;
}

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

void note_the_body(const Body& body, double largest_odd, NematicTransition& transition) {
  std::vector<std::string>& notes = transition.notes;
  if (largest_odd > kNone) {
    notes.emplace_back(
        "the body's two ends differ: V_ex(gamma) is the mean of gamma and 180 degrees - gamma, as for a fluid with as "
        "many axes up as down");
  }
  if (const std::string axis = better_axis(body.body); !axis.empty()) {
    notes.push_back("the body is longest or thinnest along " + axis +
                    ", but its z axis is taken for the one that aligns: turn it");
  }
  const EvenSeries& of_angle = transition.fluid.series;
  if (of_angle.size() > 2 && of_angle[2] < -kNone && of_angle[2] * 5.0 / 9.0 < of_angle[1]) {
    notes.emplace_back(
        "order of the fourth rank, as cubes have it, would come before the nematic one: this theory does not look for "
        "it");
  }
}

void note_the_result(NematicTransition& transition) {
  if (!transition.result.found || !(transition.volume > 0.0)) return;
  const double packing = transition.result.found->nematic.reduced_density * transition.fluid.volume_by_b2;
  constexpr double kSpheres = 0.7405;  // pi / sqrt(18)
  if (packing >= 1.0) {
    transition.notes.emplace_back(
        "the nematic fluid's volume fraction is above 1: there is no such fluid of this body" +
        std::string(transition.fluid.theory == NematicTheory::onsager
                        ? ", it is too short for Onsager's theory - try that of Parsons and Lee (parsons-lee)"
                        : ""));
  } else if (packing > kSpheres) {
    transition.notes.emplace_back("the nematic fluid is denser than spheres can be packed: a crystal is more likely");
  }
}

}  // namespace

NematicTransition nematic_transition(const Body& body, NematicTheory theory, bool trial_function) {
  EvenPart part = even_part_of(body, body);
  NematicTransition transition;
  transition.excluded_volume = part.pair.excluded_volume;
  transition.volume = body.measures.volume;
  transition.fluid.series = std::move(part.pair.series);
  transition.fluid.volume_by_b2 = transition.volume / (0.5 * transition.excluded_volume);
  transition.fluid.theory = theory;
  transition.fluid.trial_function = trial_function;
  note_the_body(body, part.largest_odd, transition);
  transition.result = coexistence(transition.fluid);
  note_the_result(transition);
  return transition;
}

double MixtureTransition::volume_fraction(const MixturePhase& phase) const {
  if (!(mixture.volumes[0] > 0.0 && mixture.volumes[1] > 0.0)) return std::nan("");
  return phase.number_densities[0] * mixture.volumes[0] + phase.number_densities[1] * mixture.volumes[1];
}

double MixtureTransition::reduced_density(const MixturePhase& phase) const {
  const double n = phase.number_density(), x = phase.composition();
  const double mean = (1.0 - x) * (1.0 - x) * mixture.aa.excluded_volume +
                      2.0 * x * (1.0 - x) * mixture.ab.excluded_volume + x * x * mixture.bb.excluded_volume;
  return 0.5 * n * mean;
}

MixtureTransition mixture_transition(const Body& a, const Body& b, const std::vector<double>& compositions,
                                     NematicTheory theory) {
  MixtureTransition transition;
  NematicMixture& mixture = transition.mixture;
  mixture.aa = even_part_of(a, a).pair;
  mixture.ab = even_part_of(a, b).pair;
  mixture.bb = even_part_of(b, b).pair;
  mixture.volumes = {a.measures.volume, b.measures.volume};
  mixture.theory = theory;
  transition.result = coexistence_of_mixture(mixture, compositions);
  return transition;
}

}  // namespace vex
