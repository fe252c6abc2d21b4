// Right-handed frames with a random axis, over lanes: how rays and bodies are turned.
#pragma once

#include "engine/numeric/elementary.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// Right-handed: across_1, across_2, axis.
template <class L>
struct Frame {
  Vec3<L> across_1, across_2, axis;
};

/// The axis uniform on the sphere.
template <class L>
Frame<L> frame(const L& u, const L& v) {
  const SinCos<L> azimuth = sincospi(v + v);
  const L cos_polar = L(1.0) - (u + u), sin_polar = L(2.0) * square_root(u * (L(1.0) - u));
  return {{cos_polar * azimuth.cos, cos_polar * azimuth.sin, -sin_polar},
          {-azimuth.sin, azimuth.cos, L(0.0)},
          {sin_polar * azimuth.cos, sin_polar * azimuth.sin, cos_polar}};
}

/// With a unit vector for its axis (T. Duff et al., "Building an orthonormal basis, revisited", J. Comput. Graph.
/// Tech. 6, 1, 2017).
template <class L>
Frame<L> frame_about(const Vec3<L>& n) {
  const L sign = select(n.z < L(0.0), L(-1.0), L(1.0));
  const L p = L(-1.0) / (sign + n.z), xy = (n.x * n.y) * p;
  return {{L(1.0) + sign * ((n.x * n.x) * p), sign * xy, -(sign * n.x)}, {xy, sign + (n.y * n.y) * p, -n.y}, n};
}

template <class L>
Frame<L> turned(const Frame<L>& f, const SinCos<L>& turn) {
  return {turn.cos * f.across_1 + turn.sin * f.across_2, turn.cos * f.across_2 - turn.sin * f.across_1, f.axis};
}

template <class L>
Vec3<L> scaled_to_unit(const Vec3<L>& v) {
  return (L(1.0) / norm(v)) * v;
}

/// 0, 1 ... n - 1, by the first digits of the pick, which keeps the others.
template <class L>
L sector_by(int n, L& pick) {
  const L rounder(0x1.8p52), scaled = L(static_cast<double>(n)) * pick;
  const L sector = ((scaled - L(0.5)) + rounder) - rounder;
  pick = scaled - sector;
  return sector;
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

}  // namespace vex
