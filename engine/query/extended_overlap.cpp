#include "engine/query/extended_overlap.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/numeric/double_double.h"
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

Vec3d scaled(const Vec3d& v, int exponent) {
  return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
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
    a_from_b_.translation = extended(scaled(forms.a_from_b.translation, -forms.exponent));
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
                            scaled(high_part(a.point), forms_.exponent), scaled(high_part(own_b), forms_.exponent)}});
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
      const Vec3e centre = extended(scaled(piece.centre, -forms_.exponent));
      const Vec3e axes = extended(scaled(piece.semi_axes, -forms_.exponent));
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
      const Vec3e point = extended(scaled(forms_.a.points[i], -forms_.exponent));
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
      const Vec3e own_point = extended(scaled(forms_.b.points[i], -forms_.exponent));
      const Vec3e placed =
          forms_.b.is_polytope() ? extended(scaled(forms_.placed_b[i], -forms_.exponent)) : a_from_b_(own_point);
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
constexpr std::array<std::array<double, 6>, 4> kWeights = {
    {{0.171875, 0.203125, 0.1328125, 0.1484375, 0.1796875, 0.1640625},
     {0.34375, 0.078125, 0.265625, 0.0625, 0.15625, 0.09375},
     {0.0703125, 0.3359375, 0.0859375, 0.2421875, 0.1171875, 0.1484375},
     {0.03125, 0.125, 0.0625, 0.40625, 0.046875, 0.328125}}};

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

}  // namespace

ExtendedOverlap extended_overlap(const PlacedForms& forms, OverlapCertificate* certificate, int max_support_calls) {
  ExtendedOverlap result;
  double gap_lower = -HUGE_VAL, gap_upper = HUGE_VAL;
  bool is_capped = false;
  // Searches `difference` from these points; whether that decided.
  const auto search = [&](const ExtendedDifference& difference, std::span<const Vec3e> starts, bool is_thickened) {
    for (const Vec3e& start : starts) {
      const PortalResult<Extended> found = refine_portal<Extended>(difference, start, kError, max_support_calls);
      result.n_support_calls += found.n_support_calls;
      gap_lower = std::max(gap_lower, difference.gap_lower());
      if (found.disjoint) {
        if (certificate != nullptr) {
          certificate->separating_dir = high_part(found.separating_dir);
          certificate->separating_dir_low = low_part(found.separating_dir);
        }
        result.verdict = Verdict::disjoint(DecidedBy::double_double);
        return true;
      }
      if (found.overlap && !is_thickened) {
        result.verdict = Verdict::overlap(DecidedBy::double_double);
        return true;
      }
      is_capped = is_capped || found.capped;
      const double thickness = is_thickened ? kThickness : 0.0;
      gap_upper =
          std::min(gap_upper, thickness + (found.overlap ? 0.0 : distance_of_triangle(found.v1, found.v2, found.v3)));
      if (found.overlap) return false;
    }
    return false;
  };

  const ExtendedDifference difference(forms, nullptr);
  const auto starts = inner_points(difference);
  result.n_support_calls = static_cast<int>(kDirections.size());
  if (search(difference, starts, false)) return result;
  // A difference without volume, of flat bodies in one plane, has no simplex to be searched with. Thickened by a ball
  // it has; and what is apart from it is apart from the difference itself. Its own overlap proves that contact is near.
  if (search(ExtendedDifference(forms, nullptr, kThickness), starts, true)) return result;

  if (certificate != nullptr) {
    // Lengths of any size again: ldexp rounds, at most, an underflowing one.
    const double upper = gap_upper * (1.0 + 0x1p-50) + 2.0 * kSupportError;
    certificate->gap_lower = std::ldexp(gap_lower, forms.exponent);
    certificate->gap_upper = std::ldexp(upper, forms.exponent);
  }
  result.verdict = Verdict::undecided(DecidedBy::double_double,
                                      is_capped ? UndecidedReason::iteration_cap : UndecidedReason::rounding);
  return result;
}

bool find_witnesses(const PlacedForms& forms, OverlapCertificate& certificate, int max_support_calls) {
  std::vector<Record> records;
  const ExtendedDifference difference(forms, &records);
  const Vec3e inner = inner_points(difference).front();
  // A search that starts at a support point, on the far side from the origin, has support points only.
  for (std::size_t attempt = 0; attempt <= kDirections.size(); ++attempt) {
    records.clear();
    Vec3e away = scaled_to_unit_exponent(inner);
    if (attempt > 0) away = extended(kDirections[attempt - 1]) + Extended(attempt % 2 == 0 ? 0.25 : 1.0) * away;
    const Vec3e start = difference.support(away);
    const PortalResult<Extended> found = refine_portal<Extended>(difference, start, kError, max_support_calls);
    if (!found.overlap) continue;
    certificate.n_witnesses = 0;
    for (const Vec3e& v : {found.v0, found.v1, found.v2, found.v3}) {
      const auto record = std::ranges::find_if(
          records, [&v](const Record& r) { return r.at.x == v.x && r.at.y == v.y && r.at.z == v.z; });
      if (record == records.end()) return false;
      certificate.witnesses[static_cast<std::size_t>(certificate.n_witnesses++)] = record->witness;
    }
    return true;
  }
  return false;
}

}  // namespace vex
