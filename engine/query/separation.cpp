#include "engine/query/separation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/errors.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/search/separation_search.h"
#include "engine/query/separation_certificate.h"
#include "engine/query/separation_from_guess.h"
#include "engine/query/separation_with_verdict.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

// Who asks for no more than this wants no digits of a contact, either.
constexpr double kRoughGap = 0x1p-24;
// In twice the precision, of curved bodies whose bounds are near enough.
constexpr int kMostCallsForSign = 96;

// This part of |signed distance| + R_A + R_B.
double part_of_size(const SeparationQuery& query, double relative_gap, const Separation& found) {
  return relative_gap * (std::fabs(found.signed_distance) + query.circumradii());
}

// A verdict alone, where that is all there is to tell.
Separation nothing_but(const Verdict& verdict, int n_support_calls) {
  Separation result;
  result.verdict = verdict;
  result.n_support_calls = n_support_calls;
  return result;
}

// Adds the verdict, and makes the bounds agree with it. What is found stays where the caller wants it: a copy of its
// 144 bytes right after they were written takes some 6 ns, a fourteenth of the shortest query. `placed`: the forms
// where they are there already, or null.
void conclude(const SeparationQuery& query, DecidedBy by, Separation& result, std::optional<OverlapAnswer>& known,
              const PlacedForms* placed = nullptr) {
  if (result.lower > 0.0) {
    result.verdict = Verdict::disjoint(by);
  } else if (result.upper < 0.0) {
    result.verdict = Verdict::overlap(by);
  } else if (query.asks_sign) {
    if (!known) {
      known = placed != nullptr ? overlap_answer(query.a, query.b, *placed)
                                : overlap_answer(query.a, query.b, Pose::unchecked(query.a_from_b));
      result.n_support_calls += known->n_support_calls;
    }
    result.verdict = known->verdict;
    if (result.verdict.outcome == Outcome::disjoint) result.lower = std::max(result.lower, 0.0);
    if (result.verdict.outcome == Outcome::overlap) result.upper = std::min(result.upper, 0.0);
  }
  const bool is_apart = result.verdict.outcome == Outcome::disjoint, meets = result.verdict.outcome == Outcome::overlap;
  if ((query.goal == SeparationGoal::distance && meets) || (query.goal == SeparationGoal::depth && is_apart)) {
    result = nothing_but(result.verdict, result.n_support_calls);
    (meets ? result.upper : result.lower) = 0.0;
  } else {
    result.signed_distance = std::max(result.lower, std::min(result.signed_distance, result.upper));
  }
}

// Whether twice the precision has nothing to add: where it is calls that ended a search, or where the bounds are as
// near as asked for and a sign that they leave open is all that they leave open.
bool is_settled(const SeparationQuery& query, const SearchedSeparation& searched, const Separation& found,
                double wanted) {
  if (searched.is_out_of_range) return false;
  if (query.goal == SeparationGoal::distance && found.lower > query.settings.max_distance) return true;
  if (query.goal == SeparationGoal::depth && found.lower > 0.0) return true;
  if (query.goal == SeparationGoal::distance && found.upper < 0.0) return true;
  if (!(found.upper - found.lower <= wanted)) return searched.is_capped && !searched.is_coarse;
  if (query.settings.relative_gap > kRoughGap) return true;
  // Where the bounds are near enough, points and normal may not go together, as of bodies that hardly touch, nor the
  // normal with the distance.
  const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
  if (found.has_witnesses && (dot(off, off) > wanted * wanted || searched.missing > wanted)) return false;
  return !query.asks_sign || found.lower > 0.0 || found.upper < 0.0;
}

// What twice the precision finds beside what double precision has found. `wanted`: how near bounds shall be.
Separation extended_beside(const SeparationQuery& query, const PlacedForms& placed, const Separation& in_double,
                           double wanted) {
  SeparationSettings settings = query.settings;
  // Of curved bodies that touch, bounds that are near enough leave nothing open but the sign: a search for nearer ones
  // would go on for as long as it may.
  if (in_double.upper - in_double.lower <= wanted && !query.are_rounded_polytopes()) {
    settings.max_support_calls = std::min(query.settings.max_support_calls, kMostCallsForSign);
  }
  const bool is_of_both = query.goal == SeparationGoal::distance;
  const SeparationQuery extended{query.a, query.b, query.a_from_b,
                                 is_of_both ? SeparationGoal::signed_distance : query.goal, settings};
  const Vec3d first_dir = norm_1(in_double.normal) > 0.0 ? in_double.normal : kAnyUnitVector;
  const Separation found = search_in_extended(extended, placed, first_dir);
  // A search that was cut short for the sign may know the way less well than the first one did.
  Separation result = in_double.has_witnesses && in_double.lower - found.lower > wanted ? in_double : found;
  result.lower = std::max(found.lower, in_double.lower);
  result.upper = std::min(found.upper, in_double.upper);
  result.n_support_calls = found.n_support_calls + in_double.n_support_calls;
  return result;
}

// How near the bounds were asked to be, or are promised to be.
double asked_width(const SeparationQuery& query, const Separation& found) {
  return part_of_size(query, std::max(query.settings.relative_gap, query.usual_gap()), found);
}

// How far the points are from where they belong, opposite each other along the normal and as far apart as is said,
// beyond rounding.
double points_off(const SeparationQuery& query, const Separation& found) {
  const double coordinates = norm_1(found.point_a) + norm_1(found.point_b) + norm_1(query.a_from_b.translation);
  const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
  return safe_norm(off) - 16.0 * kUnitRoundoff * coordinates;
}

// By how much less the bodies are apart along the normal than is said, beyond rounding. `searched`, if given, may know
// it.
double missing_along_normal(const SeparationQuery& query, Separation& found, const SearchedSeparation* searched) {
  if (searched != nullptr && searched->tells_missing) {
    return searched->missing + (found.signed_distance - searched->signed_distance);
  }
  const Transformd& a_from_b = query.a_from_b;
  const Vec3d of_a = query.a.support(found.normal);
  const Vec3d of_b = a_from_b(query.b.support(a_from_b.direction_to_b(-found.normal)));
  found.n_support_calls += 2;
  const double rounding = 16.0 * kUnitRoundoff * (norm_1(of_a) + norm_1(of_b) + norm_1(a_from_b.translation));
  return found.signed_distance - dot(found.normal, of_b - of_a) - rounding;
}

// Of an answer a part of which is off by more than was promised, as `check_certificate` takes it, which hangs on how
// near the bounds are. They may be nearer than was asked for, where the lower one is from an earlier direction than the
// answer's normal or the verdict has moved one: then it is lowered by what is missing, so that all of the answer goes
// together. Not where the better one is needed: it may be all that parts the bodies, or what ended the search.
bool is_kept_by_lower_bound(const SeparationQuery& query, Separation& found, double off) {
  const double lower = found.upper - off - part_of_size(query, 0x1p-47, found);
  const bool is_cut = query.goal == SeparationGoal::distance && found.lower > query.settings.max_distance;
  if (is_cut || (found.lower >= 0.0 && !(lower > 0.0))) return false;
  if (!(found.upper - lower <= asked_width(query, found))) return false;  // also where it is no number
  found.lower = std::fmin(found.lower, lower);
  return true;
}

// Whether points or normal are worse than promised: of a search with few digits or that was cut short, the lower bound
// may be from another direction than that of its nearest points, these need not be opposite each other, and the verdict
// may have moved the value from them.
bool is_worse_than_promised(const SeparationQuery& query, Separation& found,
                            const SearchedSeparation* searched = nullptr) {
  if (!found.has_witnesses) return false;
  const double promised = promised_accuracy(query.a, query.b, found);
  const auto is_kept = [&](double off) { return off <= promised || is_kept_by_lower_bound(query, found, off); };
  return !is_kept(points_off(query, found)) || !is_kept(missing_along_normal(query, found, searched));
}

Separation separation(const SeparationQuery& query, WarmStart* warm_start, std::optional<OverlapAnswer>& known) {
  Separation found;
  const SearchedSeparation searched = search_in_double(query, warm_start, found);
  if (query.goal == SeparationGoal::distance && !found.has_witnesses && !searched.is_out_of_range) {
    // The cores seem to overlap. If they do, that is all that is asked.
    found = nothing_but({}, found.n_support_calls);
    conclude(query, DecidedBy::gjk, found, known);
    if (found.verdict.outcome == Outcome::overlap) return found;
    const SeparationGoal of_both = SeparationGoal::signed_distance;
    found = separation({query.a, query.b, query.a_from_b, of_both, query.settings, query.guess}, warm_start, known);
    return found;
  }
  const double wanted = part_of_size(query, query.settled_gap(), found);
  const bool is_coarse = query.settings.relative_gap > query.usual_gap();
  if (is_settled(query, searched, found, wanted)) {
    conclude(query, DecidedBy::gjk, found, known);
    if (is_coarse) found.is_rough = is_worse_than_promised(query, found, &searched);
    return found;
  }
  const std::optional<PlacedForms> placed = placed_forms(query.a, query.b, query.a_from_b);
  if (placed) {
    found = extended_beside(query, *placed, found, wanted);
    conclude(query, DecidedBy::double_double, found, known, &*placed);
  } else {
    conclude(query, DecidedBy::gjk, found, known);
  }
  if (!placed || is_coarse) found.is_rough = is_worse_than_promised(query, found);
  return found;
}

Separation answer_of(const SeparationQuery& query, WarmStart* warm_start, std::optional<OverlapAnswer>& known) {
  require_usable(query.settings);
  Separation found = separation(query, warm_start, known);
  if (!(found.lower <= found.upper)) {
    // Bounds that exclude each other, or are no numbers, come from a support mapping that is none.
    found = nothing_but(Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding), found.n_support_calls);
    return found;
  }
  found.is_rough = found.has_witnesses && (found.is_rough || !(found.upper - found.lower <= asked_width(query, found)));
  const bool is_cut_short = query.settings.max_support_calls < kMaxSupportCalls;
  if (is_cut_short && !found.is_rough) found.is_rough = is_worse_than_promised(query, found);
  return found;
}
Separation answer_of(const SeparationQuery& query, WarmStart* warm_start) {
  std::optional<OverlapAnswer> none;
  return answer_of(query, warm_start, none);
}

}  // namespace

void refuse(const SeparationSettings& settings) {
  if (!(settings.relative_gap >= 0.0)) {
    throw UsageError("the relative gap of a distance is negative or no number - give one from 0 up");
  }
  if (!(settings.max_distance >= 0.0)) {
    throw UsageError("the largest distance of interest is negative or no number - give one from 0 up");
  }
  throw UsageError("a distance has no support calls - give one at least");
}

Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings, WarmStart* warm_start) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::signed_distance, settings}, warm_start);
}
Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           std::optional<OverlapAnswer>& overlap) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::signed_distance, {}}, nullptr, overlap);
}

Separation distance_of_any_sign(const ConvexBody& a, const ConvexBody& b, const Pose& pose) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::signed_distance, {}, nullptr, false}, nullptr);
}

Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::distance, settings}, warm_start);
}
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start, std::optional<OverlapAnswer>& overlap) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::distance, settings}, warm_start, overlap);
}

Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings, const NearestGuess& guess) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::signed_distance, settings, &guess}, nullptr);
}
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    const NearestGuess& guess) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::distance, settings, &guess}, nullptr);
}

Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             const SeparationSettings& settings, WarmStart* warm_start) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::depth, settings}, warm_start);
}
Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             std::optional<OverlapAnswer>& overlap) {
  return answer_of({a, b, pose.a_from_b(), SeparationGoal::depth, {}}, nullptr, overlap);
}

ConvexBody with_margin(const ConvexBody& body, double margin) { return Inflated<ConvexBody>(body, margin); }

}  // namespace vex
