// The estimator by ray casts: a third of the cube of the radial function of A - B, averaged over directions and
// orientations.
#include <memory>

#include "engine/sampling/radial/radial_estimator.h"
#include "shapes/estimators/estimator.h"

namespace vex {
namespace {

std::optional<std::string> not_for_thin_ones(const Body& a, const Body& b, const OrientationLaw& law) {
  if (!RadialMap(a.body, b.body, law).is_too_thin()) return std::nullopt;
  return "A - B is thinner than 2^-22 of its length, and double precision does not tell rays in it apart";
}

void by_rays(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind>) {
  // Copies, which share the shapes: the integrand may outlive what the caller holds.
  settings.integrand = [a = a.body, b = b.body, law = settings.law, set = settings.instruction_set] {
    return std::make_unique<RadialEstimator>(a, b, law, set);
  };
}

}  // namespace

extern const Estimator kRadial;
constinit const Estimator kRadial{.name = "radial",
                                  .meaning = "by ray casts",
                                  .runs_gjk = true,
                                  .usual_sequence = Sequence::sobol,
                                  .pilot_sequence = Sequence::sobol,
                                  .handicap = 0.25,
                                  .why_not = not_for_thin_ones,
                                  .prepare = by_rays};

}  // namespace vex
