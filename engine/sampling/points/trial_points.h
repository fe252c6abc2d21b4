// The point of the unit cube that belongs to a trial: random, or quasi-random and scrambled, or of a stratum.
//
// A function of (seed, kind of points, index) and of nothing else. Quasi-random and stratified trials come in classes:
// trial i is in class i mod kClasses, as the trial number i / kClasses of its own scrambling, or stratum. All classes
// grow alike, and any run of trials has an error from the classes' spread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/points/sobol.h"

namespace vex {

enum class Sequence : std::uint8_t { random, sobol };

constexpr std::string_view name_of(Sequence sequence) { return sequence == Sequence::random ? "random" : "sobol"; }

/// As many independent scramblings, or strata.
inline constexpr std::uint64_t kClasses = 32;

/// One coordinate is confined to an interval that ends at 1; of random points the interval is cut into kClasses strata.
struct Strata {
  std::size_t coordinate = 0;
  double from = 0.0;
};

class TrialPoints {
 public:
  /// The last `n_independent` coordinates are random in either sequence, at most 2 and fewer than `dimension`.
  /// Anything else is a UsageError, and so are strata of a coordinate that is not there.
  TrialPoints(std::uint64_t seed, Sequence sequence, int dimension, std::optional<Strata> strata = {},
              InstructionSet set = best_instruction_set(), int n_independent = 0);

  /// Trials of a Sobol' sequence, of which each scrambling has 2^32 points.
  static constexpr std::uint64_t kMostSobolTrials = kClasses << SobolPoints::kBits;

  int dimension() const { return dimension_; }
  /// kClasses, or 1.
  std::uint64_t n_classes() const { return sobol_ || strata_ ? kClasses : 1; }

  void one(std::uint64_t index, std::span<double> point) const;

  /// The trials first, first + n_classes(), ..., n of them: coordinate c of trial k at columns[c * stride + k]. The
  /// same bits as `one`. Writes up to kSpare numbers more to each column, and one column more.
  void many(std::uint64_t first, std::size_t n, double* columns, std::size_t stride) const;
  static constexpr std::size_t kSpare = 32;

 private:
  // Shared by copies: the same for all threads.
  struct Scrambled {
    SobolPoints points;
    std::vector<SobolPoints::Scrambling> scramblings;
  };

  double in_stratum(double u, std::uint64_t index) const;

  std::uint64_t seed_;
  int dimension_;
  int n_independent_;
  std::optional<Strata> strata_;
  InstructionSet set_;
  std::shared_ptr<const Scrambled> sobol_;  // none of random points
};

/// draw_unit_cube of the indices first, ..., first + n - 1, in columns as TrialPoints::many has them.
void draw_unit_cubes(InstructionSet set, std::uint64_t seed, Stream stream, std::uint64_t first, int dimension,
                     std::size_t n, double* columns, std::size_t stride);

// Kernels of TrialPoints::many. Random points of the trials first, first + 2^log2_step, ...; two coordinates are
// written together, so there must be room for an even number of columns.
#define VEX_DECLARE_POINT_KERNELS(set)                                                                             \
  namespace set {                                                                                                  \
  void random_columns(std::uint64_t seed, Stream stream, std::uint64_t first, int log2_step, int dimension,        \
                      std::size_t n, double* columns, std::size_t stride);                                         \
  void sobol_columns(const SobolPoints& points, const SobolPoints::Keys* keys, std::uint64_t first, std::size_t n, \
                     double* columns, std::size_t stride);                                                         \
  }
VEX_DECLARE_POINT_KERNELS(sse2)
VEX_DECLARE_POINT_KERNELS(avx2)
VEX_DECLARE_POINT_KERNELS(avx512)
#undef VEX_DECLARE_POINT_KERNELS

}  // namespace vex
