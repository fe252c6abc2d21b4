// Do two convex bodies share a point?
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/certificate.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Support calls after which a search from one inner point is given up. Random pairs need 3 to 5 and near-touching ones
/// of curved bodies a few dozen; what reaches the cap is reported as such, never answered.
inline constexpr int kMaxSupportCalls = 512;

/// Decides whether A and B, placed by `a_from_b`, share a point; never guesses. No quick verdicts before it.
///
/// R of the pose must be a rotation to within 1e-6. Sizes and coordinates from 1e-45 to 1e45. `certificate`, if given,
/// receives the proof. Undecided where the bodies touch to within rounding (E1: 40 u of the pair's reach, more where
/// the difference of the bodies is a needle or a plate: docs/performance.md has measured widths).
Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                OverlapCertificate* certificate = nullptr, int max_support_calls = kMaxSupportCalls);

/// Proves again what some backend answered: asks `overlap` for the same outcome with its certificate, and the checker
/// for the certificate. Not proven where the engine answers otherwise, which is then said.
CertificateCheck prove_again(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, Outcome claimed);

}  // namespace vex
