// Do two convex bodies share a point?
#pragma once

#include "engine/numeric/pose.h"
#include "engine/query/certificate.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Support calls after which a search from one inner point is given up. Random pairs need 3 to 5 and near-touching ones
/// of curved bodies a few dozen; what reaches the cap is reported as such, never answered.
inline constexpr int kMaxSupportCalls = 512;

/// Decides whether A and B, placed by `pose`, share a point; never guesses. No quick verdicts before it.
///
/// R of the pose must be a rotation to within 1e-6. Sizes are from 1e-300 to 1e300, coordinates any doubles, as long as
/// those of the placed vertices are finite too. Three stages (docs/derivations.md, "What the input is", E1, E14, E15):
/// a search in double precision whose signs are proven; for bodies with curved parts the same in double-double; for
/// polytopes, rounded or not, spheres and capsules, whole numbers, which always decide. Undecided, then, is what has
/// curved parts and touches to within some 1e-26 of the pair's size (docs/stress.md has measured bands), and what has
/// no exact form and touches to within rounding (E1: 40 u of the pair's reach, more where A - B is a needle or a
/// plate). `certificate`, if given, receives the proof; of an undecided verdict bounds of the gap.
Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Pose& pose, OverlapCertificate* certificate = nullptr,
                int max_support_calls = kMaxSupportCalls);

/// The same verdict, with what the search leaves behind at no cost: all of a certificate but its witnesses.
OverlapAnswer overlap_answer(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             int max_support_calls = kMaxSupportCalls);

/// Proves again what some backend answered: asks `overlap` for the same outcome with its certificate, and the checker
/// for the certificate. Not proven where the engine answers otherwise, which is then said.
CertificateCheck prove_again(const ConvexBody& a, const ConvexBody& b, const Pose& pose, Outcome claimed);

}  // namespace vex
