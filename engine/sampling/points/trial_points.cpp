#include "engine/sampling/points/trial_points.h"

#include <array>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

constexpr int kLog2Classes = 5;
static_assert(kClasses == 1u << kLog2Classes);

using RandomColumns = decltype(&sse2::random_columns);
using SobolColumns = decltype(&sse2::sobol_columns);
struct PointKernels {
  RandomColumns random = nullptr;
  SobolColumns sobol = nullptr;
};

// None for `scalar`.
PointKernels point_kernels(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return {name::random_columns, name::sobol_columns};
#include "engine/numeric/kernel_sets.inc"
  return {};
}

// One by one, where there is no kernel.
template <class Draw>
void draw_into_columns(int dimension, std::size_t n, double* columns, std::size_t stride, const Draw& draw) {
  std::vector<double> point(static_cast<std::size_t>(dimension));
  for (std::size_t k = 0; k < n; ++k) {
    draw(k, std::span(point));
    for (std::size_t c = 0; c < point.size(); ++c) columns[c * stride + k] = point[c];
  }
}

}  // namespace

TrialPoints::TrialPoints(std::uint64_t seed, Sequence sequence, int dimension, std::optional<Strata> strata,
                         InstructionSet set, int n_independent)
    : seed_(seed), dimension_(dimension), n_independent_(n_independent), strata_(strata), set_(set) {
  if (dimension < 1 || n_independent < 0 || n_independent > 2 || n_independent >= dimension ||
      (strata && strata->coordinate >= static_cast<std::size_t>(dimension))) {
    throw UsageError("points of " + std::to_string(dimension) + " coordinates, " + std::to_string(n_independent) +
                     " of them independent - one or more, at most two of them, and not all, independent");
  }
  if (sequence == Sequence::random) return;
  Scrambled scrambled{SobolPoints(dimension - n_independent), {}};
  for (std::uint64_t k = 0; k < kClasses; ++k) scrambled.scramblings.push_back(scrambled.points.scrambling(seed, k));
  sobol_ = std::make_shared<const Scrambled>(std::move(scrambled));
}

double TrialPoints::in_stratum(double u, std::uint64_t index) const {
  const double share = sobol_ ? u : (static_cast<double>(index % kClasses) + u) * (1.0 / kClasses);
  return strata_->from + (1.0 - strata_->from) * share;
}

void TrialPoints::one(std::uint64_t index, std::span<double> point) const {
  VEX_EXPECT(point.size() == static_cast<std::size_t>(dimension_));
  if (sobol_) {
    const std::size_t n_of_net = point.size() - static_cast<std::size_t>(n_independent_);
    sobol_->points.scrambled(sobol_->scramblings[index % kClasses], index / kClasses, point.first(n_of_net));
    draw_unit_cube(seed_, Stream::pose, index, point.subspan(n_of_net));
  } else {
    draw_unit_cube(seed_, Stream::pose, index, point);
  }
  if (strata_) point[strata_->coordinate] = in_stratum(point[strata_->coordinate], index);
}

void draw_unit_cubes(InstructionSet set, std::uint64_t seed, Stream stream, std::uint64_t first, int dimension,
                     std::size_t n, double* columns, std::size_t stride) {
  VEX_EXPECT(stride >= n + TrialPoints::kSpare);
  const RandomColumns random = point_kernels(set).random;
  if (random != nullptr) return random(seed, stream, first, 0, dimension, n, columns, stride);
  draw_into_columns(dimension, n, columns, stride,
                    [&](std::size_t k, std::span<double> point) { draw_unit_cube(seed, stream, first + k, point); });
}

void TrialPoints::many(std::uint64_t first, std::size_t n, double* columns, std::size_t stride) const {
  VEX_EXPECT(stride >= n + kSpare);
  const PointKernels kernels = point_kernels(set_);
  if (kernels.random == nullptr) {
    return draw_into_columns(dimension_, n, columns, stride,
                             [&](std::size_t k, std::span<double> point) { one(first + k * n_classes(), point); });
  }
  if (sobol_) {
    if (n_independent_ > 0) {
      kernels.random(seed_, Stream::pose, first, kLog2Classes, n_independent_, n,
                     columns + static_cast<std::size_t>(dimension_ - n_independent_) * stride, stride);
    }
    kernels.sobol(sobol_->points, sobol_->scramblings[first % kClasses].data(), first / kClasses, n, columns, stride);
  } else {
    kernels.random(seed_, Stream::pose, first, n_classes() == 1 ? 0 : kLog2Classes, dimension_, n, columns, stride);
  }
  if (!strata_) return;
  double* const column = columns + strata_->coordinate * stride;
  for (std::size_t k = 0; k < n; ++k) column[k] = in_stratum(column[k], first);
}

}  // namespace vex
