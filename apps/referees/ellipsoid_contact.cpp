#include "apps/referees/ellipsoid_contact.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// Only what ends as `undecided` comes near it: the bracket is halved in every second step once Newton has had its turn.
constexpr int kMaxSteps = 400;

double smallest(const Vec3d& v) { return std::min({v.x, v.y, v.z}); }
double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }
Vec3d by_coordinates(const Vec3d& a, const Vec3d& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Symmetric {
  double xx, xy, xz, yy, yz, zz;
};

// Cholesky's factors without square roots. No error bound is asked of what it solves: the proofs look at the result.
class Ldlt {
 public:
  explicit Ldlt(const Symmetric& m) {
    // A pivot that rounding took away is given the size of what rounding leaves.
    const auto pivot = [](double p, double diagonal) { return std::max(p, kUnitRoundoff * diagonal); };
    inv_x_ = 1.0 / m.xx;
    l_yx_ = m.xy * inv_x_;
    l_zx_ = m.xz * inv_x_;
    inv_y_ = 1.0 / pivot(m.yy - l_yx_ * m.xy, m.yy);
    const double zy = m.yz - l_yx_ * m.xz;
    l_zy_ = zy * inv_y_;
    inv_z_ = 1.0 / pivot((m.zz - l_zx_ * m.xz) - l_zy_ * zy, m.zz);
  }
  Vec3d solve(const Vec3d& rhs) const {
    const double y = rhs.y - l_yx_ * rhs.x;
    const double z = (rhs.z - l_zx_ * rhs.x) - l_zy_ * y;
    Vec3d e;
    e.z = z * inv_z_;
    e.y = y * inv_y_ - l_zy_ * e.z;
    e.x = (rhs.x * inv_x_ - l_yx_ * e.y) - l_zx_ * e.z;
    return e;
  }

 private:
  double inv_x_, inv_y_, inv_z_, l_yx_, l_zx_, l_zy_;
};

// Bounds of how much the ellipsoids must be grown about their centres for a common point.
struct Growth {
  double a, b;
};

// Whether some point between the two has both below 1: growth is convex.
bool chord_reaches_unit_square(const Growth& low, const Growth& high) {
  return low.b < 1.0 && high.a < 1.0 && (low.a - 1.0) * (high.b - 1.0) <= (1.0 - low.b) * (1.0 - high.a);
}

}  // namespace

EllipsoidContact::EllipsoidContact(const Vec3d& axes_a, const Vec3d& axes_b)
    : axes_a_(axes_a),
      axes_b_(axes_b),
      inradius_a_(smallest(axes_a)),
      inradius_b_(smallest(axes_b) * (1.0 - 2e-6)),
      reach_(largest(axes_a) + 2.0 * largest(axes_b)),
      cross_factor_a_(1.01 + 8.0 * kUnitRoundoff * (largest(axes_a) / inradius_a_)),
      cross_factor_b_(1.01 + 8.0 * kUnitRoundoff * (largest(axes_b) / inradius_b_)),
      least_ratio_(0.25 * inradius_a_ / largest(axes_b)),
      largest_ratio_(4.0 * largest(axes_a) / inradius_b_) {}

Verdict EllipsoidContact::operator()(const Transformd& p) const {
  constexpr double u = kUnitRoundoff;
  const Vec3d& r = p.translation;
  const double error = 32.0 * u * (reach_ + norm_1(r));
  if (norm_1(r) < inradius_a_) return Verdict::overlap(DecidedBy::peer);  // B's centre is in A

  const Transformd turn{p.row_x, p.row_y, p.row_z, {}};
  const auto turned = [&turn](const Vec3d& x) {
    return Vec3d{dot(turn.row_x, x), dot(turn.row_y, x), dot(turn.row_z, x)};
  };
  const auto separates = [&](const Vec3d& dir, double height_a, double height_b) {
    return dot(dir, r) - (height_a + height_b) > error * norm_1(dir);
  };

  // r itself as a direction, and the ratio of the heights along it as the first l / (1 - l).
  const double first_a = norm(by_coordinates(axes_a_, r));
  const double first_b = norm(by_coordinates(axes_b_, turn.direction_to_b(r)));
  if (separates(r, first_a, first_b)) return Verdict::disjoint(DecidedBy::peer);
  double ratio = first_a / first_b;

  const Vec3d gx = by_coordinates(p.row_x, axes_b_), gy = by_coordinates(p.row_y, axes_b_),
              gz = by_coordinates(p.row_z, axes_b_);
  const Symmetric b{dot(gx, gx), dot(gx, gy), dot(gx, gz), dot(gy, gy), dot(gy, gz), dot(gz, gz)};
  const Vec3d a = by_coordinates(axes_a_, axes_a_);

  double low = least_ratio_, high = largest_ratio_;
  bool has_low = false, has_high = false;
  Growth at_low{}, at_high{};
  for (int step = 0; step < kMaxSteps; ++step) {
    // e with (A + ratio B) e = r: the direction of the normal, A e a point of A's grown body, ratio B e one of B's.
    const Ldlt factors(
        {a.x + ratio * b.xx, ratio * b.xy, ratio * b.xz, a.y + ratio * b.yy, ratio * b.yz, a.z + ratio * b.zz});
    Vec3d e = factors.solve(r);
    Vec3d unit_a = by_coordinates(axes_a_, e);                       // A's point, seen as one of the unit ball
    Vec3d unit_b = by_coordinates(axes_b_, turn.direction_to_b(e));  // B's, over ratio
    double size_e = norm_1(e);
    Vec3d point_a, point_b;
    Growth growth{};
    for (int refinement = 0;; ++refinement) {
      const double length_a = norm(unit_a), length_b = norm(unit_b);
      if (separates(e, length_a, length_b)) return Verdict::disjoint(DecidedBy::peer);
      // How far the two points are from being one; given to the body that is higher along e.
      point_a = by_coordinates(axes_a_, unit_a);
      point_b = turned(by_coordinates(axes_b_, ratio * unit_b));
      const Vec3d residual = (r - point_a) - point_b;
      growth = {length_a, ratio * length_b};
      const double slack = norm_1(residual) + error * std::max({1.0, growth.a, growth.b});
      if (ratio >= 1.0) {
        const double own = slack / inradius_a_;
        growth.a = std::sqrt(growth.a * growth.a + 2.0 * cross_factor_a_ * size_e * slack + own * own);
      } else {
        const double own = slack / inradius_b_;
        growth.b = std::sqrt(growth.b * growth.b + 2.0 * cross_factor_b_ * ratio * size_e * slack + own * own);
      }
      growth.a *= 1.0 + 16.0 * u;
      growth.b *= 1.0 + 16.0 * u;
      if (growth.a <= 1.0 && growth.b <= 1.0) return Verdict::overlap(DecidedBy::peer);
      if (refinement == 3 || slack < 4.0 * error) break;
      const Vec3d correction = factors.solve(residual);
      e = e + correction;
      unit_a = unit_a + by_coordinates(axes_a_, correction);
      unit_b = unit_b + by_coordinates(axes_b_, turn.direction_to_b(correction));
      size_e += norm_1(correction);
    }

    if (growth.a > growth.b) {
      low = ratio;
      at_low = growth;
      has_low = true;
    } else {
      high = ratio;
      at_high = growth;
      has_high = true;
    }
    if (has_low && has_high && chord_reaches_unit_square(at_low, at_high)) return Verdict::overlap(DecidedBy::peer);
    if (high <= low * (1.0 + 4.0 * u)) return Verdict::undecided(DecidedBy::peer, UndecidedReason::rounding);

    // Newton's step for log(growth_a / growth_b) in log(ratio).
    const double q = dot(point_a, factors.solve(point_b));
    const double slope = q * (1.0 / (growth.a * growth.a) + ratio / (growth.b * growth.b));
    double next = ratio * std::exp(std::log(growth.a / growth.b) / slope);
    const bool halve = step > 10 && step % 2 == 1;
    if (halve || !(next > low && next < high)) next = std::sqrt(low) * std::sqrt(high);
    if (next == low || next == high) return Verdict::undecided(DecidedBy::peer, UndecidedReason::rounding);
    ratio = next;
  }
  return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
}

}  // namespace vex
