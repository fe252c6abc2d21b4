#include "engine/query/search/overlap_filter.h"

#include <array>
#include <cmath>

#include "engine/query/search/difference.h"
#include "engine/query/search/portal_refinement.h"

namespace vex {
namespace {

// The searches start inside K, at points that are arbitrary but for having no symmetry: started at the difference of
// the centres itself, the origin would lie on an edge or a face of the simplex in every symmetric placement (always,
// for two balls), where nothing can be proven.

// The first is kStartOffset. The others are for placements that are degenerate seen from the first, and for bodies
// without a ball inside: the mean of the centres and of support points in four directions that span space, with these
// weights.
constexpr std::array<Vec3d, 4> kDirections = {
    {{0.6113, 0.4717, 0.6361}, {-0.7331, 0.2917, 0.4129}, {0.1733, -0.8311, -0.5297}, {-0.1237, 0.3119, -0.9419}}};
constexpr std::array<std::array<double, 4>, 2> kWeights = {
    {{0.0411, 0.0829, 0.1171, 0.0587}, {0.1931, 0.0677, 0.0331, 0.1327}}};

// A convex combination of points of K: in K to the rounding that E1 counts for its first point.
Vec3d inner_point(const Difference& difference, const Vec3d& between_centres, const std::array<double, 4>& weights) {
  Vec3d point = between_centres;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    point = point + weights[k] * (difference.support(kDirections[k]) - between_centres);
  }
  return point;
}

// tests/bench compiles this file once more without the proofs, to measure what they cost.
#ifdef VEX_FILTER_WITHOUT_PROOFS
constexpr bool kProven = false;
#else
constexpr bool kProven = true;
#endif

FilterResult filter(const Difference& difference, const Vec3d& between_centres, double inradii,
                    const QueryError<double>& error, int max_support_calls) {
  FilterResult result;
  bool is_capped = false;
  for (std::size_t attempt = 0; attempt <= kWeights.size(); ++attempt) {
    Vec3d start = between_centres + inradii * kStartOffset;
    if (attempt > 0) {
      start = inner_point(difference, between_centres, kWeights[attempt - 1]);
      result.n_support_calls += static_cast<int>(kDirections.size());
    }
    const PortalResult<double> found =
        refine_portal<double, Difference, kProven>(difference, start, error, max_support_calls);
    result.n_support_calls += found.n_support_calls;
    if (found.disjoint) {
      result.verdict = Verdict::disjoint(DecidedBy::gjk);
      result.separating_dir = found.separating_dir;
      return result;
    }
    if (found.overlap) {
      result.verdict = Verdict::overlap(DecidedBy::gjk);
      return result;
    }
    is_capped = is_capped || found.capped;
  }
  result.verdict =
      Verdict::undecided(DecidedBy::gjk, is_capped ? UndecidedReason::iteration_cap : UndecidedReason::rounding);
  return result;
}

}  // namespace

FilterResult filter_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                            int max_support_calls) {
  QueryError<double> error = query_error(a, b, a_from_b);
  if (!(error.reach > kLeastLength && error.reach < kLargestLength)) {
    return {Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding), {}, 0};
  }
  const double scale = is_usual(error) ? 1.0 : std::ldexp(1.0, -std::ilogb(error.reach));
  error = {scale * error.reach, scale * error.support};
  const Vec3d between_centres = scale * (a.centre() - a_from_b(b.centre()));
  return filter(Difference(a, b, a_from_b, scale), between_centres, scale * (a.inradius() + b.inradius()), error,
                max_support_calls);
}

}  // namespace vex
