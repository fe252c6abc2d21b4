#include "engine/query/exact/exact_cast.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/query/exact/first_meeting.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

// Digits of the times that are tried, finest first: as many as coordinates and motion leave.
constexpr std::array kTimeDigits = {44, 32, 20, 8};
// Times between the bounds, each half as far from the lower one as that before.
constexpr int kMostTimes = 16;
// Bodies that slide along each other may be as near at every time that is tried, and each answer is exact: after so
// many calls no other time is tried. Where one of contact is found the first one is looked for, whatever that takes.
constexpr int kMostCallsOfTrials = 1 << 10;

/// x + t d without any rounding: none where that is not a double.
std::optional<double> exactly_moved(double x, double t, double d) {
  const double way = t * d, sum = x + way;
  const double of_x = sum - way, of_way = sum - of_x;
  const bool is_exact = std::fma(t, d, -way) == 0.0 && (x - of_x) + (way - of_way) == 0.0;
  return is_exact && std::isfinite(sum) ? std::optional(sum) : std::nullopt;
}
std::optional<Vec3d> exactly_moved(const Vec3d& x, double t, const Vec3d& d) {
  const std::optional<double> to_x = exactly_moved(x.x, t, d.x), to_y = exactly_moved(x.y, t, d.y),
                              to_z = exactly_moved(x.z, t, d.z);
  if (!to_x || !to_y || !to_z) return std::nullopt;
  return Vec3d{*to_x, *to_y, *to_z};
}

class ExactMotion {
 public:
  ExactMotion(const ConvexBody& a, const ConvexBody& b, const Transformd& start, const Vec3d& motion,
              std::vector<Vec3d> vertices_b)
      : a_(a), b_(b), start_(start), motion_(motion), vertices_b_(std::move(vertices_b)) {}

  /// None where a coordinate is rounded, or where nothing is proven.
  std::optional<bool> meets_at(double time) {
    const std::optional<Vec3d> translation = exactly_moved(start_.translation, time, motion_);
    if (!translation) return std::nullopt;
    Transformd pose = start_;
    pose.translation = *translation;
    for (const Vec3d& v : vertices_b_) {
      const std::optional<Vec3d> moved = exactly_moved(start_(v), time, motion_);
      if (!moved || norm_1(pose(v) - *moved) != 0.0) return std::nullopt;
    }
    const OverlapAnswer answer = overlap_answer(a_, b_, Pose::unchecked(pose));
    n_support_calls_ += answer.n_support_calls;
    if (answer.verdict.outcome == Outcome::undecided) return std::nullopt;
    return answer.verdict.outcome == Outcome::overlap;
  }
  int n_support_calls() const { return n_support_calls_; }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  const Transformd& start_;
  Vec3d motion_;
  std::vector<Vec3d> vertices_b_;
  int n_support_calls_ = 0;
};

}  // namespace

ExactCast cast_exactly(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& motion,
                       double lower, double latest, double until) {
  ExactCast result;
  if (!a.is_rounded_polytope() || !b.is_rounded_polytope()) return result;
  const std::optional<PlacedForms> forms = placed_forms(a, b, a_from_b);
  if (!forms) return result;
  if (forms->a.is_polytope() && forms->b.is_polytope()) {
    const FirstMeeting found = first_meeting(*forms, motion, nullptr, until);
    return {found.is_hit && !found.is_late ? Outcome::overlap : Outcome::disjoint, found.lower, found.upper,
            found.n_support_calls};
  }
  latest = std::fmin(latest, until);
  if (!(latest > 0.0 && std::isfinite(latest))) return result;
  ExactMotion exact(a, b, a_from_b, motion, forms->b.points);
  const auto may_try = [&exact] { return exact.n_support_calls() <= kMostCallsOfTrials; };
  for (const int digits : kTimeDigits) {
    if (!may_try()) break;
    const double unit = std::ldexp(1.0, std::ilogb(latest) - digits);
    // The nearest such time, which may be the only one of contact; and others, up to the last.
    double together = std::round(lower / unit) * unit;
    if (together > latest) continue;
    std::optional<bool> meets = exact.meets_at(together);
    if (!meets) continue;
    for (int k = 0; k < kMostTimes && meets && !*meets && may_try(); ++k) {
      together = std::round((lower + std::ldexp(latest - lower, -k)) / unit) * unit;
      if (together > latest) break;
      meets = exact.meets_at(together);
    }
    if (together > latest) continue;
    if (!meets || !*meets) continue;
    result.outcome = Outcome::overlap;
    result.upper = together;
    // The times of contact are an interval: one without, before one with, is before all of them.
    double apart = std::floor(lower / unit) * unit;
    while (together - apart > unit) {
      const double middle = std::round((apart + 0.5 * (together - apart)) / unit) * unit;
      const std::optional<bool> found = middle > apart && middle < together ? exact.meets_at(middle) : std::nullopt;
      if (!found) break;
      (*found ? together : apart) = middle;
      if (*found) result.upper = middle;
    }
    result.lower = std::fmax(lower, apart);
    break;
  }
  result.n_support_calls = exact.n_support_calls();
  return result;
}

}  // namespace vex
