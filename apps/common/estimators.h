// Every estimator of the excluded volume, by name, and the settings of the one driver that it is.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/pilot.h"
#include "shapes/any_shape.h"

namespace vex {

enum class Estimator : std::uint8_t { hit_or_miss, hit_or_miss_fitted, stratified, radial, mixed_volume, mean_width };

inline constexpr std::array kEstimators = {Estimator::hit_or_miss,  Estimator::hit_or_miss_fitted,
                                           Estimator::stratified,   Estimator::radial,
                                           Estimator::mixed_volume, Estimator::mean_width};

constexpr std::string_view name_of(Estimator estimator) {
  switch (estimator) {
    case Estimator::hit_or_miss: return "hit-or-miss";
    case Estimator::hit_or_miss_fitted: return "hit-or-miss-fitted";
    case Estimator::stratified: return "stratified";
    case Estimator::radial: return "radial";
    case Estimator::mixed_volume: return "mixed-volume";
    case Estimator::mean_width: break;
  }
  return "mean-width";
}
std::optional<Estimator> estimator_named(std::string_view name);

/// Whether it asks for verdicts on poses: any backend can answer, and quick verdicts, domains and checks are about it.
constexpr bool samples_poses(Estimator estimator) {
  return estimator == Estimator::hit_or_miss || estimator == Estimator::hit_or_miss_fitted ||
         estimator == Estimator::stratified;
}

/// Whether GJK is what gives the values, so that the formula is held against something else than its own geometry.
constexpr bool is_independent_of_formula(Estimator estimator) {
  return samples_poses(estimator) || estimator == Estimator::radial;
}

/// The sequence where none is asked for: hits and misses gain little from quasi-random points, and random trials have
/// Wilson's interval.
constexpr Sequence usual_sequence(Estimator estimator) {
  return samples_poses(estimator) ? Sequence::random : Sequence::sobol;
}

/// The run ends at this relative error where no stop rule is given.
constexpr double usual_relative_error(Estimator estimator) { return samples_poses(estimator) ? 1e-3 : 1e-4; }

/// Why the pair or the law is none for the estimator; nothing where it is.
std::optional<std::string> why_not(Estimator estimator, const MeasuredBody& a, const MeasuredBody& b,
                                   const OrientationLaw& law);

/// Makes `settings`, whose law is set, those of the estimator: the integrand, which refers to the bodies, or the domain
/// (the one asked for, of hit-or-miss). Throws UsageError with `why_not`.
void set_estimator(MonteCarloSettings& settings, Estimator estimator, const MeasuredBody& a, const MeasuredBody& b,
                   std::optional<Domain::Kind> domain = {});

/// The settings' integrand with that of two simpler bodies as a control variate (control_variate.h), whose mean over
/// random orientations is the formula's. Returns its weight. Only where there is an integrand and the law is isotropic;
/// throws UsageError otherwise, and where `why_not`.
double set_control_variate(MonteCarloSettings& settings, Estimator estimator, const MeasuredBody& control_a,
                           const MeasuredBody& control_b);

/// One way to the answer, and what it costs.
struct Candidate {
  Estimator estimator{};
  Sequence sequence{};
  PilotCost cost;
};

/// Measures the estimators for this pair: those among which `chosen_of` chooses, then, but for large meshes, the ones
/// that share the formula's geometry. What is not for the pair is left out, and what an interrupt came before.
std::vector<Candidate> measure_candidates(const MeasuredBody& a, const MeasuredBody& b,
                                          const MonteCarloSettings& settings);

/// The radial estimator, unless another one that runs GJK takes less than a quarter of its time to the error: short
/// runs tell the cost of a longer one to a factor of two or so, and the choice should not be one of noise.
Candidate chosen_of(const std::vector<Candidate>& candidates, double relative_error);

}  // namespace vex
