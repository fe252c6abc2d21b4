#include "engine/query/extended_overlap.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/query/expanding_hull.h"
#include "engine/query/extended_difference.h"
#include "engine/query/portal_refinement.h"

namespace vex {
namespace {

Vec3e extended(const Vec3d& v) { return broadcast<Extended>(v); }

// What flat differences are thickened by, in the forms' units: far above the rounding of a search, far below 1e-14 of
// the bodies.
constexpr double kThickness = 0x1p-56;

// Directions that span space, and the weights of inner points.
constexpr std::array<Vec3d, 6> kDirections = {{{0.6113, 0.4717, 0.6361},
                                               {-0.7331, 0.2917, 0.4129},
                                               {0.1733, -0.8311, -0.5297},
                                               {-0.1237, 0.3119, -0.9419},
                                               {-0.5171, -0.6173, 0.3371},
                                               {0.8219, -0.1913, -0.4733}}};
constexpr std::array<std::array<double, 6>, 2> kWeights = {
    {{0.171875, 0.203125, 0.1328125, 0.1484375, 0.1796875, 0.1640625},
     {0.34375, 0.078125, 0.265625, 0.0625, 0.15625, 0.09375}}};

// Points of A - B, each a convex combination of the same support points: the weights add up to 1 exactly.
std::array<Vec3e, kWeights.size()> inner_points(const ExtendedDifference& difference) {
  std::array<Vec3e, kWeights.size()> points;
  for (std::size_t k = 0; k < kDirections.size(); ++k) {
    const Vec3e w = difference.support(extended(kDirections[k]));
    for (std::size_t j = 0; j < kWeights.size(); ++j) points[j] = points[j] + Extended(kWeights[j][k]) * w;
  }
  return points;
}

// The distance from the origin of a point of the triangle, as near as doubles find one: any is an upper bound.
double distance_of_triangle(const Vec3e& v1, const Vec3e& v2, const Vec3e& v3) {
  const auto distance_at = [&](double s, double t) {
    const Vec3e p = v1 + (Extended(s) * (v2 - v1) + Extended(t) * (v3 - v1));
    return norm(p).high;
  };
  // The projection into the plane, clipped to the triangle.
  const Vec3e e = v2 - v1, f = v3 - v1;
  const Extended ee = dot(e, e), ef = dot(e, f), ff = dot(f, f);
  const Extended e1 = -dot(e, v1), f1 = -dot(f, v1);
  const Extended determinant = ee * ff - ef * ef;
  double best = std::min({distance_at(0.0, 0.0), distance_at(1.0, 0.0), distance_at(0.0, 1.0)});
  const auto consider = [&](double s, double t) {
    if (!(s >= 0.0 && t >= 0.0)) return;
    const double sum = s + t;
    if (sum > 1.0) {
      s = std::min(s / sum, 1.0);
      t = std::max(0.0, 1.0 - s);
    }
    best = std::min(best, distance_at(s, t));
  };
  if (determinant > Extended(0.0)) {
    consider(((e1 * ff - f1 * ef) / determinant).high, ((f1 * ee - e1 * ef) / determinant).high);
  }
  if (ee > Extended(0.0)) consider(std::clamp((e1 / ee).high, 0.0, 1.0), 0.0);
  if (ff > Extended(0.0)) consider(0.0, std::clamp((f1 / ff).high, 0.0, 1.0));
  return best;
}

constexpr QueryError<Extended> kError{Extended(8.0), Extended(kExtendedError)};

using Hull = ExpandingHull<Extended, ExtendedDifference>;

// What the searches of one query have found out.
struct Findings {
  double gap_lower = -HUGE_VAL, gap_upper = HUGE_VAL;
  bool is_capped = false;
  int n_support_calls = 0;
};

Verdict disjoint_along(const Vec3e& dir, OverlapCertificate* certificate) {
  if (certificate != nullptr) {
    certificate->separating_dir = high_part(dir);
    certificate->separating_dir_low = low_part(dir);
  }
  return Verdict::disjoint(DecidedBy::double_double);
}

// Searches from two inner points; none where both stall.
std::optional<Verdict> by_portal(const LocalForms& forms, OverlapCertificate* certificate, int max_support_calls,
                                 Findings& findings) {
  const ExtendedDifference difference(forms, nullptr);
  findings.n_support_calls += static_cast<int>(kDirections.size());
  for (const Vec3e& start : inner_points(difference)) {
    const PortalResult<Extended> found = refine_portal<Extended>(difference, start, kError, max_support_calls);
    findings.n_support_calls += found.n_support_calls;
    findings.gap_lower = std::max(findings.gap_lower, difference.gap_lower());
    if (found.disjoint) return disjoint_along(found.separating_dir, certificate);
    if (found.overlap) return Verdict::overlap(DecidedBy::double_double);
    findings.gap_upper = std::min(findings.gap_upper, distance_of_triangle(found.v1, found.v2, found.v3));
  }
  return std::nullopt;
}

// The hull of A - B with a ball of `thickness` about each point. What is apart from that is apart from A - B; that it
// holds the origin proves an overlap only where the thickness is 0.
std::optional<Verdict> by_hull(const LocalForms& forms, double thickness, OverlapCertificate* certificate,
                               int max_support_calls, Findings& findings) {
  const ExtendedDifference difference(forms, nullptr, thickness);
  Hull hull(difference, kError);
  const Hull::End end = hull.run(max_support_calls);
  findings.n_support_calls += static_cast<int>(hull.points().size());
  findings.gap_lower = std::max(findings.gap_lower, difference.gap_lower());
  if (end == Hull::End::disjoint) return disjoint_along(hull.separating_dir(), certificate);
  if (end == Hull::End::flat) {
    if (thickness > 0.0) return std::nullopt;
    return by_hull(forms, kThickness, certificate, max_support_calls, findings);
  }
  if (end == Hull::End::overlap) {
    if (thickness == 0.0) return Verdict::overlap(DecidedBy::double_double);
    findings.gap_upper = std::min(findings.gap_upper, thickness);
    return std::nullopt;
  }
  findings.is_capped = end == Hull::End::capped;
  hull.for_each_face([&](const Vec3e& p, const Vec3e& q, const Vec3e& r) {
    findings.gap_upper = std::min(findings.gap_upper, thickness + distance_of_triangle(p, q, r));
  });
  return std::nullopt;
}

// A gap that is known so well is contact, whatever kept a search going.
constexpr double kContact = 0x1p-55;

// Takes the records of these calls as witnesses.
void take_witnesses(std::span<const std::size_t> calls, const std::vector<ExtendedRecord>& records,
                    OverlapCertificate& certificate) {
  certificate.n_witnesses = 0;
  for (const std::size_t call : calls) {
    certificate.witnesses[static_cast<std::size_t>(certificate.n_witnesses++)] = records[call].witness;
  }
}

// From a search that starts at a support point, on the far side from the origin: it has support points only.
bool find_witnesses_by_portal(const LocalForms& forms, OverlapCertificate& certificate, int max_support_calls) {
  std::vector<ExtendedRecord> records;
  const ExtendedDifference difference(forms, &records);
  const Vec3e away = scaled_to_unit_exponent(inner_points(difference).front());
  for (const Vec3e& dir : {away, extended(kDirections[0]) + away}) {
    records.clear();
    const PortalResult<Extended> found =
        refine_portal<Extended>(difference, difference.support(dir), kError, max_support_calls);
    if (!found.overlap) continue;
    std::array<std::size_t, 4> calls{};
    std::size_t n_calls = 0;
    for (const Vec3e& v : {found.v0, found.v1, found.v2, found.v3}) {
      const auto record = std::ranges::find_if(
          records, [&v](const ExtendedRecord& r) { return r.at.x == v.x && r.at.y == v.y && r.at.z == v.z; });
      calls[n_calls++] = static_cast<std::size_t>(record - records.begin());
    }
    take_witnesses(calls, records, certificate);
    return true;
  }
  return false;
}

// The corners of the two faces through which a line through the origin leaves the hull: the origin is between two inner
// points of them, so in the hull of the six, and inside of it unless the line was chosen badly. The checker says.
bool find_witnesses_by_hull(const LocalForms& forms, OverlapCertificate& certificate, int max_support_calls,
                            const std::function<bool()>& is_proof) {
  std::vector<ExtendedRecord> records;
  const ExtendedDifference difference(forms, &records);
  Hull hull(difference, kError);
  if (hull.run(max_support_calls) != Hull::End::overlap) return false;
  std::vector<Vec3e> lines;
  for (const Vec3d& dir : kDirections) lines.push_back(extended(dir));
  for (std::size_t k = 1; k < hull.points().size(); ++k) {
    lines.push_back(hull.points()[k] + Extended(0.37) * hull.points()[k - 1]);
    lines.push_back(hull.points()[k]);
  }
  for (const Vec3e& line : lines) {
    const Vec3e dir = scaled_to_unit_exponent(line);
    const std::optional<Hull::Triangle> front = hull.face_along(dir), back = hull.face_along(-dir);
    if (!front || !back) continue;
    std::vector<std::size_t> calls;  // a point of the hull and the record of its call have the same index
    for (const Hull::Triangle& corners : {*front, *back}) {
      for (const std::size_t corner : corners) {
        if (std::ranges::find(calls, corner) == calls.end()) calls.push_back(corner);
      }
    }
    take_witnesses(calls, records, certificate);
    if (is_proof()) return true;
  }
  return false;
}

}  // namespace

ExtendedOverlap extended_overlap(const PlacedForms& placed, OverlapCertificate* certificate, int max_support_calls) {
  const LocalForms forms(placed);
  Findings findings;
  std::optional<Verdict> verdict = by_portal(forms, certificate, max_support_calls, findings);
  if (!verdict) verdict = by_hull(forms, 0.0, certificate, max_support_calls, findings);
  if (!verdict) {
    const double upper = findings.gap_upper * (1.0 + 0x1p-50) + 2.0 * kExtendedError;
    const bool is_contact = upper - findings.gap_lower < kContact;
    verdict =
        Verdict::undecided(DecidedBy::double_double, findings.is_capped && !is_contact ? UndecidedReason::iteration_cap
                                                                                       : UndecidedReason::rounding);
    if (certificate != nullptr) {
      // Lengths of any size again: ldexp rounds, at most, an underflowing one.
      certificate->gap_lower = std::ldexp(findings.gap_lower, forms.exponent());
      certificate->gap_upper = std::ldexp(upper, forms.exponent());
    }
  }
  return {*verdict, findings.n_support_calls};
}

bool find_witnesses(const PlacedForms& placed, OverlapCertificate& certificate, int max_support_calls,
                    const std::function<bool()>& is_proof) {
  const LocalForms forms(placed);
  if (find_witnesses_by_portal(forms, certificate, max_support_calls)) return true;
  if (find_witnesses_by_hull(forms, certificate, max_support_calls, is_proof)) return true;
  certificate.n_witnesses = 0;
  return false;
}

}  // namespace vex
