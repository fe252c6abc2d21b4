#include "shapes/nematic/mixture_fluid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "shapes/nematic/fixed_point.h"

namespace vex {
namespace {

constexpr double kMomentTolerance = 1e-13;  // of moments
constexpr int kMostRounds = 4000;

}  // namespace

MixtureFluid::MixtureFluid(const NematicMixture& mixture)
    : mixture_(mixture), grid_(mixture.aa.series, OrientationGrid::Size::doubled) {
  if (mixture.theory == NematicTheory::parsons_lee && !(mixture.volumes[0] > 0.0 && mixture.volumes[1] > 0.0)) {
    throw UsageError(
        "a flat body has no volume, which the scaling of Parsons and Lee is about - take Onsager's theory");
  }
  for (const NematicMixture::Pair* const pair : {&mixture.aa, &mixture.ab, &mixture.bb}) {
    if (!(pair->excluded_volume > 0.0) || pair->series.empty()) {
      throw UsageError("a pair of bodies excludes no volume - give others");
    }
  }
}

BothDensities MixtureFluid::equilibrium(const TwoDensities& n, const TwoSeries& start) const {
  const double factor = scaling(n).factor;
  const std::size_t n_degrees = mixture_.aa.series.size();
  BothDensities both;
  std::vector<double> moments;  // A's and B's
  for (EvenSeries of_kind : start) {
    of_kind.resize(n_degrees, 0.0);
    moments.insert(moments.end(), of_kind.begin(), of_kind.end());
  }
  std::vector<double> found(moments.size(), 0.0);
  FixedPoint fixed_point;
  for (int iteration = 0; iteration < kMostRounds && !both.converged; ++iteration) {
    end_if_interrupted();
    for (std::size_t i = 0; i < 2; ++i) {
      EvenSeries field(n_degrees, 0.0);
      for (std::size_t j = 0; j < 2; ++j) {
        const EvenSeries& of_pair = series(i, j);
        for (std::size_t k = 1; k < std::min(n_degrees, of_pair.size()); ++k) {
          field[k] -= 2.0 * factor * n[j] * b(i, j) * of_pair[k] * moments[j * n_degrees + k];
        }
      }
      both.of[i] = grid_.in_field(field);
      const EvenSeries& of_kind = both.of[i].moments;
      std::copy_n(of_kind.begin(), std::min(n_degrees, of_kind.size()),
                  found.begin() + static_cast<std::ptrdiff_t>(i * n_degrees));
    }
    both.converged = fixed_point.step(moments, found) <= kMomentTolerance;
  }
  return both;
}

BothDensities MixtureFluid::isotropic() const {
  BothDensities both;
  for (OrientationDensity& one : both.of) one = grid_.in_field({});
  both.converged = true;
  return both;
}

bool MixtureFluid::is_too_sharp(const BothDensities& both) const {
  // Terms fall no slower than 1 / l^2 behind the last one: together they are below that times the number of terms.
  constexpr double kMostOfTail = 1e-10;
  for (std::size_t i = 0; i < 2; ++i) {
    const EvenSeries& moments = both.of[i].moments;
    const std::size_t n = std::min(series(i, i).size(), moments.size());
    const double last = moments[n - 1];
    if (static_cast<double>(n) * std::fabs(series(i, i)[n - 1]) * last * last > kMostOfTail) return true;
  }
  return false;
}

MixturePhase MixtureFluid::phase(const TwoDensities& n, const BothDensities& both) const {
  const Scaling of = scaling(n);
  MixturePhase phase;
  phase.number_densities = n;
  double pairs = 0.0;  // sum of n_i n_j b_ij e_ij
  for (std::size_t i = 0; i < 2; ++i) {
    double met = 0.0;  // sum of n_j b_ij e_ij
    for (std::size_t j = 0; j < 2; ++j) met += n[j] * b(i, j) * interaction(both, i, j);
    pairs += n[i] * met;
    phase.chemical_potentials[i] = std::log(n[i] * b(0, 0)) + both.of[i].entropy + 2.0 * of.factor * met;
    phase.order_parameters[i] = both.of[i].order_parameter();
  }
  for (std::size_t i = 0; i < 2; ++i) phase.chemical_potentials[i] += pairs * of.slope * mixture_.volumes[i];
  phase.pressure = n[0] + n[1] + pairs * (of.factor + of.volume_fraction * of.slope);
  return phase;
}

MixtureFluid::Scaling MixtureFluid::scaling(const TwoDensities& n) const {
  if (mixture_.theory == NematicTheory::onsager) return {};
  const double eta = n[0] * mixture_.volumes[0] + n[1] * mixture_.volumes[1], rest = 1.0 - eta;
  return {(4.0 - 3.0 * eta) / (4.0 * rest * rest), (5.0 - 3.0 * eta) / (4.0 * rest * rest * rest), eta};
}

double MixtureFluid::interaction(const BothDensities& both, std::size_t i, std::size_t j) const {
  const EvenSeries &of_pair = series(i, j), &x = both.of[i].moments, &y = both.of[j].moments;
  double sum = 0.0;
  for (std::size_t k = 0; k < std::min({of_pair.size(), x.size(), y.size()}); ++k) sum += of_pair[k] * x[k] * y[k];
  return sum;
}

}  // namespace vex
