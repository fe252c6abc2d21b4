// The checker of verdicts: small, slow, and apart from the search. It sees the exact forms, the pose and the
// certificate, and shares with the search nothing but whole numbers.
#include "engine/query/certificate.h"

#include <optional>
#include <utility>
#include <vector>

#include "engine/numeric/whole.h"
#include "engine/query/checker/exact_hull.h"
#include "engine/query/checker/exact_pair.h"

namespace vex {
namespace {

using checker::ExactPair;
using checker::RationalPoint;
using whole::Dyadic;
using whole::DyadicVector;
using whole::Integer;
using whole::Vector;

DyadicVector direction_of(const Vec3d& high, const Vec3d& low) { return whole::exactly(high) + whole::exactly(low); }

CertificateCheck failed(std::string fault) { return {false, std::move(fault)}; }

std::vector<DyadicVector> core_points(const ExactPair& pair, const OverlapCertificate& certificate) {
  std::vector<DyadicVector> points;
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    points.push_back(pair.core_point(certificate.witnesses[static_cast<std::size_t>(k)]));
  }
  return points;
}

// Both bodies are points and a ball: everything is rational.
CertificateCheck check_rounded_polytopes(const ExactPair& pair, Outcome claimed,
                                         const OverlapCertificate& certificate) {
  const std::vector<DyadicVector> points = core_points(pair, certificate);
  if (claimed == Outcome::disjoint) {
    int exponent = 0;
    const std::vector<Vector> w = checker::as_whole(points, exponent);
    RationalPoint nearest;
    if (!checker::nearest_of_affine_hull(w, nearest)) return failed("the witnesses define no direction");
    const Vector dir = -nearest.numerator;
    if (!pair.is_separated_by({Dyadic(dir.x, 0), Dyadic(dir.y, 0), Dyadic(dir.z, 0)})) {
      return failed("the direction of the witnesses does not separate the bodies");
    }
    return {true, {}};
  }
  if (checker::comes_within(points, pair.radii())) return {true, {}};
  return failed("the witnesses' hull does not come as near to the origin as the radii");
}

CertificateCheck check_hull(const ExactPair& pair, const OverlapCertificate& certificate) {
  if (certificate.n_witnesses < 4) return failed("an overlap of curved bodies needs four witnesses");
  const Dyadic balls = pair.radii();
  std::vector<DyadicVector> points = core_points(pair, certificate);
  for (std::size_t k = 0; k < points.size() && whole::sign(balls) > 0; ++k) {
    const DyadicVector dir = direction_of(certificate.witnesses[k].dir, certificate.witnesses[k].dir_low);
    const Dyadic length = checker::root_from_above(dot(dir, dir));
    if (whole::sign(length) == 0) return failed("a witness has no direction");
    points[k] =
        points[k] + DyadicVector{balls * checker::quotient(dir.x, length), balls * checker::quotient(dir.y, length),
                                 balls * checker::quotient(dir.z, length)};
  }
  const Dyadic margin = pair.margin() + balls * Dyadic(1, 16 - checker::kBits);
  if (!checker::holds_ball(points, margin)) return failed("the origin is not proven to be in the witnesses' hull");
  return {true, {}};
}

}  // namespace

bool is_finite(const Witness& witness) {
  for (const Vec3d& v :
       {witness.dir, witness.dir_low, witness.dir_b, witness.dir_b_low, witness.point_a, witness.point_b}) {
    if (!is_finite(v)) return false;
  }
  return true;
}

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                   Outcome claimed, const OverlapCertificate& certificate) {
  if (claimed != Outcome::disjoint && claimed != Outcome::overlap) return failed("the verdict claims nothing");
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, a_from_b, fault);
  if (!pair) return failed(fault);
  if (!is_finite(certificate.separating_dir) || !is_finite(certificate.separating_dir_low)) {
    return failed("the separating direction is not finite");
  }
  const DyadicVector dir = direction_of(certificate.separating_dir, certificate.separating_dir_low);
  const bool has_dir = whole::sign(dot(dir, dir)) > 0;
  if (claimed == Outcome::disjoint && has_dir) {
    if (pair->is_separated_by(dir)) return {true, {}};
    return failed("the direction does not separate the bodies");
  }
  if (certificate.n_witnesses < 1 || certificate.n_witnesses > 6) return failed("there are no witnesses");
  for (const Witness& witness : certificate.witnesses) {
    if (!is_finite(witness)) return failed("a witness is not finite");
  }
  if (pair->are_rounded_polytopes()) return check_rounded_polytopes(*pair, claimed, certificate);
  if (claimed == Outcome::disjoint) return failed("there is no separating direction");
  return check_hull(*pair, certificate);
}

}  // namespace vex
