// The ways to the average excluded volume, each with its name, what it needs, and how it is run; and the list of them.
//
// A new one is a file with a `const Estimator` in it, and its line in estimator.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/sampling/monte_carlo.h"
#include "shapes/body.h"

namespace vex {

struct Estimator {
  std::string_view name;     // as users write it
  std::string_view meaning;  // in a few words

  /// Whether it asks for verdicts on poses: any backend can answer, and quick verdicts, domains and checks are about
  /// it.
  bool samples_poses = false;
  /// Whether GJK is what gives the values, so that the formula is held against something else than its own geometry.
  bool runs_gjk = false;
  /// Whether the domain that poses are drawn from can be chosen.
  bool has_domains = false;

  /// The sequence where none is asked for: hits and misses gain little from quasi-random points, and random trials have
  /// Wilson's interval.
  Sequence usual_sequence = Sequence::random;
  /// The one that it is measured with before it is chosen, and run with where it is.
  Sequence pilot_sequence = Sequence::random;
  /// Its time counts as this many times what it is where one is chosen: pilots tell the cost of a longer run to a
  /// factor of two or so, and the choice should not be one of noise.
  double handicap = 1.0;

  /// Why the pair or the law is none for it; nothing where it is.
  std::optional<std::string> (*why_not)(const Body& a, const Body& b, const OrientationLaw& law) = nullptr;
  /// Sets the integrand, which refers to the bodies, or the domain: that of this kind where it has a choice, the best
  /// without a kind. The law is set, and `why_not` has nothing against the pair.
  void (*prepare)(MonteCarloSettings& settings, const Body& a, const Body& b,
                  std::optional<Domain::Kind> domain) = nullptr;
};

/// All of them.
std::span<const Estimator* const> estimators();

/// Null where there is none of the name.
const Estimator* find_estimator(std::string_view name);
/// Throws UsageError, which names all, where there is none.
const Estimator& estimator_named(std::string_view name);

/// Makes `settings`, whose law is set, those of the estimator. Throws UsageError with `why_not`.
void set_estimator(MonteCarloSettings& settings, const Estimator& estimator, const Body& a, const Body& b,
                   std::optional<Domain::Kind> domain = {});

/// The settings' integrand with that of two simpler bodies as a control variate (control_variate.h), whose mean over
/// random orientations is the formula's. Returns its weight. Only where there is an integrand and the law is isotropic;
/// throws UsageError otherwise, and where `why_not`.
double set_control_variate(MonteCarloSettings& settings, const Estimator& estimator, const Body& control_a,
                           const Body& control_b);

}  // namespace vex
