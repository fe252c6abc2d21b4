#include "engine/sampling/radial/radial_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/numeric/elementary.h"

namespace vex {
namespace {

// Half of the directions that the rotations and reflections of a cube make of two; the others are their opposites.
// Means over them are exact for polynomials up to the ninth degree: with e2 = x^2 y^2 + y^2 z^2 + z^2 x^2 and e3 = x^2
// y^2 z^2, on which those that have the cube's symmetry depend, the means of e2, e2^2 and e3 are 1/5, 1/21 and 1/105.
constexpr Vec3d kFirst{0.09275389607609623, 0.3456721831090171, 0.9337598495262853};
constexpr Vec3d kSecond{0.2958039891549808, 0.6552899782998756, 0.6950503897846174};

std::array<Vec3d, 48> cube_directions() {
  std::array<Vec3d, 48> directions;
  std::size_t n = 0;
  for (const Vec3d& d : {kFirst, kSecond}) {
    for (const Vec3d& p : {Vec3d{d.x, d.y, d.z}, Vec3d{d.y, d.z, d.x}, Vec3d{d.z, d.x, d.y}, Vec3d{d.y, d.x, d.z},
                           Vec3d{d.x, d.z, d.y}, Vec3d{d.z, d.y, d.x}}) {
      for (const double y : {p.y, -p.y}) {
        for (const double z : {p.z, -p.z}) directions[n++] = {p.x, y, z};
      }
    }
  }
  return directions;
}

/// Evenly spread points of the sphere that have no symmetry, point by point on a spiral (E. B. Saff, A. B. J.
/// Kuijlaars, Math. Intelligencer 19, 5, 1997, with the golden angle).
constexpr double kGoldenTurn = 0.38196601125010515;
std::array<Vec3d, 96> spiral_directions() {
  std::array<Vec3d, 96> directions;
  double turn = 0.0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double z = (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(directions.size()) - 1.0;
    const SinCos<double> azimuth = sincospi(2.0 * turn);
    const double across = square_root(1.0 - z * z);
    directions[k] = {across * azimuth.cos, across * azimuth.sin, z};
    turn += kGoldenTurn;
    if (turn >= 1.0) turn -= 1.0;
  }
  return directions;
}

Vec3d unit_of(const Vec3d& v) { return (1.0 / norm(v)) * v; }

constexpr std::array<Vec3d, 3> kFrame = {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}};

// Of the frame's axes the one most across `dir`, made orthogonal to it.
Vec3d frame_axis_across(const Vec3d& dir) {
  Vec3d best = kFrame[0];
  for (const Vec3d& axis : kFrame) {
    if (std::fabs(dot(axis, dir)) < std::fabs(dot(best, dir))) best = axis;
  }
  return unit_of(best - dot(best, dir) * dir);
}

struct PrincipalAxes {
  std::array<double, 3> values{};  // from the largest on
  std::array<Vec3d, 3> directions;
};

// By Jacobi's rotations. What is diagonal but for rounding is left as it is: the axes are the frame's then.
PrincipalAxes principal_axes(const Symmetric<double>& q) {
  constexpr int kSweeps = 12;
  double m[3][3] = {{q.xx, q.xy, q.xz}, {q.xy, q.yy, q.yz}, {q.xz, q.yz, q.zz}};
  std::array<Vec3d, 3> axes = kFrame;
  const double least = 0x1p-44 * ((q.xx + q.yy) + q.zz);
  constexpr std::pair<std::size_t, std::size_t> kPairs[] = {{0, 1}, {0, 2}, {1, 2}};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [i, j] : kPairs) {
      if (std::fabs(m[i][j]) <= least) continue;
      const double half = (m[j][j] - m[i][i]) / (2.0 * m[i][j]);
      const double tangent = std::copysign(1.0, half) / (std::fabs(half) + std::sqrt(half * half + 1.0));
      const double cos = 1.0 / std::sqrt(tangent * tangent + 1.0), sin = tangent * cos;
      for (auto& row : m) {
        const double at_i = row[i], at_j = row[j];
        row[i] = cos * at_i - sin * at_j;
        row[j] = sin * at_i + cos * at_j;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double at_i = m[i][k], at_j = m[j][k];
        m[i][k] = cos * at_i - sin * at_j;
        m[j][k] = sin * at_i + cos * at_j;
      }
      const Vec3d axis_i = axes[i], axis_j = axes[j];
      axes[i] = cos * axis_i - sin * axis_j;
      axes[j] = sin * axis_i + cos * axis_j;
    }
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, [&m](std::size_t i, std::size_t j) { return m[i][i] > m[j][j]; });
  PrincipalAxes found;
  for (std::size_t k = 0; k < 3; ++k) {
    found.values[k] = std::fmax(0.0, m[order[k]][order[k]]);
    found.directions[k] = unit_of(axes[order[k]]);
  }
  return found;
}

}  // namespace

std::array<double, 3> principal_values(const Symmetric<double>& q) { return principal_axes(q).values; }

namespace {

// Of squared lengths: beyond the first ratio an axis is told from the others, beyond the second it makes a rod or slab.
constexpr double kTold = 1.2, kLong = 3.0;

// Where no axis is told: z, or the farthest corner of a body whose opposite sides are unlike. With the frame's axes for
// its own a regular tetrahedron, whose corners are between them, gains nothing from quasi-random points.
Vec3d axis_of_lump(const ConvexBody& body, const Vec3d& centre) {
  constexpr double kUnlike = 0.02;
  bool is_unlike = false;
  Vec3d farthest;
  for (const Vec3d& e : spiral_directions()) {
    const Vec3d there = body.support(e) - centre, back = body.support(-e) - centre;
    is_unlike = is_unlike || std::fabs(dot(there + back, e)) > kUnlike * body.circumradius();
    if (norm(there) > (1.0 + 0x1p-20) * norm(farthest)) farthest = there;
  }
  return is_unlike && norm(farthest) > 0.0 ? unit_of(farthest) : kFrame[2];
}

Vec3d from_axes(const Transformd& axes, const Vec3d& v) { return axes.direction_to_b(v); }

// After the turn, which takes a direction in the axes to another one.
template <class Turn>
bool looks_the_same_after(const Turn& turn, const ConvexBody& body, const Vec3d& centre, const Transformd& axes) {
  constexpr double kLike = 0x1p-30;
  const auto height = [&](const Vec3d& e) {
    const Vec3d dir = from_axes(axes, e);
    return dot(body.support(dir) - centre, dir);
  };
  return std::ranges::all_of(spiral_directions(), [&](const Vec3d& e) {
    return std::fabs(height(turn(e)) - height(e)) <= kLike * body.circumradius();
  });
}

auto about_z(double turns) {
  return [turn = sincospi(2.0 * turns)](const Vec3d& e) -> Vec3d {
    return {turn.cos * e.x - turn.sin * e.y, turn.sin * e.x + turn.cos * e.y, e.z};
  };
}

struct FoundTurns {
  Turns turns;
  bool is_round = false;  // after any turn about z it looks the same
};
FoundTurns turns_of(const ConvexBody& body, const Vec3d& centre, const Transformd& axes) {
  const auto looks_the_same = [&](const auto& turn) { return looks_the_same_after(turn, body, centre, axes); };
  FoundTurns found{{}, looks_the_same(about_z(kGoldenTurn))};
  Turns& turns = found.turns;
  for (const int n : {5, 4, 3, 2}) {
    if (found.is_round || !looks_the_same(about_z(1.0 / n))) continue;
    turns.n_sectors = n;
    break;
  }
  if (!looks_the_same([](const Vec3d& e) -> Vec3d { return {e.x, -e.y, -e.z}; })) return found;
  const bool are_axes_alike = turns.n_sectors % 2 == 0 && looks_the_same([](const Vec3d& e) -> Vec3d {
                                return {e.y, e.z, e.x};
                              });
  turns.poles = are_axes_alike ? Turns::Poles::six : Turns::Poles::two;
  return found;
}

}  // namespace

MatchingEllipsoid matching_ellipsoid(const ConvexBody& body) {
  constexpr int kRounds = 6;
  const std::array<Vec3d, 48> directions = cube_directions();
  // Lengths are told in circumradii, from the body's centre: their squares may not over- or underflow.
  const double unit_of = body.circumradius();
  const Vec3d origin = body.centre();
  if (!(unit_of > 0.0)) return {origin, {}};  // a point
  const auto support = [&](const Vec3d& dir) { return (1.0 / unit_of) * (body.support(dir) - origin); };
  Symmetric<double> q{1.0, 1.0, 1.0};
  Vec3d centre;
  for (int round = 0; round < kRounds; ++round) {
    const Root<double> root = root_of(q);
    Symmetric<double> sum;
    Vec3d mean;
    for (const Vec3d& e : directions) {
      const Vec3d dir = scaled_to_unit_exponent(root.normal(e));
      const Vec3d there = support(dir), back = support(-dir);
      for (const Vec3d& point : {there, back}) {
        const Vec3d s = point - centre;
        sum.xx += s.x * s.x;
        sum.yy += s.y * s.y;
        sum.zz += s.z * s.z;
        sum.xy += s.x * s.y;
        sum.xz += s.x * s.z;
        sum.yz += s.y * s.z;
      }
      mean = mean + 0.5 * (there + back);  // exactly nothing for a body that is its own mirror image
    }
    // Half of the way: the whole of it would overshoot for smooth bodies, whose points move with the directions.
    const double kept = round == 0 ? 0.0 : 0.5;
    const double taken = (1.0 - kept) * 3.0 / static_cast<double>(2 * directions.size());
    q = {kept * q.xx + taken * sum.xx, kept * q.yy + taken * sum.yy, kept * q.zz + taken * sum.zz,
         kept * q.xy + taken * sum.xy, kept * q.xz + taken * sum.xz, kept * q.yz + taken * sum.yz};
    centre = (1.0 / static_cast<double>(directions.size())) * mean;
  }
  const double area = unit_of * unit_of;
  return {origin + unit_of * centre, {area * q.xx, area * q.yy, area * q.zz, area * q.xy, area * q.xz, area * q.yz}};
}

RadialBody radial_body(const ConvexBody& body) {
  // Hundreds of directions are asked here and far more by the rays: a table that is made at last had better come first.
  body.direction_table();
  const MatchingEllipsoid ellipsoid = matching_ellipsoid(body);
  RadialBody found;
  found.centre = ellipsoid.centre;
  const PrincipalAxes principal = principal_axes(ellipsoid.q);
  const auto& [longest, middle, shortest] = principal.values;
  Vec3d x, z;
  if (longest <= kTold * middle && middle <= kTold * shortest) {
    const bool has_turns_of_frame = turns_of(body, found.centre, {}).turns.poles == Turns::Poles::six;
    z = has_turns_of_frame ? kFrame[2] : axis_of_lump(body, found.centre);
    x = frame_axis_across(z);
  } else {
    // longest / middle against middle / shortest; but of a long strip the long axis, however thin it is.
    const bool is_rod = longest >= kLong * middle || longest * shortest >= middle * middle;
    const std::size_t k = is_rod ? 0 : 2;
    z = principal.directions[k];
    const double larger_across = principal.values[is_rod ? 1 : 0], smaller_across = principal.values[is_rod ? 2 : 1];
    x = larger_across <= kTold * smaller_across ? frame_axis_across(z) : principal.directions[is_rod ? 1 : 0];
    if (is_rod ? longest >= kLong * middle : middle >= kLong * shortest) {
      found.form = is_rod ? RadialBody::Form::rod : RadialBody::Form::slab;
    }
  }
  found.axes = {x, cross(z, x), z, {}};
  found.is_upright = norm_1(x - kFrame[0]) == 0.0 && norm_1(z - kFrame[2]) == 0.0;

  const auto& m = ellipsoid.q;
  const auto times_q = [&m](const Vec3d& v) -> Vec3d {
    return {(m.xx * v.x + m.xy * v.y) + m.xz * v.z, (m.xy * v.x + m.yy * v.y) + m.yz * v.z,
            (m.xz * v.x + m.yz * v.y) + m.zz * v.z};
  };
  const Vec3d y = found.axes.row_y, q_x = times_q(x), q_y = times_q(y), q_z = times_q(z);
  found.q = {dot(x, q_x), dot(y, q_y), dot(z, q_z), dot(x, q_y), dot(x, q_z), dot(y, q_z)};

  const auto [turns, is_round] = turns_of(body, found.centre, found.axes);
  found.turns = turns;
  const bool has_six_poles = found.turns.poles == Turns::Poles::six;
  // The ellipsoid is to have the symmetry, too.
  if (is_round || found.turns.n_sectors > 1) found.q.xz = found.q.yz = 0.0;
  if (is_round || found.turns.n_sectors > 2 || has_six_poles) {
    found.q.xx = found.q.yy = 0.5 * (found.q.xx + found.q.yy);
    found.q.xy = 0.0;
  }
  if (has_six_poles) found.q.xx = found.q.yy = found.q.zz = (2.0 * found.q.xx + found.q.zz) / 3.0;
  return found;
}

}  // namespace vex
