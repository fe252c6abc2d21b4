#include "engine/query/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/errors.h"
#include "engine/query/expanding_polytope.h"
#include "engine/query/extended_difference.h"
#include "engine/query/nearest_descent.h"
#include "engine/query/placed_forms.h"
#include "engine/query/zonotope.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Goal { signed_distance, distance, depth };

// How near bounds are brought, rounding apart, where no more is asked: of |signed distance| + R_A + R_B. Polytopes end
// by themselves; what is left of curved bodies halves with every other support call.
constexpr double kPolytopeGap = 0x1p-44, kCurvedGap = 0x1p-32;
// Who asks for no more than this wants no digits of a contact, either.
constexpr double kRoughGap = 0x1p-24;

bool are_rounded_polytopes(const ConvexBody& a, const ConvexBody& b) {
  return a.is_rounded_polytope() && b.is_rounded_polytope();
}

// Hulls of polytopes come to an end by themselves, if it takes all of their vertices.
int max_hull_points(const ConvexBody& a, const ConvexBody& b, const SeparationSettings& settings) {
  constexpr int kMost = 1 << 14;
  return are_rounded_polytopes(a, b) && settings.max_support_calls == kMaxSupportCalls ? kMost
                                                                                       : settings.max_support_calls;
}

// --- K = A - B of the bodies' cores, their balls and rolling balls apart

// In double precision.
class CoreDifference {
 public:
  struct Point {
    Vec3d w;      // a - b
    Vec3d a, b;   // of the cores, in A's frame
    Vec3d own_b;  // b in B's frame, without its rolling ball
  };

  CoreDifference(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b)
      : a_(a), b_(b), a_from_b_(a_from_b), rolling_a_(a.rolling_radius()), rolling_b_(b.rolling_radius()) {}

  Point support(const Vec3d& normal) const {
    const Vec3d of_a = a_.core_support(normal);
    const Vec3d of_b = b_.core_support(-a_from_b_.direction_to_b(normal));
    if (has_rolling()) {
      const Vec3d a = of_a - rolling_a_ * normal, b = a_from_b_(of_b) + rolling_b_ * normal;
      return {a - b, a, b, of_b};
    }
    return at(of_a, of_b);
  }
  Point at(const Vec3d& of_a, const Vec3d& of_b) const {
    const Vec3d b = a_from_b_(of_b);
    return {of_a - b, of_a, b, of_b};
  }
  bool is_of(const WarmStart& warm_start) const {
    return a_.is_same_as(warm_start.body_a) && b_.is_same_as(warm_start.body_b);
  }
  // Without its points.
  void remember(WarmStart& warm_start, const Vec3d& dir) const {
    if (!is_of(warm_start)) {
      warm_start.body_a = a_.identity();
      warm_start.body_b = b_.identity();
    }
    warm_start.dir = dir;
    warm_start.n_points = 0;
  }
  bool has_rolling() const { return rolling_a_ > 0.0 || rolling_b_ > 0.0; }

  QueryError<double> error() const {
    QueryError<double> error = query_error(a_, b_, a_from_b_);
    error.support += 8.0 * kUnitRoundoff * (rolling_a_ + rolling_b_);
    return error;
  }
  double radius_a() const { return a_.ball_radius() + rolling_a_; }
  double radius_b() const { return b_.ball_radius() + rolling_b_; }
  Vec3d between_centres() const { return a_from_b_(b_.centre()) - a_.centre(); }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  const Transformd& a_from_b_;
  double rolling_a_, rolling_b_;
};

// In twice the precision, from the exact forms, in the units and about the middles of the local forms.
class ExtendedCore {
 public:
  struct Point {
    Vec3e w;
    Vec3d a, b;  // of the cores, in the bodies' own frames, rounded
  };

  explicit ExtendedCore(const LocalForms& forms) : forms_(forms) {}

  Point support(const Vec3e& normal) const {
    const LocalForms::Farthest a = forms_.farthest_of_a(normal);
    const LocalForms::Farthest b = forms_.farthest_of_b(-normal, forms_.a_from_b().direction_to_b(-normal));
    return {(a.point - b.point) - forms_.a_from_b().translation, a.own, b.own};
  }

 private:
  const LocalForms& forms_;
};

// --- what a search of K found

template <class L, class Point>
struct CoreSeparation {
  Vec3<L> normal;  // unit
  L distance;      // signed, along it
  L lower, upper;  // of the signed distance of the cores, rounding included
  int n_points = 0;
  std::array<Point, 4> points{};
  std::array<L, 4> weights{};
  bool has_normal = false;
  bool is_capped = false;  // more support calls would bring the bounds nearer

  void add(const L& weight, const Point& point) {
    points[static_cast<std::size_t>(n_points)] = point;
    weights[static_cast<std::size_t>(n_points)] = weight;
    ++n_points;
  }
  void take_points(const NearestSimplex<L, Point>& simplex) {
    n_points = 0;
    for (int k = 0; k < simplex.size(); ++k) add(simplex.weight(k), simplex.point(k));
  }
};

template <class L>
struct SearchSettings {
  Goal goal;
  L radii;  // of the balls about the cores
  L size;   // R_A + R_B
  L relative_gap;
  int max_support_calls;
  int max_hull_points;

  // How near to each other bounds shall be for this signed distance of the cores.
  L wanted(const L& signed_distance) const { return relative_gap * (absolute(signed_distance - radii) + size); }
};

// `depth_of_faces`: the answer for cores that overlap, if it is known without a search.
template <class L, class Point, class Difference, class DepthOfFaces>
CoreSeparation<L, Point> search(const Difference& difference, const Vec3<L>& first_dir,
                                const NearestSimplex<L, Point>& simplex, const QueryError<L>& error,
                                const SearchSettings<L>& settings, const DepthOfFaces& depth_of_faces,
                                int& n_support_calls) {
  using Descent = NearestDescent<L, Point>;
  // Of the answer, the balls included.
  const auto wanted = [&settings](const L& signed_distance) { return settings.wanted(signed_distance); };
  const Descent descent = descend_to_origin<L, Point>(
      difference, first_dir, simplex, error, wanted, settings.radii,
      settings.goal == Goal::depth ? DescentGoal::separated : DescentGoal::nearest, settings.max_support_calls);
  n_support_calls += descent.n_support_calls;
  CoreSeparation<L, Point> result;
  result.lower = descent.lower;
  result.upper = descent.upper;
  result.is_capped = descent.end == Descent::End::capped;
  // A descent that ends so near to the origin that no direction separates is one that touches.
  const bool meets = descent.end == Descent::End::around_origin || descent.end == Descent::End::touching ||
                     descent.end == Descent::End::stalled;
  if (!meets || descent.lower > L(0.0)) {
    result.normal = descent.normal;
    result.has_normal = norm_1(result.normal) > L(0.0);
    result.distance = square_root(descent.simplex.square());
    result.take_points(descent.simplex);
    return result;
  }
  // That they overlap is all that is asked.
  const bool meets_by_balls = settings.radii > L(0.0) && descent.upper < settings.radii;
  if (settings.goal == Goal::distance && (meets_by_balls || !(settings.radii > L(0.0)))) return result;
  if (std::optional<CoreSeparation<L, Point>> known = depth_of_faces()) return *known;

  using Polytope = ExpandingPolytope<L, Point, Difference>;
  thread_local PolytopeStore<L, Point> store;
  Polytope polytope(difference, error, settings.max_hull_points, store);
  const typename Polytope::End end =
      polytope.run(descent.simplex, [&wanted](const L& depth) { return wanted(-depth); });
  n_support_calls += polytope.n_support_calls();
  result.is_capped = end == Polytope::End::capped;
  result.normal = polytope.normal();
  result.has_normal = true;
  result.distance = -polytope.height();
  result.lower = larger(result.lower, -polytope.depth_upper());
  if (end == Polytope::End::separated) {
    result.distance = square_root(descent.simplex.square());
    result.take_points(descent.simplex);
    return result;
  }
  Vec3<L> foot;
  if (end != Polytope::End::flat) {
    const L depth_lower = polytope.depth_lower();
    if (-depth_lower < result.upper) result.upper = -depth_lower;
    polytope.visit_foot([&](const L& weight, const Point& point) {
      result.add(weight, point);
      foot = foot + weight * point.w;
    });
  }
  // Of cores that hardly meet, the nearest points are those of the descent.
  const Vec3<L> out = polytope.height() * polytope.normal();
  if (result.n_points == 0 || norm_1(descent.simplex.at() - out) < norm_1(foot - out)) {
    result.take_points(descent.simplex);
  }
  return result;
}

// --- answers

double below(double x) { return std::nextafter(x, -kInfinity); }
double above(double x) { return std::nextafter(x, kInfinity); }

void set_points(Separation& result, const Vec3d& core_a, const Vec3d& core_b, double radius_a, double radius_b) {
  result.point_a = core_a + radius_a * result.normal;
  result.point_b = core_b - radius_b * result.normal;
}

NearestSimplex<double, CoreDifference::Point> warm_simplex(const CoreDifference& difference,
                                                           const WarmStart* warm_start) {
  NearestSimplex<double, CoreDifference::Point> simplex;
  if (warm_start == nullptr || difference.has_rolling() || !difference.is_of(*warm_start)) return simplex;
  for (int k = 0; k < std::min(warm_start->n_points, 4) && !simplex.is_around_origin(); ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    simplex.add(difference.at(warm_start->of_a[i], warm_start->of_b[i]));
  }
  return simplex;
}

// What is asked, in double precision.
struct DoubleQuery {
  CoreDifference difference;
  QueryError<double> error;
  double radius_a, radius_b;
  SearchSettings<double> settings;

  DoubleQuery(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, Goal goal,
              const SeparationSettings& given)
      : difference(a, b, a_from_b),
        error(difference.error()),
        radius_a(difference.radius_a()),
        radius_b(difference.radius_b()),
        settings{goal,
                 radius_a + radius_b,
                 a.circumradius() + b.circumradius(),
                 std::max(given.relative_gap, are_rounded_polytopes(a, b) ? kPolytopeGap : kCurvedGap),
                 given.max_support_calls,
                 max_hull_points(a, b, given)} {}

  // The bodies' answer from that of their cores.
  void take(const Vec3d& normal, double distance, double lower, double upper, const Vec3d& core_a, const Vec3d& core_b,
            Separation& result) const {
    const double rounding = 4.0 * kUnitRoundoff * settings.radii;
    result.lower = lower - settings.radii - rounding;
    result.upper = upper - settings.radii + rounding;
    result.signed_distance = distance - settings.radii;
    result.has_witnesses = true;
    result.normal = normal;
    set_points(result, core_a, core_b, radius_a, radius_b);
  }
  void take(const ZonotopeSeparation& found, Separation& result) const {
    take(found.normal, found.distance, found.lower, found.upper, found.point_a, found.point_b, result);
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
  if (query.settings.goal != Goal::depth) return false;
  const std::optional<ZonotopeSeparation> found = deepest_of_faces(zonotope, query.error);
  if (!found || !(found->lower > query.settings.radii || found->upper < 0.0)) return false;
  query.take(*found, result);
  return true;
}

Separation search_in_double(const DoubleQuery& query, const DifferenceZonotope* zonotope, WarmStart* warm_start,
                            bool& is_capped) {
  using Core = CoreSeparation<double, CoreDifference::Point>;
  const bool is_warm = warm_start != nullptr && norm_1(warm_start->dir) > 0.0 && is_finite(warm_start->dir);
  Vec3d first_dir = is_warm ? warm_start->dir : query.difference.between_centres();
  first_dir = norm_1(first_dir) > 0.0 ? unit_along(first_dir) : Vec3d{0.6, 0.0, 0.8};
  Separation result;
  std::optional<ZonotopeSeparation> deepest;
  const auto depth_of_faces = [&]() -> std::optional<Core> {
    if (zonotope != nullptr) deepest = deepest_of_faces(*zonotope, query.error);
    if (deepest && !(deepest->upper < 0.0)) deepest.reset();
    return deepest ? std::optional<Core>(Core{}) : std::nullopt;
  };
  const Core core =
      search<double, CoreDifference::Point>(query.difference, first_dir, warm_simplex(query.difference, warm_start),
                                            query.error, query.settings, depth_of_faces, result.n_support_calls);
  is_capped = core.is_capped;
  // Of bodies that overlap neither the way out nor the corners of a face make a good start of the next hull.
  if (warm_start != nullptr) query.difference.remember(*warm_start, core.distance > 0.0 ? core.normal : Vec3d{});
  if (deepest) {
    query.take(*deepest, result);
    return result;
  }
  Vec3d core_a, core_b;
  for (int k = 0; k < core.n_points; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    core_a = core_a + core.weights[i] * core.points[i].a;
    core_b = core_b + core.weights[i] * core.points[i].b;
  }
  query.take(core.normal, core.distance, core.lower, core.upper, core_a, core_b, result);
  result.has_witnesses = core.has_normal;
  if (warm_start == nullptr || !core.has_normal) return result;
  if (query.difference.has_rolling() || !(core.distance > 0.0)) return result;
  warm_start->n_points = core.n_points;
  for (int k = 0; k < core.n_points; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    warm_start->of_a[i] = core.points[i].a;
    warm_start->of_b[i] = core.points[i].own_b;
  }
  return result;
}

// In twice the precision.
Separation search_in_extended(const PlacedForms& placed, const ConvexBody& a, const ConvexBody& b, Goal goal,
                              const SeparationSettings& settings, const Vec3d& first_dir) {
  const LocalForms forms(placed);
  const ExtendedCore difference(forms);
  const SearchSettings<Extended> search_settings{
      goal,
      forms.ball_radius(),
      Extended(std::ldexp(a.circumradius() + b.circumradius(), -forms.exponent())),
      Extended(std::max(settings.relative_gap, placed.are_rounded_polytopes() ? 0x1p-60 : kCurvedGap)),
      settings.max_support_calls,
      max_hull_points(a, b, settings)};
  const QueryError<Extended> error{Extended(8.0), Extended(kExtendedError)};
  Separation result;
  const auto no_faces = [] { return std::optional<CoreSeparation<Extended, ExtendedCore::Point>>(); };
  const auto core = search<Extended, ExtendedCore::Point>(difference, broadcast<Extended>(first_dir), {}, error,
                                                          search_settings, no_faces, result.n_support_calls);
  const auto length = [&forms](const Extended& x) { return std::ldexp(x.high, forms.exponent()); };
  result.lower = below(length(core.lower - forms.ball_radius()));
  result.upper = above(length(core.upper - forms.ball_radius()));
  result.signed_distance = length(core.distance - forms.ball_radius());
  result.has_witnesses = core.has_normal;
  result.normal = high_part(core.normal);
  Vec3d core_a, core_b;
  for (int k = 0; k < core.n_points; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    core_a = core_a + core.weights[i].high * core.points[i].a;
    core_b = core_b + core.weights[i].high * placed.a_from_b(core.points[i].b);
  }
  set_points(result, core_a, core_b, a.ball_radius(), b.ball_radius());
  return result;
}

// The verdict, and bounds that agree with it.
void conclude(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, Goal goal, DecidedBy by,
              Separation& result) {
  if (result.lower > 0.0) {
    result.verdict = Verdict::disjoint(by);
  } else if (result.upper < 0.0) {
    result.verdict = Verdict::overlap(by);
  } else {
    OverlapCertificate certificate;
    result.verdict =
        overlap(a, b, Pose::unchecked(a_from_b), &certificate, kMaxSupportCalls, CertificateDetail::no_witnesses);
    result.n_support_calls += certificate.n_support_calls;
    if (result.verdict.outcome == Outcome::disjoint) result.lower = std::max(result.lower, 0.0);
    if (result.verdict.outcome == Outcome::overlap) result.upper = std::min(result.upper, 0.0);
  }
  const bool is_apart = result.verdict.outcome == Outcome::disjoint, meets = result.verdict.outcome == Outcome::overlap;
  if ((goal == Goal::distance && meets) || (goal == Goal::depth && is_apart)) {
    const int n_support_calls = result.n_support_calls;
    const Verdict verdict = result.verdict;
    result = {};
    result.verdict = verdict;
    result.n_support_calls = n_support_calls;
    (meets ? result.upper : result.lower) = 0.0;
    return;
  }
  result.signed_distance = std::max(result.lower, std::min(result.signed_distance, result.upper));
}

// Whether twice the precision has nothing to add: where it is calls that ended a search, or where the bounds are as
// near as asked for and a sign that they leave open is all that they leave open.
bool is_settled(const Separation& found, Goal goal, double wanted, bool is_capped, bool is_rough) {
  if (goal == Goal::depth && found.lower > 0.0) return true;
  if (goal == Goal::distance && found.upper < 0.0) return true;
  if (is_capped) return true;
  return found.upper - found.lower <= wanted && (is_rough || found.lower > 0.0 || found.upper < 0.0);
}

constexpr double kLeastReach = 0x1p-150, kLargestReach = 0x1p150;

Separation separation(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, Goal goal,
                      const SeparationSettings& settings, WarmStart* warm_start) {
  if (!(settings.relative_gap >= 0.0)) {
    throw UsageError("the relative gap of a distance is negative or no number - give one from 0 up");
  }
  const double relative_gap = std::max(settings.relative_gap, are_rounded_polytopes(a, b) ? 0x1p-40 : 1e-9);
  Separation result;
  bool is_capped = false;
  const auto wanted = [&](const Separation& found) {
    return relative_gap * (std::fabs(found.signed_distance) + (a.circumradius() + b.circumradius()));
  };
  const DoubleQuery query(a, b, a_from_b, goal, settings);
  if (query.error.reach > kLeastReach && query.error.reach < kLargestReach) {
    if (a.generators() && b.generators()) {
      const DifferenceZonotope zonotope(*a.generators(), *b.generators(), a_from_b);
      if (!answer_without_search(query, zonotope, result)) {
        result = search_in_double(query, &zonotope, warm_start, is_capped);
      }
    } else {
      result = search_in_double(query, nullptr, warm_start, is_capped);
    }
    if (goal == Goal::distance && !result.has_witnesses) {
      // The cores seem to overlap. If they do, that is all that is asked.
      const int n_support_calls = result.n_support_calls;
      result = {};
      result.n_support_calls = n_support_calls;
      conclude(a, b, a_from_b, goal, DecidedBy::gjk, result);
      if (result.verdict.outcome != Outcome::overlap) {
        result = separation(a, b, a_from_b, Goal::signed_distance, settings, warm_start);
      }
      return result;
    }
    if (is_settled(result, goal, wanted(result), is_capped, settings.relative_gap > kRoughGap)) {
      conclude(a, b, a_from_b, goal, DecidedBy::gjk, result);
      return result;
    }
  }
  if (const std::optional<PlacedForms> placed = placed_forms(a, b, a_from_b)) {
    const Vec3d dir = norm_1(result.normal) > 0.0 ? result.normal : Vec3d{0.6, 0.0, 0.8};
    const Goal both = goal == Goal::distance ? Goal::signed_distance : goal;
    Separation extended = search_in_extended(*placed, a, b, both, settings, dir);
    extended.n_support_calls += result.n_support_calls;
    extended.lower = std::max(extended.lower, result.lower);
    extended.upper = std::min(extended.upper, result.upper);
    result = extended;
    conclude(a, b, a_from_b, goal, DecidedBy::double_double, result);
    return result;
  }
  conclude(a, b, a_from_b, goal, DecidedBy::gjk, result);
  return result;
}

// Bounds that exclude each other, or are no numbers, come from a support mapping that is none: nothing is known then.
Separation trusted(Separation found) {
  if (found.lower <= found.upper) return found;
  Separation nothing;
  nothing.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
  nothing.n_support_calls = found.n_support_calls;
  return nothing;
}

}  // namespace

Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings, WarmStart* warm_start) {
  return trusted(separation(a, b, pose.a_from_b(), Goal::signed_distance, settings, warm_start));
}

Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start) {
  return trusted(separation(a, b, pose.a_from_b(), Goal::distance, settings, warm_start));
}

Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             const SeparationSettings& settings, WarmStart* warm_start) {
  return trusted(separation(a, b, pose.a_from_b(), Goal::depth, settings, warm_start));
}

ConvexBody with_margin(const ConvexBody& body, double margin) { return Inflated<ConvexBody>(body, margin); }

}  // namespace vex
