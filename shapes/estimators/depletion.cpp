#include "shapes/estimators/depletion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <thread>
#include <vector>

#include "engine/numeric/elementary.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/query/overlap.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

using std::numbers::pi;

/// A box along A's axes; empty where a width is not above 0.
struct OverlapBox {
  Vec3d low, width;
  bool is_empty() const { return !(width.x > 0.0 && width.y > 0.0 && width.z > 0.0); }
  double volume() const { return width.x * width.y * width.z; }
};

struct Interval {
  double low, high;
};

/// How far a placed body with a ball about each point reaches along a unit axis of A's frame, widened by more than what
/// its support mapping is off by.
Interval reach_along(const ConvexBody& body, const Transformd& a_from_body, const Vec3d& axis, double ball_radius) {
  const Vec3d dir = a_from_body.direction_to_b(axis);
  const double at = dot(axis, a_from_body.translation);
  const double margin = body.support_error() + 0x1p-40 * (body.reach() + std::fabs(at)) + ball_radius * (1.0 + 0x1p-40);
  return {at + dot(dir, body.support(-dir)) - margin, at + dot(dir, body.support(dir)) + margin};
}

OverlapBox box_around(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, double ball_radius) {
  const auto both = [&](const Vec3d& axis) -> Interval {
    const Interval of_a = reach_along(a, Transformd{}, axis, ball_radius);
    const Interval of_b = reach_along(b, a_from_b, axis, ball_radius);
    return {std::max(of_a.low, of_b.low), std::min(of_a.high, of_b.high)};
  };
  const Interval x = both({1.0, 0.0, 0.0}), y = both({0.0, 1.0, 0.0}), z = both({0.0, 0.0, 1.0});
  return {{x.low, y.low, z.low}, {x.high - x.low, y.high - y.low, z.high - z.low}};
}

/// Values are the box's volume or 0 (the overlap volume), or 1 and 0 (whether the bodies are apart).
class DepletionIntegrand final : public Integrand {
 public:
  enum class What { overlap_volume, freedom };

  /// At one pose, bodies apart or not.
  DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, double ball_radius)
      : DepletionIntegrand(a, b, ball_radius, What::overlap_volume) {
    pose_ = pose;
  }
  /// Over directions and orientations.
  DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, double distance, const OrientationLaw& law,
                     double ball_radius, What what)
      : DepletionIntegrand(a, b, ball_radius, what) {
    is_average_ = true;
    distance_ = distance;
    law_ = law;
  }

  int dimension() const override { return (what_ == What::freedom ? 0 : 3) + (is_average_ ? 2 + law_.dimension() : 0); }
  double scale() const override {
    if (what_ == What::freedom) return 1.0;
    const double edge = 2.0 * (std::min(a_.circumradius(), b_.circumradius()) + ball_.circumradius());
    return edge * edge * edge;
  }
  double relative_rounding() const override { return 0x1p-46; }  // of a box's volume
  /// A point is off by less than 8 u of the pair's reach where it is put into B's frame: a skin of the overlap as
  /// thick.
  double absolute_rounding() const override {
    if (what_ == What::freedom) return 0.0;
    const double radius = std::min(a_.circumradius(), b_.circumradius()) + ball_.circumradius();
    return 4.0 * pi * radius * radius * 0x1p-50 * (a_.reach() + b_.reach() + ball_.reach() + distance_);
  }
  double cost() const override { return 800.0; }

  Doubts evaluate(std::span<const double> points, std::span<double> values) override {
    Doubts doubts;
    const std::size_t n = values.size();
    point_.resize(static_cast<std::size_t>(dimension()));
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t c = 0; c < point_.size(); ++c) point_[c] = points[c * n + k];
      double half_width = 0.0;
      values[k] = value_at(&half_width);
      if (half_width > 0.0) doubts.push_back({k, half_width});
    }
    return doubts;
  }

 private:
  DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, double ball_radius, What what)
      : a_(a), b_(b), ball_(Sphere(ball_radius)), what_(what) {}

  /// Of three proven verdicts: all the volume where they say so, none, or the middle with half of it as the doubt.
  double value_at(double* half_width) {
    std::size_t at = 0;
    Outcome is_free = Outcome::overlap;  // whether there is anything to count
    if (is_average_) {
      // Archimedes: the height of a uniform direction is uniform.
      const double height = point_[0] + point_[0] - 1.0;
      const double across = 2.0 * std::sqrt(point_[0] * (1.0 - point_[0]));
      const SinCos<double> azimuth = sincospi(point_[1] + point_[1]);
      const auto n_law = static_cast<std::size_t>(law_.dimension());
      pose_ = law_.rotation(std::span<const double>(point_).subspan(2, n_law));
      pose_.translation = {distance_ * (across * azimuth.cos), distance_ * (across * azimuth.sin), distance_ * height};
      at = 2 + n_law;
      const Outcome bodies = overlap(a_, b_, Pose::unchecked(pose_)).outcome;
      is_free = bodies == Outcome::overlap    ? Outcome::disjoint
                : bodies == Outcome::disjoint ? Outcome::overlap
                                              : Outcome::undecided;
      if (what_ == What::freedom) return share(1.0, is_free, half_width);
      if (is_free == Outcome::disjoint) return 0.0;
    }
    const OverlapBox box = box_around(a_, b_, pose_, ball_.circumradius());
    if (box.is_empty()) return 0.0;
    const Vec3d p{box.low.x + point_[at] * box.width.x, box.low.y + point_[at + 1] * box.width.y,
                  box.low.z + point_[at + 2] * box.width.z};
    Transformd a_from_ball;
    a_from_ball.translation = p;
    const Outcome in_a = overlap(a_, ball_, Pose::unchecked(a_from_ball)).outcome;
    if (in_a == Outcome::disjoint) return 0.0;
    Transformd ball_from_b = pose_;
    ball_from_b.translation = pose_.translation - p;
    const Outcome in_b = overlap(ball_, b_, Pose::unchecked(ball_from_b)).outcome;
    if (in_b == Outcome::disjoint) return 0.0;
    const bool is_sure = in_a == Outcome::overlap && in_b == Outcome::overlap && is_free == Outcome::overlap;
    return share(box.volume(), is_sure ? Outcome::overlap : Outcome::undecided, half_width);
  }

  static double share(double all, Outcome outcome, double* half_width) {
    if (outcome == Outcome::disjoint) return 0.0;
    if (outcome == Outcome::overlap) return all;
    *half_width = 0.5 * all;
    return 0.5 * all;
  }

  ConvexBody a_, b_, ball_;
  What what_;
  bool is_average_ = false;
  Transformd pose_;
  double distance_ = 0.0;
  OrientationLaw law_;
  std::vector<double> point_;
};

void require_settings(const Body& a, const Body& b, const DepletionSettings& settings) {
  if (!(settings.ball_radius > 0.0 && std::isfinite(settings.ball_radius))) {
    throw UsageError("no radius of a depletant's ball (" + shortest_number(settings.ball_radius) +
                     ") - give one above 0");
  }
  const double reach = a.body.reach() + b.body.reach() + settings.ball_radius;
  if (!(reach < 1e75 && settings.ball_radius > 1e-75)) {
    throw InputError("bodies or balls too large or small for their volumes to be numbers (" + shortest_number(reach) +
                     ") - choose another unit of length");
  }
  if (settings.threads < 0) {
    throw UsageError("a negative number of threads (" + std::to_string(settings.threads) + ") - give 0 for all cores");
  }
}

DepletionValue mean_of(const Body& a, const Body& b, const DepletionSettings& settings, const MakeIntegrand& make) {
  MonteCarloSettings driver;
  driver.seed = settings.seed;
  const unsigned n_cores = std::max(1u, std::thread::hardware_concurrency());
  driver.n_threads = settings.threads > 0 ? settings.threads : static_cast<int>(std::min(n_cores, 1024u));
  driver.stop.trials = settings.trials;
  driver.stop.relative_error = settings.rel_error;
  driver.stop.seconds = settings.seconds;
  driver.stop.max_trials = settings.max_trials;
  if (!settings.trials && !settings.rel_error && !settings.seconds) driver.stop.relative_error = 1e-2;
  require_threads_and_stop_rule(driver);
  driver.integrand = make;
  driver.interrupt = settings.interrupt;
  driver.on_progress = settings.on_progress;
  DepletionValue found;
  found.record = run_monte_carlo(a.body, b.body, driver);
  found.complete = found.record.complete;
  found.value = std::numeric_limits<double>::quiet_NaN();
  found.std_error = std::numeric_limits<double>::infinity();
  if (found.record.tally.n_trials > 0) {
    const VolumeEstimate estimate = volume_estimate(found.record.tally, driver.domain);
    found.value = estimate.excluded_volume;
    found.std_error = estimate.std_error;
  }
  return found;
}

DepletionValue certain(double value) {
  DepletionValue found;
  found.value = value;
  return found;
}

}  // namespace

double overlap_of_balls(double radius_1, double radius_2, double distance) {
  const double sum = radius_1 + radius_2, difference = radius_1 - radius_2;
  if (distance >= sum) return 0.0;
  const double smaller = std::min(radius_1, radius_2);
  if (distance <= std::fabs(difference)) return 4.0 / 3.0 * pi * smaller * smaller * smaller;
  const double gap = sum - distance;
  return pi * gap * gap * (distance * distance + 2.0 * distance * sum - 3.0 * difference * difference) /
         (12.0 * distance);
}

double DepletionAverage::mean_of_free() const {
  return free_share.value > 0.0 ? overlap_volume.value / free_share.value : std::numeric_limits<double>::quiet_NaN();
}

double DepletionAverage::mean_of_free_error() const {
  // Of a ratio of two means, to first order; the two runs share their seed, and their errors might help each other in
  // the worst way.
  const double mean = mean_of_free();
  return overlap_volume.std_error / free_share.value + std::fabs(mean) * free_share.std_error / free_share.value;
}

DepletionAtPose depletion_at(const Body& a, const Body& b, const Pose& a_from_b, const DepletionSettings& settings) {
  require_settings(a, b, settings);
  DepletionAtPose found;
  found.bodies = overlap(a.body, b.body, a_from_b).outcome;
  const OverlapBox box = box_around(a.body, b.body, a_from_b.a_from_b(), settings.ball_radius);
  if (box.is_empty()) return found;  // surely none
  // Of shells that touch to within the box's own margins a bound is all there is to say.
  constexpr double kThin = 0x1p-30;
  const double reach = a.body.reach() + b.body.reach() + settings.ball_radius;
  if (std::min({box.width.x, box.width.y, box.width.z}) < kThin * reach) {
    found.overlap_volume.value = found.overlap_volume.std_error = 0.5 * box.volume();
    return found;
  }
  found.overlap_volume = mean_of(a, b, settings, [&] {
    return std::make_unique<DepletionIntegrand>(a.body, b.body, a_from_b.a_from_b(), settings.ball_radius);
  });
  return found;
}

DepletionAverage depletion_average(const Body& a, const Body& b, double distance, const OrientationLaw& law,
                                   const DepletionSettings& settings) {
  require_settings(a, b, settings);
  if (!(distance >= 0.0 && distance < 1e75)) {
    throw UsageError("no distance (" + shortest_number(distance) + ") - give one from 0 up");
  }
  DepletionAverage found;
  // Beyond both circumspheres, measured from the origins, everything is apart.
  const double reach = (a.body.reach() + b.body.reach()) * (1.0 + 0x1p-40);
  const auto run = [&](DepletionIntegrand::What what) {
    return mean_of(a, b, settings, [&, what] {
      return std::make_unique<DepletionIntegrand>(a.body, b.body, distance, law, settings.ball_radius, what);
    });
  };
  found.free_share = distance > reach ? certain(1.0) : run(DepletionIntegrand::What::freedom);
  if (!(found.free_share.value > 0.0)) return found;  // no orientation was free, or none was drawn
  const bool are_shells_apart = distance > reach + 2.0 * settings.ball_radius * (1.0 + 0x1p-40);
  if (!are_shells_apart) found.overlap_volume = run(DepletionIntegrand::What::overlap_volume);
  return found;
}

}  // namespace vex
