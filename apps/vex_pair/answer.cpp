#include "apps/vex_pair/answer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/query/overlap.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

// No 0 of a result has a sign.
Vec3d without_signed_zeros(const Vec3d& v) { return v + Vec3d{}; }

void set_witnesses(Answer& answer, const Vec3d& normal, const Vec3d& point_a, const Vec3d& point_b) {
  answer.normal = without_signed_zeros(normal);
  answer.point_a = without_signed_zeros(point_a);
  answer.point_b = without_signed_zeros(point_b);
}

Answer contact_answer(const FirstContact& found) {
  Answer answer;
  answer.verdict = found.verdict;
  answer.n_support_calls = found.n_support_calls;
  answer.lower = found.lower;
  answer.upper = found.upper;
  if (found.verdict.outcome != Outcome::overlap) return answer;
  answer.value = found.time;
  set_witnesses(answer, found.normal, found.point_a, found.point_b);
  return answer;
}

}  // namespace

std::string_view name_of_value(Query query, const Answer& answer) {
  switch (query) {
    case Query::overlap: return "";
    case Query::distance: return "distance";
    case Query::depth: return "depth";
    case Query::ray:
    case Query::cast: return "parameter";
    case Query::time_of_impact: return "time";
    case Query::signed_distance:
    case Query::manifold: break;
  }
  return answer.verdict.outcome == Outcome::overlap ? "depth" : "distance";
}

Question::Question(const ConvexBody& a, const ConvexBody& b, const QuerySettings& settings)
    : settings_(settings), a_(a), b_(b) {
  if (settings.query == Query::overlap && settings.margin > 0.0) {
    // On a body without a ball part, if there is one, the sum of two radii is not rounded.
    ConvexBody& wider = a.ball_radius() == 0.0 || b.ball_radius() != 0.0 ? a_ : b_;
    wider = with_margin(wider, settings.margin);
  }
  if (settings.query == Query::ray) {
    ray_origin_body_ = Polytope(std::array{settings.ray_origin}, settings.ray_origin, 0.0);
    ray_on_a_ = cast_ray(a, settings.ray_origin, settings.velocity);
  }
}

Answer Question::answer(const Transformd& a_from_b) const {
  Answer result;
  switch (settings_.query) {
    case Query::overlap: return overlap_answer(a_from_b);
    case Query::ray: return ray_answer(a_from_b);
    case Query::cast: return contact_answer(linear_cast(a_, b_, a_from_b, settings_.velocity));
    case Query::time_of_impact: {
      const RigidMotion motion{settings_.velocity, (std::numbers::pi / 180.0) * settings_.angular_velocity_degrees};
      return contact_answer(time_of_impact(a_, b_, a_from_b, motion));
    }
    case Query::manifold: {
      ContactManifold manifold = contact_manifold(a_, b_, a_from_b, settings_.margin);
      result = separation_answer(manifold.separation);
      result.contacts = std::move(manifold.contacts);
      return result;
    }
    case Query::distance: result = separation_answer(distance(a_, b_, a_from_b)); break;
    case Query::depth: result = separation_answer(penetration_depth(a_, b_, a_from_b)); break;
    case Query::signed_distance: result = separation_answer(vex::signed_distance(a_, b_, a_from_b)); break;
  }
  if (settings_.with_certificate) add_certificate(result, a_from_b);
  return result;
}

Answer Question::overlap_answer(const Transformd& a_from_b) const {
  Answer result;
  const bool with_check = settings_.with_certificate;
  result.verdict = overlap(a_, b_, a_from_b, &result.certificate, kMaxSupportCalls,
                           with_check ? CertificateDetail::full : CertificateDetail::no_witnesses);
  result.n_support_calls = result.certificate.n_support_calls;
  if (result.is_undecided()) {
    result.lower = result.certificate.gap_lower;
    result.upper = result.certificate.gap_upper;
  } else if (with_check) {
    result.check = check_certificate(a_, b_, a_from_b, result.verdict.outcome, result.certificate);
  }
  return result;
}

Answer Question::separation_answer(const Separation& found) const {
  Answer result;
  result.verdict = found.verdict;
  result.n_support_calls = found.n_support_calls;
  const bool either_sign = is_of_either_sign(settings_.query);
  const bool is_depth = settings_.query == Query::depth || (either_sign && found.verdict.outcome == Outcome::overlap);
  result.value = is_depth ? 0.0 - found.signed_distance : found.signed_distance;
  result.lower = is_depth ? 0.0 - found.upper : found.lower;
  result.upper = is_depth ? 0.0 - found.lower : found.upper;
  // A verdict is proven, and then the number has its sign; else the bounds are of both.
  if (!result.is_undecided()) {
    result.lower = std::max(0.0, result.lower);
    result.upper = std::max(0.0, result.upper);
  }
  if (!result.is_undecided() || !either_sign) result.value = std::max(0.0, result.value);
  if (either_sign) result.signed_distance = is_depth ? 0.0 - result.value : result.value;
  if (found.has_witnesses) set_witnesses(result, found.normal, found.point_a, found.point_b);
  return result;
}

// The ray against B as it is placed: its origin stays, a point, and B moves against it. So the pose is not inverted,
// which would round.
Answer Question::ray_answer(const Transformd& a_from_b) const {
  const FirstContact& on_a = ray_on_a_;
  const FirstContact on_b = linear_cast(*ray_origin_body_, b_, a_from_b, -settings_.velocity);
  const bool hits_a = on_a.verdict.outcome == Outcome::overlap, hits_b = on_b.verdict.outcome == Outcome::overlap;
  Answer result;
  result.n_support_calls = on_a.n_support_calls + on_b.n_support_calls;
  // What may be hit first, proven or not, is not hit before its lower bound.
  result.lower = std::min(on_a.lower, on_b.lower);
  result.upper = std::min(on_a.upper, on_b.upper);
  if (hits_a && (!hits_b || on_a.time <= on_b.time)) {
    result.verdict = on_a.verdict;
    result.value = on_a.time;
    result.normal = without_signed_zeros(on_a.normal);
    result.point_a = without_signed_zeros(on_a.point_a);
    result.ray_hit = Answer::RayHit::a;
  } else if (hits_b) {
    result.verdict = on_b.verdict;
    result.value = on_b.time;
    result.normal = without_signed_zeros(-on_b.normal);
    result.point_b = without_signed_zeros(on_b.point_b + on_b.time * settings_.velocity);
    result.ray_hit = Answer::RayHit::b;
  } else if (on_a.verdict.outcome == Outcome::undecided) {
    result.verdict = on_a.verdict;
  } else if (on_b.verdict.outcome == Outcome::undecided) {
    result.verdict = on_b.verdict;
  } else {
    result.verdict = Verdict::disjoint(std::max(on_a.verdict.by, on_b.verdict.by));  // both had to be missed
  }
  return result;
}

// Of the verdict that the query has, as `overlap` finds it.
void Question::add_certificate(Answer& answer, const Transformd& a_from_b) const {
  if (answer.is_undecided()) return;
  overlap(a_, b_, a_from_b, &answer.certificate);
  answer.check = check_certificate(a_, b_, a_from_b, answer.verdict.outcome, answer.certificate);
}

void Counts::add(const Answer& answer) {
  ++n_rows;
  switch (answer.verdict.outcome) {
    case Outcome::disjoint: ++n_disjoint; break;
    case Outcome::overlap: ++n_overlap; break;
    case Outcome::undecided: ++n_undecided; break;
  }
  if (!answer.is_undecided()) ++decided_by[static_cast<std::size_t>(answer.verdict.by)];
  if (answer.check) ++(answer.check->is_proven ? n_reproven : n_not_reproven);
  const double value = answer.signed_distance.value_or(answer.value);
  if (std::isfinite(value)) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
}

void Counts::add_refused() {
  ++n_rows;
  ++n_refused;
}

void Counts::add(const Counts& others) {
  n_rows += others.n_rows;
  n_refused += others.n_refused;
  n_disjoint += others.n_disjoint;
  n_overlap += others.n_overlap;
  n_undecided += others.n_undecided;
  for (std::size_t k = 0; k < decided_by.size(); ++k) decided_by[k] += others.decided_by[k];
  n_reproven += others.n_reproven;
  n_not_reproven += others.n_not_reproven;
  smallest = std::min(smallest, others.smallest);
  largest = std::max(largest, others.largest);
}

}  // namespace vex
