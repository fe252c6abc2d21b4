// The support mappings of superellipsoids, and of bodies of revolution whose outlines are arcs, over packets.
#pragma once

#include <variant>

#include "engine/numeric/packet_powers.h"
#include "engine/query/packets/packet_core.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

/// As the superellipsoid's own mapping (E2), with logarithms and powers of packets (E32).
struct PowersCore : BoundsDirection {
  explicit PowersCore(const CoreForm& form)
      : BoundsDirection(form),
        semi_axes(form.semi_axes),
        across(form.across),
        along(form.along),
        has_one_power(across.power == along.power && across.inverse == along.inverse) {}

  template <class L>
  __attribute__((noinline)) Vec3<L> support(const Vec3<L>& dir) const {
    const L x = L(semi_axes.x) * absolute(dir.x), y = L(semi_axes.y) * absolute(dir.y);
    const L z = L(semi_axes.z) * absolute(dir.z);
    if (has_one_power) return of_one_power(dir, x, y, z);
    const Farthest<L> plane = farthest(across, x, y), whole = farthest(along, plane.height, z);
    return {copy_sign(L(semi_axes.x) * (plane.u * whole.u), dir.x),
            copy_sign(L(semi_axes.y) * (plane.v * whole.u), dir.y), copy_sign(L(semi_axes.z) * whole.v, dir.z)};
  }

  Vec3d semi_axes;
  CoreForm::PowerCurve across, along;
  bool has_one_power;

 private:
  // Of a superball, or one that is stretched: all three coordinates at once, which halves the chain of operations that
  // wait for each other.
  template <class L>
  Vec3<L> of_one_power(const Vec3<L>& dir, const L& x, const L& y, const L& z) const {
    const L largest = larger(larger(larger(x, y), z), L(0x1p-1000)), least(0x1p-900), power(across.power);
    const std::array<L, 3> ratio{larger(x / largest, least), larger(y / largest, least), larger(z / largest, least)};
    const auto [log_u, log_v, log_w] = logarithms(ratio);
    const auto [u, v, w] = exponentials(std::array{power * log_u, power * log_v, power * log_w});
    const L scale = exponential(L(-across.inverse) * logarithm((ratio[0] * u + ratio[1] * v) + ratio[2] * w));
    return {copy_sign(L(semi_axes.x) * (scale * u), dir.x), copy_sign(L(semi_axes.y) * (scale * v), dir.y),
            copy_sign(L(semi_axes.z) * (scale * w), dir.z)};
  }
  template <class L>
  struct Farthest {
    L u, v, height;
  };
  // The point of the curve farthest along (u, v), both 0 or more, and how far that is. A ratio below 2^-900 is taken
  // for that, which changes no height by more than 2^-900 of the larger.
  template <class L>
  static Farthest<L> farthest(const CoreForm::PowerCurve& curve, const L& u, const L& v) {
    const L largest = larger(u, v);
    const L ratio = larger(smaller(u, v) / larger(largest, L(0x1p-1000)), L(0x1p-900));
    const L beside = exponential(L(curve.power) * logarithm(ratio));
    const L far = exponential(L(-curve.inverse) * logarithm(L(1.0) + ratio * beside)), near = beside * far;
    const MaskOf<L> is_u = u >= v;
    return {select(is_u, far, near), select(is_u, near, far), largest * (far + ratio * near)};
  }
};

/// The body's own mapping, or of an egg the ellipsoid's as above.
struct ProfileCore : BoundsDirection {
  explicit ProfileCore(const CoreForm& form) : BoundsDirection(form) {
    if (form.profile) profile = *form.profile;
  }

  template <class L>
  __attribute__((noinline)) Vec3<L> support(const Vec3<L>& dir) const {
    return std::visit([&](const auto& its) { return its.support(dir); }, profile);
  }

  ProfileForm profile = EggProfile(1.0, 1.0, 1.0);
};

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
