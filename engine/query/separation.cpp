#include "engine/query/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/errors.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/search/core_difference.h"
#include "engine/query/search/core_search.h"
#include "engine/query/search/way_out.h"
#include "engine/query/search/zonotope.h"
#include "engine/query/separation_with_verdict.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How near bounds are brought, rounding apart, where no more is asked: of |signed distance| + R_A + R_B. Polytopes end
// by themselves; what is left of curved bodies halves with every other support call.
constexpr double kPolytopeGap = 0x1p-44, kCurvedGap = 0x1p-32;
// Who asks for no more than this wants no digits of a contact, either.
constexpr double kRoughGap = 0x1p-24;
// In twice the precision, of curved bodies whose bounds are near enough.
constexpr int kMostCallsForSign = 96;

bool are_rounded_polytopes(const ConvexBody& a, const ConvexBody& b) {
  return a.is_rounded_polytope() && b.is_rounded_polytope();
}

// Hulls of polytopes come to an end by themselves, if it takes all of their vertices.
int max_hull_points(const ConvexBody& a, const ConvexBody& b, const SeparationSettings& settings) {
  constexpr int kMost = 1 << 14;
  return are_rounded_polytopes(a, b) && settings.max_support_calls == kMaxSupportCalls ? kMost
                                                                                       : settings.max_support_calls;
}

// What bounds are asked to be near to, of |signed distance| + R_A + R_B.
double relative_gap_of(const ConvexBody& a, const ConvexBody& b, const SeparationSettings& settings) {
  return std::max(settings.relative_gap, are_rounded_polytopes(a, b) ? 0x1p-40 : 0x1p-31);
}

// --- answers

double below(double x) { return std::nextafter(x, -kInfinity); }
double above(double x) { return std::nextafter(x, kInfinity); }

// Points of the cores; B's also in its own frame.
struct CorePoints {
  Vec3d a, b, own_b;

  void add(double weight, const CorePoints& points) {
    a = a + weight * points.a;
    b = b + weight * points.b;
    own_b = own_b + weight * points.own_b;
  }
};

void set_points(Separation& result, const Transformd& a_from_b, const CorePoints& cores, double radius_a,
                double radius_b) {
  result.point_a = cores.a + radius_a * result.normal;
  result.point_b = cores.b - radius_b * result.normal;
  result.point_b_in_b = cores.own_b - radius_b * a_from_b.direction_to_b(result.normal);
}

// Where rounding makes faces of its own, a hull of more points than these is no better.
constexpr int kCoarseHullPoints = 32;

// What is asked, in double precision.
struct DoubleQuery {
  const ConvexBody& a;
  const ConvexBody& b;
  const Transformd& a_from_b;
  CoreDifference difference;
  QueryError<double> error;
  double radius_a, radius_b;
  // What rounding alone leaves between bounds is more than was asked for, as of bodies far from the origins of their
  // frames: a search in double precision shows a direction to begin with, and no more.
  bool is_coarse;
  CoreSearchSettings<double> settings;

  DoubleQuery(const ConvexBody& a_in, const ConvexBody& b_in, const Transformd& a_from_b_in, SeparationGoal goal,
              const SeparationSettings& given)
      : a(a_in),
        b(b_in),
        a_from_b(a_from_b_in),
        difference(a_in, b_in, a_from_b_in),
        error(difference.error()),
        radius_a(difference.radius_a()),
        radius_b(difference.radius_b()),
        is_coarse(4.0 * error.support > relative_gap_of(a, b, given) * (a.circumradius() + b.circumradius())),
        settings{goal,
                 radius_a + radius_b,
                 a.circumradius() + b.circumradius(),
                 std::max(given.relative_gap, are_rounded_polytopes(a, b) ? kPolytopeGap : kCurvedGap),
                 given.max_support_calls,
                 is_coarse ? std::min(kCoarseHullPoints, given.max_support_calls) : max_hull_points(a, b, given),
                 given.max_distance} {}

  // The bodies' answer from that of their cores, but for the points.
  void take(const Vec3d& normal, double distance, double lower, double upper, Separation& result) const {
    const double rounding = 4.0 * kUnitRoundoff * settings.radii;
    result.lower = lower - settings.radii - rounding;
    result.upper = upper - settings.radii + rounding;
    result.signed_distance = distance - settings.radii;
    result.has_witnesses = true;
    result.normal = normal;
  }
  void take(const Vec3d& normal, double distance, double lower, double upper, const CorePoints& cores,
            Separation& result) const {
    take(normal, distance, lower, upper, result);
    set_points(result, a_from_b, cores, radius_a, radius_b);
  }
  void take(const ZonotopeSeparation& found, Separation& result) const {
    take(found.normal, found.distance, found.lower, found.upper, {found.point_a, found.point_b, found.own_point_b},
         result);
  }
};

// Of zonotopes, where that needs no search.
bool answer_without_search(const DoubleQuery& query, const DifferenceZonotope& zonotope, Separation& result) {
  if (zonotope.n_vectors <= 2) {
    const std::optional<ZonotopeSeparation> found = nearest_of_segments(zonotope, query.error);
    if (!found || found->upper - found->lower > 4.0 * query.error.support + query.settings.wanted(found->distance)) {
      return false;
    }
    query.take(*found, result);
    return true;
  }
  if (query.settings.goal != SeparationGoal::depth) return false;
  const std::optional<ZonotopeSeparation> found = deepest_of_faces(zonotope, query.error);
  if (!found || !(found->lower > query.settings.radii || found->upper < 0.0)) return false;
  query.take(*found, result);
  return true;
}

struct Searched {
  Separation separation;
  bool is_capped = false;
  double missing = 0.0;  // of the distance, in what the normal alone shows
};

Searched search_in_double(const DoubleQuery& query, const DifferenceZonotope* zonotope, WarmStart* warm_start) {
  const CoreDifference& difference = query.difference;
  const Vec3d warm_dir = CoreDifference::dir_of(warm_start);
  Vec3d first_dir = norm_1(warm_dir) > 0.0 && is_finite(warm_dir) ? warm_dir : difference.between_centres();
  first_dir = norm_1(first_dir) > 0.0 ? unit_along(first_dir) : Vec3d{0.6, 0.0, 0.8};
  CoreSearch<double, CoreDifference::Point, CoreDifference> search(difference, query.error, query.settings, first_dir,
                                                                   difference.simplex_of(warm_start));
  Separation result;
  if (search.wants_depth()) {
    if (zonotope != nullptr) {
      const std::optional<ZonotopeSeparation> deepest = deepest_of_faces(*zonotope, query.error);
      if (deepest && deepest->upper < 0.0) {
        // Of bodies that overlap neither the way out nor the corners of a face make a good start of the next hull.
        if (warm_start != nullptr) difference.remember(*warm_start, {});
        query.take(*deepest, result);
        result.n_support_calls = search.n_support_calls();
        return {result};
      }
    }
    search.find_depth();
  }
  const CoreSeparation<double, CoreDifference::Point>& core = search.found();
  if (warm_start != nullptr) difference.remember(*warm_start, core.distance > 0.0 ? core.normal : Vec3d{});
  CorePoints cores;
  for (int k = 0; k < core.n_points; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    cores.add(core.weights[i], {core.points[i].a, core.points[i].b, core.points[i].own_b});
  }
  query.take(core.normal, core.distance, core.lower, core.upper, cores, result);
  result.has_witnesses = core.has_normal;
  result.n_support_calls = search.n_support_calls();
  if (core.is_capped && search.wants_depth() && core.lower > -HUGE_VAL) {
    const double slack = 2.0 * query.error.support;
    const WayOut way = shorter_way_out(query.a, query.b, query.a_from_b, difference, core.normal, -core.distance,
                                       query.settings.wanted(core.distance));
    result.n_support_calls += way.n_support_calls;
    if (way.is_found) {
      query.take(way.normal, -way.height, std::fmax(core.lower, -way.height - slack), core.upper, result);
      result.point_a = way.point_a;
      result.point_b = way.point_b;
      result.point_b_in_b = way.point_b_in_b;
    }
  }
  const bool is_good_start = core.has_normal && core.distance > 0.0;
  for (int k = 0; warm_start != nullptr && is_good_start && k < core.n_points; ++k) {
    difference.remember_point(*warm_start, core.points[static_cast<std::size_t>(k)]);
  }
  return {result, core.is_capped, core.missing};
}

// In twice the precision.
Separation search_in_extended(const PlacedForms& placed, const ConvexBody& a, const ConvexBody& b, SeparationGoal goal,
                              const SeparationSettings& settings, const Vec3d& first_dir) {
  const LocalForms forms(placed);
  const ExtendedCore difference(forms);
  const CoreSearchSettings<Extended> search_settings{
      goal,
      forms.ball_radius(),
      Extended(std::ldexp(a.circumradius() + b.circumradius(), -forms.exponent())),
      Extended(std::max(settings.relative_gap, placed.are_rounded_polytopes() ? 0x1p-60 : kCurvedGap)),
      settings.max_support_calls,
      max_hull_points(a, b, settings),
      Extended(std::ldexp(settings.max_distance, -forms.exponent()))};
  const QueryError<Extended> error{Extended(8.0), Extended(kExtendedError)};
  CoreSearch<Extended, ExtendedCore::Point, ExtendedCore> search(difference, error, search_settings,
                                                                 broadcast<Extended>(first_dir), {});
  if (search.wants_depth()) search.find_depth();
  const CoreSeparation<Extended, ExtendedCore::Point>& core = search.found();
  Separation result;
  result.n_support_calls = search.n_support_calls();
  const auto length = [&forms](const Extended& x) { return std::ldexp(x.high, forms.exponent()); };
  result.lower = below(length(core.lower - forms.ball_radius()));
  result.upper = above(length(core.upper - forms.ball_radius()));
  result.signed_distance = length(core.distance - forms.ball_radius());
  result.has_witnesses = core.has_normal;
  result.normal = high_part(core.normal);
  CorePoints cores;
  for (int k = 0; k < core.n_points; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    const Vec3d& own_b = core.points[i].b;
    cores.add(core.weights[i].high, {core.points[i].a, placed.a_from_b(own_b), own_b});
  }
  set_points(result, placed.a_from_b, cores, a.ball_radius(), b.ball_radius());
  return result;
}

// A verdict alone, where that is all there is to tell.
Separation nothing_but(const Verdict& verdict, int n_support_calls) {
  Separation result;
  result.verdict = verdict;
  result.n_support_calls = n_support_calls;
  return result;
}

// With the verdict, and bounds that agree with it.
Separation concluded(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, SeparationGoal goal,
                     DecidedBy by, Separation found, std::optional<OverlapAnswer>& known) {
  if (found.lower > 0.0) {
    found.verdict = Verdict::disjoint(by);
  } else if (found.upper < 0.0) {
    found.verdict = Verdict::overlap(by);
  } else {
    if (!known) {
      known = overlap_answer(a, b, Pose::unchecked(a_from_b));
      found.n_support_calls += known->n_support_calls;
    }
    found.verdict = known->verdict;
    if (found.verdict.outcome == Outcome::disjoint) found.lower = std::max(found.lower, 0.0);
    if (found.verdict.outcome == Outcome::overlap) found.upper = std::min(found.upper, 0.0);
  }
  const bool is_apart = found.verdict.outcome == Outcome::disjoint, meets = found.verdict.outcome == Outcome::overlap;
  if ((goal == SeparationGoal::distance && meets) || (goal == SeparationGoal::depth && is_apart)) {
    Separation result = nothing_but(found.verdict, found.n_support_calls);
    (meets ? result.upper : result.lower) = 0.0;
    return result;
  }
  found.signed_distance = std::max(found.lower, std::min(found.signed_distance, found.upper));
  return found;
}

// Whether twice the precision has nothing to add: where it is calls that ended a search, or where the bounds are as
// near as asked for and a sign that they leave open is all that they leave open.
bool is_settled(const Searched& searched, SeparationGoal goal, double wanted, double max_distance, bool is_rough,
                bool is_coarse) {
  const Separation& found = searched.separation;
  if (goal == SeparationGoal::distance && found.lower > max_distance) return true;
  if (goal == SeparationGoal::depth && found.lower > 0.0) return true;
  if (goal == SeparationGoal::distance && found.upper < 0.0) return true;
  if (!(found.upper - found.lower <= wanted)) return searched.is_capped && !is_coarse;
  if (is_rough) return true;
  // Where the bounds are near enough, points and normal may not go together, as of bodies that hardly touch, nor the
  // normal with the distance.
  const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
  if (found.has_witnesses && (dot(off, off) > wanted * wanted || searched.missing > wanted)) return false;
  return found.lower > 0.0 || found.upper < 0.0;
}

Searched first_answer(const DoubleQuery& query, const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                      WarmStart* warm_start) {
  if (!a.generators() || !b.generators()) return search_in_double(query, nullptr, warm_start);
  const DifferenceZonotope zonotope(*a.generators(), *b.generators(), a_from_b);
  Searched without_search;
  if (answer_without_search(query, zonotope, without_search.separation)) return without_search;
  return search_in_double(query, &zonotope, warm_start);
}

Separation separation(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, SeparationGoal goal,
                      const SeparationSettings& settings, WarmStart* warm_start, std::optional<OverlapAnswer>& known) {
  if (!(settings.relative_gap >= 0.0)) {
    throw UsageError("the relative gap of a distance is negative or no number - give one from 0 up");
  }
  if (!(settings.max_distance >= 0.0)) {
    throw UsageError("the largest distance of interest is negative or no number - give one from 0 up");
  }
  const double relative_gap = relative_gap_of(a, b, settings);
  const auto wanted = [&](const Separation& found) {
    return relative_gap * (std::fabs(found.signed_distance) + (a.circumradius() + b.circumradius()));
  };
  Separation in_double;
  const DoubleQuery query(a, b, a_from_b, goal, settings);
  if (is_usual(query.error)) {
    const Searched found = first_answer(query, a, b, a_from_b, warm_start);
    in_double = found.separation;
    if (goal == SeparationGoal::distance && !in_double.has_witnesses) {
      // The cores seem to overlap. If they do, that is all that is asked.
      const Separation seen =
          concluded(a, b, a_from_b, goal, DecidedBy::gjk, nothing_but({}, in_double.n_support_calls), known);
      if (seen.verdict.outcome == Outcome::overlap) return seen;
      return separation(a, b, a_from_b, SeparationGoal::signed_distance, settings, warm_start, known);
    }
    if (is_settled(found, goal, wanted(in_double), settings.max_distance, settings.relative_gap > kRoughGap,
                   query.is_coarse)) {
      return concluded(a, b, a_from_b, goal, DecidedBy::gjk, in_double, known);
    }
  }
  const std::optional<PlacedForms> placed = placed_forms(a, b, a_from_b);
  if (!placed) return concluded(a, b, a_from_b, goal, DecidedBy::gjk, in_double, known);
  const Vec3d dir = norm_1(in_double.normal) > 0.0 ? in_double.normal : Vec3d{0.6, 0.0, 0.8};
  const SeparationGoal both = goal == SeparationGoal::distance ? SeparationGoal::signed_distance : goal;
  // Of curved bodies that touch, bounds that are near enough leave nothing open but the sign: a search for nearer ones
  // would go on for as long as it may.
  SeparationSettings in_extended = settings;
  const bool is_near_enough = in_double.upper - in_double.lower <= wanted(in_double);
  if (is_near_enough && !placed->are_rounded_polytopes()) {
    in_extended.max_support_calls = std::min(settings.max_support_calls, kMostCallsForSign);
  }
  Separation extended = search_in_extended(*placed, a, b, both, in_extended, dir);
  extended.n_support_calls += in_double.n_support_calls;
  // A search that was cut short for the sign may know the way less well than the first one did.
  if (in_double.has_witnesses && in_double.lower - extended.lower > wanted(in_double)) {
    extended.has_witnesses = true;
    extended.signed_distance = in_double.signed_distance;
    extended.normal = in_double.normal;
    extended.point_a = in_double.point_a;
    extended.point_b = in_double.point_b;
    extended.point_b_in_b = in_double.point_b_in_b;
  }
  extended.lower = std::max(extended.lower, in_double.lower);
  extended.upper = std::min(extended.upper, in_double.upper);
  return concluded(a, b, a_from_b, goal, DecidedBy::double_double, extended, known);
}

// Whether the bodies are as far apart along the normal as is said, and so are the points, to `accuracy`.
bool points_show_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Separation& found,
                          double accuracy) {
  const Vec3d of_a = a.support(found.normal), of_b = a_from_b(b.support(a_from_b.direction_to_b(-found.normal)));
  const double rounding = 16.0 * kUnitRoundoff * (norm_1(of_a) + norm_1(of_b) + norm_1(a_from_b.translation));
  if (!(dot(found.normal, of_b - of_a) >= found.signed_distance - accuracy - rounding)) return false;
  const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
  return safe_norm(off) <= accuracy + rounding;
}

// Bounds that exclude each other, or are no numbers, come from a support mapping that is none: nothing is known then.
Separation trusted(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                   const SeparationSettings& settings, Separation found) {
  if (found.lower <= found.upper) {
    const double size = std::fabs(found.signed_distance) + (a.circumradius() + b.circumradius());
    const double promised = std::max(settings.relative_gap, are_rounded_polytopes(a, b) ? 1e-12 : 1e-9);
    found.is_rough = found.has_witnesses && !(found.upper - found.lower <= promised * size);
    // A search that was cut short may have its lower bound from another direction than that of its nearest points, and
    // these not opposite each other.
    if (found.has_witnesses && !found.is_rough && settings.max_support_calls < kMaxSupportCalls) {
      found.is_rough = !points_show_distance(a, b, a_from_b, found, promised * size);
      found.n_support_calls += 2;
    }
    return found;
  }
  return nothing_but(Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding), found.n_support_calls);
}

Separation answer_of(const ConvexBody& a, const ConvexBody& b, const Pose& pose, SeparationGoal goal,
                     const SeparationSettings& settings, WarmStart* warm_start, std::optional<OverlapAnswer>& known) {
  const Transformd& a_from_b = pose.a_from_b();
  return trusted(a, b, a_from_b, settings, separation(a, b, a_from_b, goal, settings, warm_start, known));
}
Separation answer_of(const ConvexBody& a, const ConvexBody& b, const Pose& pose, SeparationGoal goal,
                     const SeparationSettings& settings, WarmStart* warm_start) {
  std::optional<OverlapAnswer> none;
  return answer_of(a, b, pose, goal, settings, warm_start, none);
}

}  // namespace

Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings, WarmStart* warm_start) {
  return answer_of(a, b, pose, SeparationGoal::signed_distance, settings, warm_start);
}
Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           std::optional<OverlapAnswer>& overlap) {
  return answer_of(a, b, pose, SeparationGoal::signed_distance, {}, nullptr, overlap);
}

Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start) {
  return answer_of(a, b, pose, SeparationGoal::distance, settings, warm_start);
}
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start, std::optional<OverlapAnswer>& overlap) {
  return answer_of(a, b, pose, SeparationGoal::distance, settings, warm_start, overlap);
}

Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             const SeparationSettings& settings, WarmStart* warm_start) {
  return answer_of(a, b, pose, SeparationGoal::depth, settings, warm_start);
}
Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             std::optional<OverlapAnswer>& overlap) {
  return answer_of(a, b, pose, SeparationGoal::depth, {}, nullptr, overlap);
}

ConvexBody with_margin(const ConvexBody& body, double margin) { return Inflated<ConvexBody>(body, margin); }

}  // namespace vex
