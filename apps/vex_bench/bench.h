// Run time against error: every estimator and backend on one body with itself, by runs of growing length.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/overlap_backend.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/estimator.h"

namespace vex {

struct BenchBody {
  std::string name;    // for people
  std::string source;  // for the command line, where there is a word for it
  Body shape;
};

/// One length of run: several runs under as many seeds.
struct Rung {
  std::uint64_t n_trials = 0;
  int n_runs = 0;
  double seconds = 0.0;              // of one run
  double relative_error = 0.0;       // std_error / estimate, root of the mean square
  double true_relative_error = 0.0;  // estimate / formula - 1, root of the mean square
  double largest_z = 0.0;
};

struct TimeToError {
  double seconds = 0.0;          // infinite where no run had an error
  bool is_extrapolated = false;  // beyond what was run
};

/// How the error of one estimator, sequence and backend falls with time.
struct ErrorCurve {
  const Estimator* estimator = nullptr;
  Sequence sequence{};
  std::string backend;
  bool is_library = false;  // another library answers: libccd or FCL
  std::vector<Rung> rungs{};

  std::string name() const;
  /// Of log error over log trials, which are what time is spent on; a least-squares line through rungs of 1000 trials
  /// and more. Nothing with fewer than three.
  std::optional<double> slope() const;
  /// 1 / (variance of the relative error x seconds), of the longest runs.
  double figure_of_merit() const;
  /// Between rungs by a line through the logarithms; beyond the last one by the slope, which for random points is -1/2.
  TimeToError time_to(double relative_error) const;
};

struct BodyCurves {
  BenchBody body;
  double exact = 0.0;  // the formula's
  std::vector<ErrorCurve> curves{};
};

struct BenchSettings {
  std::uint64_t seed = 1;
  int n_threads = 1;
  double seconds = 1.0;       // for each curve, about
  double least_error = 1e-6;  // shorter runs than these are enough
  const std::atomic<int>* interrupt = nullptr;
  std::function<void(const std::string& what)> on_curve;  // before each
  std::function<void(const Progress&)> on_progress;       // of each of its runs
};

/// The six bodies that are measured where none is named.
std::vector<BenchBody> standard_bodies();

/// All curves of the body; fewer, or shorter ones, where it is interrupted.
BodyCurves measure(const BenchBody& body, const BenchSettings& settings);

}  // namespace vex
