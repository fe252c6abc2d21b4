// The certificate of a verdict: what is enough to prove it again, and the checker that does.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A point of A - B. On a body's curved part it is the exact support point in a direction; on a vertex it is that
/// vertex, with the ball's point in that direction where the body is rounded.
struct Witness {
  Vec3d dir, dir_low;      // the direction dir + dir_low of A's point and of the balls, in A's frame
  Vec3d dir_b, dir_b_low;  // that of B's point, in B's own frame: about the opposite, but no rounding stands between
  Vec3d point_a;           // near the point of A, in A's frame: tells which part of the body is meant
  Vec3d point_b;           // near the point of B, in B's own frame
};
bool is_finite(const Witness& witness);

/// A sum of vectors times powers of two: a direction that no two doubles can tell.
struct ExactVector {
  struct Part {
    Vec3d value;
    int exponent = 0;
  };
  std::vector<Part> parts;

  bool is_any() const { return !parts.empty(); }
};

/// Points of A - B without the balls, which prove how near that comes to the origin or how far it goes around it: up to
/// eight by their hull; or any number by a closed surface of triangles.
struct WitnessHull {
  std::vector<Witness> witnesses;
  std::vector<std::array<std::uint32_t, 3>> faces;  // of witnesses, counter-clockwise seen from outside; or none
};

/// What re-proves a verdict of `overlap`. Everything is in A's frame, lengths in the bodies' units.
///
/// Disjoint: every point of A is behind every point of B along separating_dir + separating_dir_low. Where both bodies
/// are rounded polytopes (ExactForm) and that direction is zero, it is the exact direction that minus the point of the
/// witnesses' hull nearest to the origin has; no double may be near enough.
///
/// Overlap: the convex hull of the witnesses, four or up to six of them, contains the origin; of two rounded polytopes,
/// the hull of the witnesses without the balls comes at least as near to the origin as the sum of the radii.
struct OverlapCertificate {
  Vec3d separating_dir, separating_dir_low;
  std::array<Witness, 6> witnesses{};  // six points are enough for any hull around a point (E. Steinitz, 1913)
  int n_witnesses = 0;

  /// Of an undecided verdict: bounds of the signed gap, the distance where it is positive and minus the penetration
  /// depth where it is negative.
  double gap_lower = -std::numeric_limits<double>::infinity();
  double gap_upper = std::numeric_limits<double>::infinity();

  int n_support_calls = 0;  // support mappings of A - B evaluated by the search, for any verdict
};

/// A verdict and what the search for it left behind; members as in its certificate.
struct OverlapAnswer {
  Verdict verdict;
  int n_support_calls = 0;
  Vec3d separating_dir{}, separating_dir_low{};  // where disjoint
  double gap_lower = -std::numeric_limits<double>::infinity();
  double gap_upper = std::numeric_limits<double>::infinity();
};

/// Whether a certificate proves what is claimed, and if not, what is missing.
struct CertificateCheck {
  bool is_proven = false;
  std::string fault;  // empty where proven
};

/// Proves `claimed` (disjoint or overlap) again from the bodies' exact forms and the certificate alone, in exact
/// arithmetic: rational numbers, square roots enclosed by rational bounds. Uses nothing of the search. Slow: tens of
/// microseconds for boxes, and the number of vertices counts. Not proven where a body has no exact form.
CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                   Outcome claimed, const OverlapCertificate& certificate);

}  // namespace vex
