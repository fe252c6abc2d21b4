#include "engine/query/extended_overlap.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/numeric/double_double.h"
#include "engine/query/expanding_hull.h"
#include "engine/query/portal_refinement.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

using Extended = DoubleDouble;
using Vec3e = Vec3<Extended>;

// Scaled lengths are at most a few; all roundings of a support point and of its height together are below this (E15).
constexpr double kSupportError = 0x1p-92;

Vec3d high_part(const Vec3e& v) { return {v.x.high, v.y.high, v.z.high}; }
Vec3d low_part(const Vec3e& v) { return {v.x.low, v.y.low, v.z.low}; }
Vec3e extended(const Vec3d& v) { return broadcast<Extended>(v); }

Transform<Extended> extended(const Transformd& pose) {
  return {extended(pose.row_x), extended(pose.row_y), extended(pose.row_z), extended(pose.translation)};
}

// A point of a body and its height along the direction it was asked for.
struct Farthest {
  Vec3e point;
  Extended height;
  bool is_any = false;

  void consider(const Vec3e& candidate, const Extended& candidate_height) {
    if (is_any && candidate_height <= height) return;
    point = candidate;
    height = candidate_height;
    is_any = true;
  }
};

// The points of a difference that were looked at, as witnesses.
struct Record {
  Vec3e at;
  Witness witness;
};

// What flat differences are thickened by, scaled: far above the rounding of a search, far below 1e-14 of the bodies.
constexpr double kThickness = 0x1p-56;

// A - B in units of 2^exponent of the forms, with a ball of `thickness` about each point.
class ExtendedDifference {
 public:
  ExtendedDifference(const PlacedForms& forms, std::vector<Record>* records, double thickness = 0.0)
      : forms_(forms), records_(records), a_from_b_(extended(forms.a_from_b)) {
    a_from_b_.translation = extended(times_power_of_two(forms.a_from_b.translation, -forms.exponent));
    ball_radius_ = Extended(std::ldexp(forms.a.ball_radius, -forms.exponent)) +
                   Extended(std::ldexp(forms.b.ball_radius, -forms.exponent)) + Extended(thickness);
  }

  Vec3e support(const Vec3e& dir) const {
    const Farthest a = farthest_of_a(dir);
    const Vec3e dir_b = a_from_b_.direction_to_b(-dir);
    Vec3e own_b;
    const Farthest b = farthest_of_b(-dir, dir_b, own_b);
    Vec3e w = a.point - b.point;
    if (ball_radius_ > Extended(0.0)) w = w + ball_support(ball_radius_, dir);
    if (records_ != nullptr) {
      records_->push_back({w,
                           {high_part(dir), low_part(dir), high_part(dir_b), low_part(dir_b),
                            times_power_of_two(high_part(a.point), forms_.exponent),
                            times_power_of_two(high_part(own_b), forms_.exponent)}});
    }
    note_gap(dir, w);
    return w;
  }

  /// No point of A - B is nearer along some direction that was looked at: a lower bound of the signed gap, scaled.
  double gap_lower() const { return gap_lower_; }

 private:
  // c + D D d / |D d|, and its height, for the piece of `form` that is farthest.
  Farthest farthest_piece(const ExactForm& form, const Vec3e& dir) const {
    Farthest best;
    for (const ExactForm::Piece& piece : form.pieces) {
      const Vec3e centre = extended(times_power_of_two(piece.centre, -forms_.exponent));
      const Vec3e axes = extended(times_power_of_two(piece.semi_axes, -forms_.exponent));
      Vec3e image{axes.x * dir.x, axes.y * dir.y, axes.z * dir.z};
      if (piece.is_dome && image.z < Extended(0.0)) image.z = Extended(0.0);
      const Vec3e unit = ball_support(Extended(1.0), scaled_to_unit_exponent(image));
      const Vec3e point = centre + Vec3e{axes.x * unit.x, axes.y * unit.y, axes.z * unit.z};
      best.consider(point, dot(point, dir));
    }
    return best;
  }

  // Directions are between 2^-100 and 2^100 long; a vertex set wants them near 1.
  static Vec3d vertex_direction(const Vec3e& dir) { return scaled_to_unit_exponent(high_part(dir)); }

  Farthest farthest_of_a(const Vec3e& dir) const {
    Farthest best = farthest_piece(forms_.a, dir);
    for (const std::size_t i : forms_.points_a.farthest(vertex_direction(dir))) {
      const Vec3e point = extended(times_power_of_two(forms_.a.points[i], -forms_.exponent));
      best.consider(point, dot(point, dir));
    }
    return best;
  }

  // `dir` and the point in A's frame; `dir_b` and `own` are the same in B's.
  Farthest farthest_of_b(const Vec3e& dir, const Vec3e& dir_b, Vec3e& own) const {
    Farthest best;
    if (!forms_.b.pieces.empty()) {
      own = farthest_piece(forms_.b, dir_b).point;
      const Vec3e placed = a_from_b_(own);
      best.consider(placed, dot(placed, dir));
    }
    for (const std::size_t i : forms_.points_b.farthest(vertex_direction(dir))) {
      const Vec3e own_point = extended(times_power_of_two(forms_.b.points[i], -forms_.exponent));
      const Vec3e placed = forms_.b.is_polytope() ? extended(times_power_of_two(forms_.placed_b[i], -forms_.exponent))
                                                  : a_from_b_(own_point);
      const Extended height = dot(placed, dir);
      if (!best.is_any || height > best.height) own = own_point;
      best.consider(placed, height);
    }
    return best;
  }

  void note_gap(const Vec3e& dir, const Vec3e& w) const {
    const Extended length = norm(dir);
    if (!(length > Extended(0.0))) return;
    const Extended gap = -(dot(dir, w) / length);
    const double rounded_down = gap.high - 0x1p-52 * std::fabs(gap.high) - 2.0 * kSupportError;
    gap_lower_ = std::max(gap_lower_, rounded_down);
  }

  const PlacedForms& forms_;
  std::vector<Record>* records_;
  Transform<Extended> a_from_b_;
  Extended ball_radius_;
  mutable double gap_lower_ = -HUGE_VAL;
};

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

constexpr QueryError<Extended> kError{Extended(8.0), Extended(kSupportError)};

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
std::optional<Verdict> by_portal(const PlacedForms& forms, OverlapCertificate* certificate, int max_support_calls,
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
std::optional<Verdict> by_hull(const PlacedForms& forms, double thickness, OverlapCertificate* certificate,
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
void take_witnesses(std::span<const std::size_t> calls, const std::vector<Record>& records,
                    OverlapCertificate& certificate) {
  certificate.n_witnesses = 0;
  for (const std::size_t call : calls) {
    certificate.witnesses[static_cast<std::size_t>(certificate.n_witnesses++)] = records[call].witness;
  }
}

// From a search that starts at a support point, on the far side from the origin: it has support points only.
bool find_witnesses_by_portal(const PlacedForms& forms, OverlapCertificate& certificate, int max_support_calls) {
  std::vector<Record> records;
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
          records, [&v](const Record& r) { return r.at.x == v.x && r.at.y == v.y && r.at.z == v.z; });
      calls[n_calls++] = static_cast<std::size_t>(record - records.begin());
    }
    take_witnesses(calls, records, certificate);
    return true;
  }
  return false;
}

// The corners of the two faces through which a line through the origin leaves the hull: the origin is between two inner
// points of them, so in the hull of the six, and inside of it unless the line was chosen badly. The checker says.
bool find_witnesses_by_hull(const PlacedForms& forms, OverlapCertificate& certificate, int max_support_calls,
                            const std::function<bool()>& is_proof) {
  std::vector<Record> records;
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

ExtendedOverlap extended_overlap(const PlacedForms& forms, OverlapCertificate* certificate, int max_support_calls) {
  Findings findings;
  std::optional<Verdict> verdict = by_portal(forms, certificate, max_support_calls, findings);
  if (!verdict) verdict = by_hull(forms, 0.0, certificate, max_support_calls, findings);
  if (!verdict) {
    const double upper = findings.gap_upper * (1.0 + 0x1p-50) + 2.0 * kSupportError;
    const bool is_contact = upper - findings.gap_lower < kContact;
    verdict =
        Verdict::undecided(DecidedBy::double_double, findings.is_capped && !is_contact ? UndecidedReason::iteration_cap
                                                                                       : UndecidedReason::rounding);
    if (certificate != nullptr) {
      // Lengths of any size again: ldexp rounds, at most, an underflowing one.
      certificate->gap_lower = std::ldexp(findings.gap_lower, forms.exponent);
      certificate->gap_upper = std::ldexp(upper, forms.exponent);
    }
  }
  return {*verdict, findings.n_support_calls};
}

bool find_witnesses(const PlacedForms& forms, OverlapCertificate& certificate, int max_support_calls,
                    const std::function<bool()>& is_proof) {
  if (find_witnesses_by_portal(forms, certificate, max_support_calls)) return true;
  if (find_witnesses_by_hull(forms, certificate, max_support_calls, is_proof)) return true;
  certificate.n_witnesses = 0;
  return false;
}

}  // namespace vex
