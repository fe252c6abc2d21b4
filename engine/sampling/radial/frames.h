// Right-handed frames with a random axis, over lanes: how rays and bodies are turned.
#pragma once

#include <numbers>

#include "engine/numeric/elementary.h"
#include "engine/numeric/frame.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// The axis uniform on the sphere.
template <class L>
Frame<L> frame(const L& u, const L& v) {
  const SinCos<L> azimuth = sincospi(v + v);
  const L cos_polar = L(1.0) - (u + u), sin_polar = L(2.0) * square_root(u * (L(1.0) - u));
  return {{cos_polar * azimuth.cos, cos_polar * azimuth.sin, -sin_polar},
          {-azimuth.sin, azimuth.cos, L(0.0)},
          {sin_polar * azimuth.cos, sin_polar * azimuth.sin, cos_polar}};
}

template <class L>
Frame<L> turned(const Frame<L>& f, const SinCos<L>& turn) {
  return {turn.cos * f.across_1 + turn.sin * f.across_2, turn.cos * f.across_2 - turn.sin * f.across_1, f.axis};
}

template <class L>
Vec3<L> scaled_to_unit(const Vec3<L>& v) {
  return (L(1.0) / norm(v)) * v;
}

/// Of a number below 2^51.
template <class L>
L floor_of(const L& x) {
  const L rounder(0x1.8p52), nearest = (x + rounder) - rounder;
  return nearest - select(nearest > x, L(1.0), L(0.0));
}

/// 0, 1 ... n - 1, by the first digits of the pick, which keeps the others: it is from 0 to below 1 before and after.
/// (Of n up to 8 n (1 - 2^-53) is not rounded to n.)
template <class L>
L sector_by(int n, L& pick) {
  const L scaled = L(static_cast<double>(n)) * pick, sector = floor_of(scaled);
  pick = scaled - sector;
  return sector;
}

/// 1 or -1, by the first digit of the pick.
template <class L>
L sign_by(L& pick) {
  const L which = sector_by(2, pick);
  return L(1.0) - (which + which);
}

/// A turn of which nothing depends on the sector if the body looks the same in each: the coordinate's digits are all
/// for the place within a sector, and which it is comes from the first digits of the pick, which are the least missed.
/// Uniform whether the body is symmetric or not.
template <class L>
L in_some_sector(int n_sectors, const L& u, L& pick) {
  if (n_sectors == 1) return u;
  const L sector = sector_by(n_sectors, pick);
  return L(1.0 / n_sectors) * (sector + u);
}

/// What of its turns a body looks the same after, about an axis z and to other axes like it, which are called its poles
/// here: z alone, z and -z, or all six of x, y, z and their opposites.
struct Turns {
  enum class Poles { one, two, six };
  int n_sectors = 1;  // at most 5: so many turns about z; of six poles 2 or 4
  Poles poles = Poles::one;
};

namespace detail {

/// Half a turn about x where the sign is -1.
template <class L>
Frame<L> half_turned(const Frame<L>& f, const L& sign) {
  const auto turn = [&sign](const Vec3<L>& v) -> Vec3<L> { return {v.x, sign * v.y, sign * v.z}; };
  return {turn(f.across_1), turn(f.across_2), turn(f.axis)};
}

/// The axis where it is nearer to z than to the other poles of a cube, and uniform there. About z there are four such
/// triangles, whose side across an azimuth phi from their middle is at z(phi) = cos(phi) / sqrt(1 + cos(phi)^2); up to
/// phi they have the area phi - asin(sin(phi) / sqrt(2)), which is t at tan(phi) = sin(t) / (cos(t) - 1 / sqrt(2)).
template <class L>
Frame<L> frame_about_face(const L& u, const L& azimuth) {
  const L scaled = L(4.0) * azimuth, quarter = floor_of(scaled), place = scaled - quarter;
  const SinCos<L> t = sincospi(L(1.0 / 12.0) * ((place + place) - L(1.0)));
  const L along = t.cos - L(0.5 * std::numbers::sqrt2), scale = L(1.0) / square_root(along * along + t.sin * t.sin);
  const L cos = scale * along, sin = scale * t.sin;
  const L depth = u * (L(1.0) - cos / square_root(L(1.0) + cos * cos));
  const L cos_polar = L(1.0) - depth, sin_polar = square_root(depth * (L(2.0) - depth));
  const MaskOf<L> swaps = either(both(quarter > L(0.5), quarter < L(1.5)), quarter > L(2.5));
  const L sign = select(quarter > L(1.5), L(-1.0), L(1.0));
  const L x = sign * select(swaps, -sin, cos), y = sign * select(swaps, cos, sin);
  return {{cos_polar * x, cos_polar * y, -sin_polar}, {-y, x, L(0.0)}, {sin_polar * x, sin_polar * y, cos_polar}};
}

}  // namespace detail

/// As `frame`, of a body with these turns: coordinates and all their digits are for the part of the sphere that no turn
/// takes into itself, and which part it is comes from the pick.
template <class L>
Frame<L> frame_of_body(const Turns& turns, const L& u, const L& v, L& pick) {
  const L azimuth = in_some_sector(turns.n_sectors, v, pick);
  if (turns.poles == Turns::Poles::one) return frame(u, azimuth);
  const L sign = sign_by(pick);
  if (turns.poles == Turns::Poles::two) return detail::half_turned(frame(L(0.5) * u, azimuth), sign);
  const Frame<L> f = detail::half_turned(detail::frame_about_face(u, azimuth), sign);
  const L which = sector_by(3, pick);
  const MaskOf<L> is_first = which < L(0.5), is_second = which < L(1.5);
  const auto turn = [&](const Vec3<L>& v_of_z) -> Vec3<L> {
    const auto [x, y, z] = v_of_z;
    return {select(is_first, x, select(is_second, y, z)), select(is_first, y, select(is_second, z, x)),
            select(is_first, z, select(is_second, x, y))};
  };
  return {turn(f.across_1), turn(f.across_2), turn(f.axis)};
}

}  // namespace vex
