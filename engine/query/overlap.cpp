#include "engine/query/overlap.h"

#include "engine/query/portal_refinement.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

// The searches start inside K, at points that are arbitrary but for having no symmetry: started at the difference of
// the centres itself, the origin would lie on an edge or a face of the simplex in every symmetric placement (always,
// for two balls), where nothing can be proven.

// The first is close to the centres, which costs fewest support calls: an offset in units of the sum of inradii.
constexpr Vec3d kFirstOffset{0.01173, 0.02311, 0.03137};

// The others are for placements that are degenerate seen from the first, and for bodies without a ball inside: the mean
// of the centres and of support points in four directions that span space, with these weights.
constexpr std::array<Vec3d, 4> kDirections = {
    {{0.6113, 0.4717, 0.6361}, {-0.7331, 0.2917, 0.4129}, {0.1733, -0.8311, -0.5297}, {-0.1237, 0.3119, -0.9419}}};
constexpr std::array<std::array<double, 4>, 2> kWeights = {
    {{0.0411, 0.0829, 0.1171, 0.0587}, {0.1931, 0.0677, 0.0331, 0.1327}}};

// A convex combination of points of K: in K to the rounding that E1 counts for its first point.
template <class Difference>
Vec3d inner_point(const Difference& difference, const Vec3d& between_centres, const std::array<double, 4>& weights) {
  Vec3d point = between_centres;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    point = point + weights[k] * (difference.support(kDirections[k]) - between_centres);
  }
  return point;
}

}  // namespace

Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, OverlapCertificate* certificate,
                int max_support_calls) {
  const Posed<ConvexBody, double> b_in_a(b, a_from_b);
  const MinkowskiDifference difference(a, b_in_a);
  const QueryError<double> error = query_error(a, b, a_from_b);
  const Vec3d between_centres = a.centre() - a_from_b(b.centre());
  const double inradii = a.inradius() + b.inradius();

  bool capped = false;
  int n_support_calls = 0;
  for (std::size_t attempt = 0; attempt <= kWeights.size(); ++attempt) {
    Vec3d start = between_centres + inradii * kFirstOffset;
    if (attempt > 0) {
      start = inner_point(difference, between_centres, kWeights[attempt - 1]);
      n_support_calls += static_cast<int>(kDirections.size());
    }
    const PortalResult<double> found = refine_portal(difference, start, error, max_support_calls);
    n_support_calls += found.n_support_calls;
    if (certificate != nullptr) {
      certificate->separating_dir = found.separating_dir;
      certificate->n_support_calls = n_support_calls;
    }
    if (found.disjoint) return Verdict::disjoint(DecidedBy::gjk);
    if (found.overlap) return Verdict::overlap(DecidedBy::gjk);
    capped = capped || found.capped;
  }
  return Verdict::undecided(DecidedBy::gjk, capped ? UndecidedReason::iteration_cap : UndecidedReason::rounding);
}

}  // namespace vex
