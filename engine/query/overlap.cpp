#include "engine/query/overlap.h"

#include "engine/query/portal_refinement.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

// The searches start from these points of K, offsets from the difference of the centres in units of the sum of inradii.
// They are arbitrary but for having no symmetry: started at the centres themselves, the origin would lie on an edge or
// a face of the simplex in every symmetric placement (always, for two balls), where nothing can be proven. The first is
// close to the centres, which costs fewest support calls; the others are for placements that are degenerate seen from
// the first.
constexpr std::array<Vec3d, 3> kInnerPoints = {
    {{0.01173, 0.02311, 0.03137}, {0.1173, 0.2311, -0.3137}, {-0.2719, 0.1531, -0.0917}}};

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
  for (const Vec3d& offset : kInnerPoints) {
    const PortalResult<double> found =
        refine_portal(difference, between_centres + inradii * offset, error, max_support_calls);
    n_support_calls += found.n_support_calls;
    if (certificate != nullptr) {
      *certificate = {found.separating_dir, {found.v0, found.v1, found.v2, found.v3}, n_support_calls};
    }
    if (found.disjoint) return Verdict::disjoint(DecidedBy::gjk);
    if (found.overlap) return Verdict::overlap(DecidedBy::gjk);
    capped = capped || found.capped;
    if (inradii == 0.0) break;
  }
  return Verdict::undecided(DecidedBy::gjk, capped ? UndecidedReason::iteration_cap : UndecidedReason::rounding);
}

}  // namespace vex
