// Proof of a distance or a depth, apart from the search that found it.
#pragma once

#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/separation.h"

namespace vex {

/// The least positive double: a bound that proves a verdict where it is 0 by itself.
inline constexpr double kLeastGap = 0x1p-1074;

/// What re-proves a `Separation`.
///
/// The verdict: by the bounds where they have one sign, else by `sign`; where that proves nothing, as where a distance
/// is asked with more calls than an overlap, by `dir` or the hull for a bound of +-kLeastGap. `lower`: along `dir` the
/// bodies are apart by that much, or less deep in each other than minus that. `upper`: the hull comes as near to the
/// origin as the sum of the radii and `upper`; where that sum is negative it goes around the ball of minus that. The
/// points: those of A in `near_a` have `point_a` near their hull, as far apart as the radius of the ball, and so has B.
struct SeparationCertificate {
  OverlapCertificate sign;
  ExactVector dir;
  WitnessHull hull;
  std::vector<Witness> near_a, near_b;
};

/// How near the points of an answer are promised to be to their bodies and to each other: at most this, and what is
/// lost where coordinates are rounded far from a frame's origin.
double promised_accuracy(const ConvexBody& a, const ConvexBody& b, const Separation& found);

/// Finds a certificate for an answer of `signed_distance`, `distance` or `penetration_depth`, in twice the precision:
/// slow, some tenths of a millisecond. What is not found is left out, and the checker says so.
SeparationCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Separation& found);

/// Proves verdict, bounds and points again, in exact arithmetic, from the bodies' exact forms and the certificate
/// alone. Of an undecided answer the bounds.
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const Separation& claimed, const SeparationCertificate& certificate);

}  // namespace vex
