#include "engine/query/exact/extended_overlap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "engine/query/exact/extended_difference.h"
#include "engine/query/overlap.h"
#include "engine/query/search/expanding_polytope.h"
#include "engine/query/search/nearest_descent.h"
#include "engine/query/search/portal_refinement.h"

namespace vex {
namespace {

// Directions that span space, and the weights of inner points.
constexpr std::array<Vec3d, 6> kSpanningDirections = {{{0.6113, 0.4717, 0.6361},
                                                       {-0.7331, 0.2917, 0.4129},
                                                       {0.1733, -0.8311, -0.5297},
                                                       {-0.1237, 0.3119, -0.9419},
                                                       {-0.5171, -0.6173, 0.3371},
                                                       {0.8219, -0.1913, -0.4733}}};
constexpr std::array<std::array<double, 6>, 2> kInnerWeights = {
    {{0.171875, 0.203125, 0.1328125, 0.1484375, 0.1796875, 0.1640625},
     {0.34375, 0.078125, 0.265625, 0.0625, 0.15625, 0.09375}}};

// PointsOfDifference of A - B, each a convex combination of the same support points: the weights add up to 1 exactly.
std::array<Vec3e, kInnerWeights.size()> inner_points(const ExtendedDifference& difference) {
  std::array<Vec3e, kInnerWeights.size()> points;
  for (std::size_t k = 0; k < kSpanningDirections.size(); ++k) {
    const Vec3e w = difference.support(extended(kSpanningDirections[k]));
    for (std::size_t j = 0; j < kInnerWeights.size(); ++j) points[j] = points[j] + Extended(kInnerWeights[j][k]) * w;
  }
  return points;
}

constexpr QueryError<Extended> kError{Extended(8.0), Extended(kExtendedError)};

// What the searches of distances take: A - B, point by point.
struct PointOfDifference {
  Vec3e w;
};
class PointsOfDifference {
 public:
  explicit PointsOfDifference(const ExtendedDifference& difference) : difference_(difference) {}
  PointOfDifference support(const Vec3e& dir) const { return {difference_.support(dir)}; }

 private:
  const ExtendedDifference& difference_;
};

using Hull = ExpandingPolytope<Extended, PointOfDifference, PointsOfDifference>;

// Grows from a few directions of its own, until every face has the origin behind it by more than the points' error.
bool goes_around_origin(Hull& hull) {
  const auto as_soon_as_proven = [](const Extended& distance) {
    return distance > Extended(4.0) * kError.support ? Extended(HUGE_VAL) : Extended(0.0);
  };
  return hull.run({}, as_soon_as_proven) == Hull::End::converged && hull.depth_lower() > Extended(0.0);
}

double distance_of_triangle(const Vec3e& v1, const Vec3e& v2, const Vec3e& v3) {
  NearestSimplex<Extended, PointOfDifference> simplex;
  for (const Vec3e& v : {v1, v2, v3}) simplex.add({v});
  return norm(simplex.at()).high;
}

// What the searches of one query have found out, besides the difference's bound from below.
struct Findings {
  double gap_upper = HUGE_VAL;
  bool is_capped = false;
  int n_support_calls = 0;

  void limit_gap(double distance) { gap_upper = std::min(gap_upper, distance); }
};

// From an inner point: the fastest search, but not of flat differences, nor where the origin is in a plane of symmetry.
PortalResult<Extended> search_portal(const ExtendedDifference& difference, const Vec3e& start, int max_support_calls,
                                     Findings& findings) {
  PortalResult<Extended> found = refine_portal<Extended>(difference, start, kError, max_support_calls);
  findings.n_support_calls += found.n_support_calls;
  if (!found.overlap && !found.disjoint) findings.limit_gap(distance_of_triangle(found.v1, found.v2, found.v3));
  return found;
}

// The nearest point: of any difference, but no proof of an overlap.
void descend_to_nearest(const ExtendedDifference& difference, int max_support_calls, Findings& findings) {
  using Descent = NearestDescent<Extended, PointOfDifference>;
  const auto nearest = [](const Extended&) { return Extended(0.0); };
  const Descent found = descend_to_origin<Extended, PointOfDifference>(
      PointsOfDifference(difference), extended(kSpanningDirections.front()), {}, kError, nearest, Extended(0.0),
      DescentGoal::separated, max_support_calls);
  findings.n_support_calls += found.n_support_calls;
  findings.is_capped = found.end == Descent::End::capped;
  findings.limit_gap(norm(found.simplex.at()).high);
}

// A hull that goes around the origin does so with some 60 points at most; one of a K that the origin is on the rim of
// creeps, and each of its points is dearer than the last one.
constexpr int kMostPointsOfHull = 96;

bool hull_overlaps(const ExtendedDifference& difference, int max_support_calls, Findings& findings) {
  const PointsOfDifference points(difference);
  thread_local PolytopeStore<Extended, PointOfDifference> store;
  const int most = std::min(max_support_calls, kMostPointsOfHull);
  Hull hull(points, kError, most, store);
  const bool overlaps = goes_around_origin(hull);
  findings.n_support_calls += hull.n_support_calls();
  findings.is_capped = !overlaps && hull.n_support_calls() >= most;
  return overlaps;
}

// A gap that is known so well is contact, whatever kept a search going.
constexpr double kContact = 0x1p-55;

// More calls than portals and descents take that close in on the origin as they do on smooth bodies; others, as those
// of two tips that touch, creep, and what they would find a hull finds sooner.
constexpr int kMostCallsOfSearch = 128;

// One after the other until there is a proof, or none can be. Every direction that was looked at may be one of
// disjointness, whatever became of the search.
std::optional<Outcome> decide(const ExtendedDifference& difference, int max_support_calls, Findings& findings) {
  const auto is_apart = [&difference] { return difference.gap_lower() > 0.0; };
  // A difference that hardly reaches beyond the origin has no room for a simplex that holds it by more than a point's
  // error; and where a point of it is as near to the origin, no direction's gap exceeds its error (E15).
  const auto may_overlap = [&difference] { return !(difference.gap_lower() > -2.5 * kExtendedError); };
  const auto may_be_apart = [&findings] { return findings.gap_upper > 1.5 * kExtendedError; };
  findings.n_support_calls += static_cast<int>(kSpanningDirections.size());
  const auto starts = inner_points(difference);
  const int few = std::min(max_support_calls, kMostCallsOfSearch);
  for (const Vec3e& start : starts) {
    const PortalResult<Extended> found = search_portal(difference, start, few, findings);
    if (found.overlap) return Outcome::overlap;
    if (is_apart()) return Outcome::disjoint;
    if (found.disjoint || found.capped || !may_overlap()) break;
  }
  if (may_overlap() || may_be_apart()) descend_to_nearest(difference, few, findings);
  if (is_apart()) return Outcome::disjoint;
  // A difference that ends so near to the origin has no room behind it for the points' error: contact.
  if (difference.gap_lower() > -4.0 * kExtendedError) return std::nullopt;
  if (hull_overlaps(difference, max_support_calls, findings)) return Outcome::overlap;
  if (is_apart()) return Outcome::disjoint;
  return std::nullopt;
}

// The calls of a difference that keeps records, as witnesses.
class Witnesses {
 public:
  Witnesses(const std::vector<ExtendedRecord>& records, OverlapCertificate& certificate,
            const std::function<bool()>& is_proof)
      : records_(records), certificate_(certificate), is_proof_(is_proof) {}

  bool prove(std::span<const std::size_t> calls) const {
    certificate_.n_witnesses = 0;
    for (const std::size_t call : calls) {
      certificate_.witnesses[static_cast<std::size_t>(certificate_.n_witnesses++)] = records_[call].witness;
    }
    return is_proof_();
  }

  std::size_t call_of(const Vec3e& v) const {
    const auto record = std::ranges::find_if(
        records_, [&v](const ExtendedRecord& r) { return r.at.x == v.x && r.at.y == v.y && r.at.z == v.z; });
    return static_cast<std::size_t>(record - records_.begin());
  }

 private:
  const std::vector<ExtendedRecord>& records_;
  OverlapCertificate& certificate_;
  const std::function<bool()>& is_proof_;
};

// A portal with the start v0 of its search is around the origin, and v0 is between the six support points it was made
// of: the line from the portal through the origin to v0 leaves their hull through three of them, so those and the
// portal are around the origin. Often a single one will do.
bool find_witnesses_by_portal(const LocalForms& forms, OverlapCertificate& certificate,
                              const std::function<bool()>& is_proof) {
  std::vector<ExtendedRecord> records;
  const ExtendedDifference difference(forms, &records);
  const Witnesses witnesses(records, certificate, is_proof);
  for (const Vec3e& start : inner_points(difference)) {  // calls 0 to 5
    const PortalResult<Extended> found = refine_portal<Extended>(difference, start, kError, kMaxSupportCalls);
    if (!found.overlap) continue;
    const std::array<std::size_t, 3> portal = {witnesses.call_of(found.v1), witnesses.call_of(found.v2),
                                               witnesses.call_of(found.v3)};
    for (int n = 1; n <= 3; ++n) {
      for (unsigned set = 1; set < (1u << kSpanningDirections.size()); ++set) {
        if (std::popcount(set) != n) continue;
        std::vector<std::size_t> calls(portal.begin(), portal.end());
        for (std::size_t k = 0; k < kSpanningDirections.size(); ++k) {
          if (((set >> k) & 1u) != 0) calls.push_back(k);
        }
        if (witnesses.prove(calls)) return true;
      }
    }
  }
  return false;
}

// The corners of the two faces through which a line through the origin leaves the hull: the origin is between two inner
// points of them, so in the hull of the six, and inside of it unless the line was chosen badly. The checker says.
bool find_witnesses_by_hull(const LocalForms& forms, OverlapCertificate& certificate,
                            const std::function<bool()>& is_proof) {
  std::vector<ExtendedRecord> records;
  const ExtendedDifference difference(forms, &records);
  const Witnesses witnesses(records, certificate, is_proof);
  const PointsOfDifference points(difference);
  PolytopeStore<Extended, PointOfDifference> store;
  Hull hull(points, kError, kMaxSupportCalls, store);
  if (!goes_around_origin(hull)) return false;
  std::vector<Vec3e> lines;
  for (const Vec3d& dir : kSpanningDirections) lines.push_back(extended(dir));
  for (std::size_t k = 1; k < store.points.size(); ++k) {
    lines.push_back(store.points[k].w + Extended(0.37) * store.points[k - 1].w);
    lines.push_back(store.points[k].w);
  }
  for (const Vec3e& line : lines) {
    const Vec3e dir = scaled_to_unit_exponent(line);
    const std::optional<Hull::Corners> front = hull.corners_along(dir), back = hull.corners_along(-dir);
    if (!front || !back) continue;
    std::vector<std::size_t> calls;  // a point of the hull and the record of its call have the same index
    for (const Hull::Corners& corners : {*front, *back}) {
      for (const std::size_t corner : corners) {
        if (std::ranges::find(calls, corner) == calls.end()) calls.push_back(corner);
      }
    }
    if (witnesses.prove(calls)) return true;
  }
  return false;
}

}  // namespace

OverlapAnswer extended_overlap(const PlacedForms& placed, int max_support_calls) {
  const LocalForms forms(placed);
  const ExtendedDifference difference(forms);
  Findings findings;
  const std::optional<Outcome> outcome = decide(difference, max_support_calls, findings);
  OverlapAnswer answer;
  answer.n_support_calls = findings.n_support_calls;
  if (outcome == Outcome::overlap) {
    answer.verdict = Verdict::overlap(DecidedBy::double_double);
  } else if (outcome == Outcome::disjoint) {
    answer.verdict = Verdict::disjoint(DecidedBy::double_double);
    answer.separating_dir = high_part(difference.best_dir());
    answer.separating_dir_low = low_part(difference.best_dir());
  } else {
    const double upper = findings.gap_upper * (1.0 + 0x1p-50) + 2.0 * kExtendedError;
    const bool is_contact = upper - difference.gap_lower() < kContact;
    answer.verdict =
        Verdict::undecided(DecidedBy::double_double, findings.is_capped && !is_contact ? UndecidedReason::iteration_cap
                                                                                       : UndecidedReason::rounding);
    // Lengths of any size again: ldexp rounds, at most, an underflowing one.
    answer.gap_lower = std::ldexp(difference.gap_lower(), forms.exponent());
    answer.gap_upper = std::ldexp(upper, forms.exponent());
  }
  return answer;
}

bool find_witnesses(const PlacedForms& placed, OverlapCertificate& certificate, const std::function<bool()>& is_proof) {
  const LocalForms forms(placed);
  if (find_witnesses_by_portal(forms, certificate, is_proof)) return true;
  if (find_witnesses_by_hull(forms, certificate, is_proof)) return true;
  certificate.n_witnesses = 0;
  return false;
}

}  // namespace vex
