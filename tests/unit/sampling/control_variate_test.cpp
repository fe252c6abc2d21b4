#include "engine/sampling/control_variate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/radial/radial_estimator.h"
#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {
namespace {

// a + b u of the first coordinate, and noise of the second.
class Line final : public Integrand {
 public:
  Line(double a, double b, double noise) : a_(a), b_(b), noise_(noise) {}
  int dimension() const override { return noise_ == 0.0 ? 1 : 2; }
  double scale() const override { return 1.0; }
  double cost() const override { return 10.0; }
  double relative_rounding() const override { return 1e-12; }
  Doubts evaluate(std::span<const double> points, std::span<double> values) override {
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = a_ + b_ * points[k] + (noise_ == 0.0 ? 0.0 : noise_ * (points[values.size() + k] - 0.5));
    }
    return {};
  }

 private:
  double a_, b_, noise_;
};

TEST(ControlVariate, TakesOffWhatTheTwoHaveInCommon) {
  Line f(1.0, 2.0, 0.1), g(3.0, 4.0, 0.0);
  const double weight = control_weight(f, g, 7);
  EXPECT_NEAR(weight, 0.5, 0.01);
  MonteCarloSettings settings;
  settings.stop.trials = 10000;
  const ConvexBody nobody = parse_shape("sphere:1").body;
  const auto error_of = [&] {
    const VolumeEstimate found = volume_estimate(run_monte_carlo(nobody, nobody, settings).tally, {});
    EXPECT_LE(std::fabs(found.excluded_volume - 2.0), 5.0 * found.std_error);
    return found.std_error;
  };
  settings.integrand = [] { return std::make_unique<Line>(1.0, 2.0, 0.1); };
  const double alone = error_of();
  settings.integrand = [weight] {
    return std::make_unique<ControlledIntegrand>(std::make_unique<Line>(1.0, 2.0, 0.1),
                                                 std::make_unique<Line>(3.0, 4.0, 0.0), 5.0, weight);
  };
  EXPECT_NEAR(error_of() / alone, 0.05, 0.01);
  // A wrong mean is a bias, which the error does not see: it must be exact.
  settings.integrand = [weight] {
    return std::make_unique<ControlledIntegrand>(std::make_unique<Line>(1.0, 2.0, 0.1),
                                                 std::make_unique<Line>(3.0, 4.0, 0.0), 5.1, weight);
  };
  const VolumeEstimate biased = volume_estimate(run_monte_carlo(nobody, nobody, settings).tally, {});
  EXPECT_NEAR(biased.excluded_volume, 2.05, 5.0 * biased.std_error);
}

TEST(ControlVariate, ThatDoesNotVaryHasNoWeight) {
  Line f(1.0, 2.0, 0.1), constant(3.0, 0.0, 0.0);
  EXPECT_EQ(control_weight(f, constant, 1), 0.0);
}

TEST(ControlVariate, OfARoundedBoxIsTheBox) {
  const Body rounded = parse_shape("rounded:0.1,box:1,1,1"), box = parse_shape("box:1,1,1");
  const double truth = average_excluded_volume(rounded.measures, rounded.measures);
  const OrientationLaw law;
  const auto make = [&law](const Body& body) { return std::make_unique<RadialEstimator>(body.body, body.body, law); };
  MonteCarloSettings settings;
  settings.stop.trials = 1u << 14;
  const auto estimate = [&] {
    const VolumeEstimate found = volume_estimate(run_monte_carlo(box.body, box.body, settings).tally, {});
    EXPECT_LE(std::fabs(found.excluded_volume - truth), 5.0 * found.std_error);
    return found.std_error;
  };
  settings.integrand = [&] { return make(rounded); };
  const double alone = estimate();
  const double weight = control_weight(*make(rounded), *make(box), 1);
  settings.integrand = [&] { return std::make_unique<ControlledIntegrand>(make(rounded), make(box), 11.0, weight); };
  EXPECT_LT(estimate(), 0.2 * alone);
}

}  // namespace
}  // namespace vex
