#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/trial_runner.h"

namespace vex {
namespace {

class AveragingRunner final : public TrialRunner {
 public:
  AveragingRunner(const MonteCarloSettings& settings, std::unique_ptr<Integrand> integrand, double reference)
      : settings_(settings),
        integrand_(std::move(integrand)),
        points_(settings.seed, settings.sequence, integrand_->dimension(), {}, settings.instruction_set,
                integrand_->n_independent_coordinates()),
        columns_(static_cast<std::size_t>(integrand_->dimension() + 1) * kStride),
        reference_(reference) {
    Tally before;  // the reference is no trial
    integrand_->count(before.counted);
  }

  BlockRecord run(std::uint64_t begin, std::uint64_t end) override {
    BlockRecord record;
    ClassTally& by_class = record.tally.by_class = empty_classes(settings_, points_.n_classes());
    by_class.is_signed = integrand_->may_be_negative();
    by_class.offset = reference_;
    by_class.unit = integrand_->scale();
    by_class.relative_rounding = integrand_->relative_rounding();
    by_class.absolute_rounding = integrand_->absolute_rounding();
    for (std::uint64_t k = 0; k < points_.n_classes(); ++k) {
      const Trials trials = trials_of_class(k, points_.n_classes(), begin, end);
      for (std::size_t done = 0; done < trials.n; done += kBatch) {
        add(trials.part(done, kBatch), record.tally, by_class.classes[k]);
      }
    }
    integrand_->count(record.tally.counted);
    return record;
  }

 private:
  static constexpr std::size_t kBatch = 256, kStride = kBatch + TrialPoints::kSpare;

  void add(const Trials& trials, Tally& tally, ClassSums& sums) {
    const std::size_t n = trials.n;
    points_.many(trials.first, n, columns_.data(), kStride);
    const auto dimension = static_cast<std::size_t>(integrand_->dimension());
    for (std::size_t c = 1; c < dimension; ++c) std::copy_n(&columns_[c * kStride], n, &columns_[c * n]);
    const std::span<double> values(values_.data(), n);
    const Doubts doubts = integrand_->evaluate(std::span<const double>(columns_).first(dimension * n), values);
    const double unit = tally.by_class.unit;
    for (double& value : values) value = checked((value - reference_) / unit);
    sums.n += n;
    sums.values.add(values);
    tally.n_trials += n;
    tally.n_undecided += doubts.size();
    tally.n_decided_by[static_cast<std::size_t>(DecidedBy::gjk)] += n - doubts.size();
    for (const Doubt& doubt : doubts) tally.by_class.half_widths.add(checked(doubt.half_width / unit));
  }

  static double checked(double value) {
    if (std::fabs(value) <= Integrand::kLargestValue) return value;
    throw UsageError("values of this estimator are lost to rounding (one is " + std::to_string(value) +
                     " times what the bodies can have) - use hit-or-miss-fitted");
  }

  const MonteCarloSettings& settings_;
  std::unique_ptr<Integrand> integrand_;
  TrialPoints points_;
  std::vector<double> columns_;
  std::array<double, kBatch> values_{};
  double reference_;  // which values are counted from: the run's, not this thread's
};

}  // namespace

ClassTally empty_classes(const MonteCarloSettings& settings, std::uint64_t n_classes) {
  ClassTally by_class;
  by_class.kind = settings.sequence == Sequence::sobol ? ClassTally::Kind::scramblings
                  : settings.stratified                ? ClassTally::Kind::strata
                                                       : ClassTally::Kind::one;
  by_class.classes.resize(n_classes);
  return by_class;
}

double reference_value(Integrand& integrand) {
  std::vector<double> any_point(static_cast<std::size_t>(integrand.dimension()));
  draw_unit_cube(0, Stream::pilot, 0, any_point);
  double value = 0.0;
  integrand.evaluate(any_point, {&value, 1});
  return std::fabs(value) <= Integrand::kLargestValue * integrand.scale() ? value : 0.0;
}

std::unique_ptr<TrialRunner> make_averaging_runner(const MonteCarloSettings& settings,
                                                   std::unique_ptr<Integrand> integrand, double reference) {
  return std::make_unique<AveragingRunner>(settings, std::move(integrand), reference);
}

}  // namespace vex
