#include "engine/query/search/parting_start.h"

#include <optional>

namespace vex {
namespace {

// Of edges that cross the normal turns, and each look takes a part of the gap that has opened before it.
constexpr int kMostLooks = 16;
constexpr double kLeastGrowth = 1.25;

}  // namespace

bool PartingStart::find_forms() {
  if (forms_) return true;
  std::optional<PlacedForms> placed = placed_forms(a_, b_, a_from_b_, turns_);
  // The sweep bounds what bends of the cores that the bodies tell, so these must be the forms' cores.
  if (!placed || placed->a.ball_radius != a_.ball_radius() || placed->b.ball_radius != b_.ball_radius()) return false;
  forms_ = std::make_unique<Forms>(std::move(*placed));
  return true;
}

double PartingStart::shown_until(double from, double last, const Vec3d& dir) {
  if (!(norm_1(dir) > 0.0)) return from;
  const Vec3d trial = scaled_to_unit_exponent(dir), along = (1.0 / norm(trial)) * trial;
  const double until = sweep_.apart_until(from, last, along, forms_->local);
  if (record_ != nullptr && until > from) record_->push_back({from, until, along});
  return until;
}

double PartingStart::apart_until(double from, double last, const Vec3d& normal) {
  if (!may_look_ || n_looks_ == kMostLooks || !(from < sweep_.short_time()) || !find_forms()) return from;
  double until = n_looks_++ == 0 ? shown_until(from, last, start_.separating_dir) : from;
  until = shown_until(until, last, normal);
  // Another look is worth its price while bodies part, and not where they come together.
  may_look_ = until > kLeastGrowth * from;
  return until;
}

}  // namespace vex
