#include "apps/vex_pair/answer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

// No 0 of an answer has a sign: which one it has is chance, and readers compare texts.
void drop_sign(double& number) {
  if (number == 0.0) number = 0.0;
}

void drop_signs(Vec3d& v) {
  for (double* const coordinate : {&v.x, &v.y, &v.z}) drop_sign(*coordinate);
}

void drop_signs_of_zeros(Answer& answer) {
  for (double* const number : {&answer.value, &answer.lower, &answer.upper}) drop_sign(*number);
  if (answer.signed_distance) drop_sign(*answer.signed_distance);
  for (std::optional<Vec3d>* const v : {&answer.normal, &answer.point_a, &answer.point_b}) {
    if (*v) drop_signs(**v);
  }
  for (ContactManifold::Contact& contact : answer.contacts) {
    drop_signs(contact.point_a);
    drop_signs(contact.point_b);
    drop_sign(contact.signed_distance);
  }
  OverlapCertificate& certificate = answer.certificate;
  for (Vec3d* const v : {&certificate.separating_dir, &certificate.separating_dir_low}) drop_signs(*v);
  for (Witness& witness : certificate.witnesses) {
    for (Vec3d* const v :
         {&witness.dir, &witness.dir_low, &witness.dir_b, &witness.dir_b_low, &witness.point_a, &witness.point_b}) {
      drop_signs(*v);
    }
  }
}

void require_in_reach(const Vec3d& translation) {
  for (const double coordinate : {translation.x, translation.y, translation.z}) {
    if (std::fabs(coordinate) <= kFarthest) continue;
    throw InputError("a translation out of range (" + short_number(coordinate) + ", and " + short_number(kFarthest) +
                     " is the most) - choose another unit of length");
  }
}

// A search that overflows ends at the largest double.
void require_finite(Query query, const Answer& answer) {
  // The bound from below of an undecided answer, for a contact later than any double is none that is claimed.
  const double latest = std::numeric_limits<double>::max();
  const bool is_late = answer.verdict.outcome == Outcome::overlap ? !(answer.upper < latest)
                                                                  : answer.is_undecided() && !(answer.lower < latest);
  if (is_of_motion(query) && is_late) {
    throw InputError("a contact so late that its time overflows (the " + std::string(name_of_value(query, answer)) +
                     " is not below " + short_number(latest, 3) + ") - give a faster motion");
  }
  bool is_told = is_of_motion(query) || query == Query::overlap || std::isfinite(answer.value);
  for (const std::optional<Vec3d>* const v : {&answer.normal, &answer.point_a, &answer.point_b}) {
    if (*v && !is_finite(**v)) is_told = false;
  }
  if (is_told) return;
  throw InputError("a result that overflows (the " + std::string(name_of_value(query, answer)) + " of --query " +
                   std::string(name_of(query)) + ") - choose another unit of length");
}

void set_witnesses(Answer& answer, const Vec3d& normal, const Vec3d& point_a, const Vec3d& point_b) {
  answer.normal = normal;
  answer.point_a = point_a;
  answer.point_b = point_b;
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
    : settings_(settings), a_(a), b_(b), with_margin_(a, b, settings.query == Query::overlap ? settings.margin : 0.0) {
  if (settings.query == Query::ray) {
    ray_origin_body_ = Polytope(std::array{settings.ray_origin}, settings.ray_origin, 0.0);
    ray_on_a_ = cast_ray(a, settings.ray_origin, settings.velocity, settings.until);
  }
}

Answer Question::answer(const Transformd& a_from_b) const {
  if (settings_.query != Query::overlap) require_in_reach(a_from_b.translation);
  Answer result = answer_of_query(a_from_b);
  require_finite(settings_.query, result);
  drop_signs_of_zeros(result);
  return result;
}

Answer Question::answer_of_query(const Transformd& a_from_b) const {
  Answer result;
  switch (settings_.query) {
    case Query::overlap: return overlap_answer(a_from_b);
    case Query::ray: return ray_answer(a_from_b);
    case Query::cast:
      return contact_answer_of(linear_cast(a_, b_, a_from_b, settings_.velocity, settings_.until), a_from_b,
                               settings_.velocity);
    case Query::time_of_impact: return impact_answer(a_from_b);
    case Query::manifold: {
      thread_local ManifoldMemory memory;
      ContactManifold manifold;
      contact_manifold(a_, b_, a_from_b, {.margin = settings_.margin, .four_at_most = settings_.four_at_most}, memory,
                       manifold);
      result = separation_answer(manifold.separation);
      if (settings_.with_certificate) {
        ManifoldCertificate certificate = certify(a_, b_, a_from_b, manifold);
        result.check = check_certificate(a_, b_, a_from_b, manifold, certificate, settings_.margin);
        result.query_certificate = std::move(certificate);
      }
      result.contacts = std::move(manifold.contacts);
      return result;
    }
    case Query::distance:
    case Query::depth:
    case Query::signed_distance: break;
  }
  const Separation found = settings_.query == Query::distance
                               ? distance(a_, b_, a_from_b, {.max_distance = settings_.max_distance})
                           : settings_.query == Query::depth ? penetration_depth(a_, b_, a_from_b)
                                                             : vex::signed_distance(a_, b_, a_from_b);
  result = separation_answer(found);
  if (settings_.with_certificate) {
    SeparationCertificate certificate = certify(a_, b_, a_from_b, found);
    result.check = check_certificate(a_, b_, a_from_b, found, certificate);
    result.query_certificate = std::move(certificate);
  }
  return result;
}

Answer Question::impact_answer(const Transformd& a_from_b) const {
  constexpr double kRadians = std::numbers::pi / 180.0;
  const RigidMotion of_a{settings_.velocity_a, kRadians * settings_.angular_velocity_a_degrees};
  const RigidMotion of_b{settings_.velocity, kRadians * settings_.angular_velocity_degrees};
  if (norm_1(of_a.velocity) + norm_1(of_a.angular_velocity) == 0.0) {
    return contact_answer_of(time_of_impact(a_, b_, a_from_b, of_b, settings_.until), a_from_b, of_b);
  }
  const FirstContact found = time_of_impact(a_, b_, a_from_b, of_a, of_b, settings_.until);
  Answer result = contact_answer(found);
  if (!settings_.with_certificate) return result;
  ContactCertificate certificate = certify(a_, b_, a_from_b, of_a, of_b, found, settings_.until);
  result.check = check_certificate(a_, b_, a_from_b, of_a, of_b, found, certificate, settings_.until);
  result.query_certificate = std::move(certificate);
  return result;
}

template <class Motion>
Answer Question::contact_answer_of(const FirstContact& found, const Transformd& a_from_b, const Motion& motion) const {
  Answer result = contact_answer(found);
  if (!settings_.with_certificate) return result;
  ContactCertificate certificate = certify(a_, b_, a_from_b, motion, found, settings_.until);
  result.check = check_certificate(a_, b_, a_from_b, motion, found, certificate, settings_.until);
  result.query_certificate = std::move(certificate);
  return result;
}

// The gap is at most the margin if the narrow pair overlaps, and larger if the wide one is disjoint; else their
// verdicts still bound it.
Answer Question::overlap_answer(const Transformd& a_from_b) const {
  Answer narrow = overlap_of(with_margin_.narrow(), a_from_b);
  if (!with_margin_.is_rounded() || narrow.verdict.outcome == Outcome::overlap) return narrow;
  Answer wide = overlap_of(with_margin_.wide(), a_from_b);
  wide.n_support_calls += narrow.n_support_calls;
  if (wide.verdict.outcome == Outcome::disjoint) return wide;
  Answer result;
  result.verdict = Verdict::undecided(DecidedBy::exact, UndecidedReason::rounding);
  for (const Answer* const part : {&narrow, &wide}) {
    if (part->is_undecided()) result.verdict = part->verdict;
  }
  result.lower = narrow.is_undecided() ? narrow.lower : with_margin_.narrow().least;
  result.upper = wide.is_undecided() ? wide.upper : with_margin_.wide().most;
  result.n_support_calls = wide.n_support_calls;
  return result;
}

Answer Question::overlap_of(const WidenedPair& pair, const Transformd& a_from_b) const {
  const OverlapAnswer found = vex::overlap_answer(pair.a, pair.b, a_from_b);
  Answer result;
  result.verdict = found.verdict;
  result.n_support_calls = found.n_support_calls;
  if (result.is_undecided()) {
    // Of the widened bodies, which are nearer to each other by the margin.
    result.lower = found.gap_lower;
    result.upper = found.gap_upper;
    if (pair.most > 0.0) {
      result.lower = std::nextafter(result.lower + pair.least, -HUGE_VAL);
      result.upper = std::nextafter(result.upper + pair.most, HUGE_VAL);
    }
  } else if (settings_.with_certificate) {
    overlap(pair.a, pair.b, a_from_b, &result.certificate);
    result.check = check_certificate(pair.a, pair.b, a_from_b, result.verdict.outcome, result.certificate);
  }
  return result;
}

Answer Question::separation_answer(const Separation& found) const {
  Answer result;
  result.verdict = found.verdict;
  result.n_support_calls = found.n_support_calls;
  result.is_rough = found.is_rough;
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
  const FirstContact on_b = linear_cast(*ray_origin_body_, b_, a_from_b, -settings_.velocity, settings_.until);
  const bool hits_a = on_a.verdict.outcome == Outcome::overlap, hits_b = on_b.verdict.outcome == Outcome::overlap;
  Answer result;
  result.n_support_calls = on_a.n_support_calls + on_b.n_support_calls;
  // What may be hit first, proven or not, is not hit before its lower bound.
  result.lower = std::min(on_a.lower, on_b.lower);
  result.upper = std::min(on_a.upper, on_b.upper);
  if (hits_a && (!hits_b || on_a.time <= on_b.time)) {
    result.verdict = on_a.verdict;
    result.value = on_a.time;
    result.normal = on_a.normal;
    result.point_a = on_a.point_a;
    result.ray_hit = on_a.upper < on_b.lower ? Answer::RayHit::a : Answer::RayHit::either;
  } else if (hits_b) {
    result.verdict = on_b.verdict;
    result.value = on_b.time;
    result.normal = -on_b.normal;
    result.point_b = on_b.point_b + on_b.time * settings_.velocity;
    result.ray_hit = on_b.upper < on_a.lower ? Answer::RayHit::b : Answer::RayHit::either;
  } else if (on_a.verdict.outcome == Outcome::undecided) {
    result.verdict = on_a.verdict;
  } else if (on_b.verdict.outcome == Outcome::undecided) {
    result.verdict = on_b.verdict;
  } else {
    result.verdict = Verdict::disjoint(std::max(on_a.verdict.by, on_b.verdict.by));  // both had to be missed
  }
  if (settings_.with_certificate) {
    RayCertificate certificate{certify_ray(a_, settings_.ray_origin, settings_.velocity, on_a, settings_.until),
                               certify(*ray_origin_body_, b_, a_from_b, -settings_.velocity, on_b, settings_.until)};
    result.check =
        check_ray_certificate(a_, settings_.ray_origin, settings_.velocity, on_a, certificate.of_a, settings_.until);
    if (result.check->is_proven) {
      result.check = check_certificate(*ray_origin_body_, b_, a_from_b, -settings_.velocity, on_b, certificate.of_b,
                                       settings_.until);
    }
    result.query_certificate = std::move(certificate);
  }
  return result;
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
