// Bodies of revolution about the z axis whose outline is arcs: their support mappings, for numbers and for packets.
//
// Their errors are E2's, whether operations are fused or not. A packet's directions are between 2^-200 and 2^200, so
// that no square underflows.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "engine/numeric/rounding.h"
#include "engine/numeric/vec3.h"
#include "engine/support/revolved.h"

namespace vex {

/// What two equal balls have in common: a rim in the plane z = 0.
struct LensProfile {
  /// The rim's radius, and half of the thickness.
  LensProfile(double rim_radius, double half_thickness) : radius(rim_radius), half(half_thickness) {
    ball_radius = 0.5 * (radius * (radius / half) + half);
    const double sine = radius / ball_radius;
    rim_sine_sq = sine * sine;
  }

  /// On the upper or the lower ball where the direction's angle to the axis is within the cap's; else on the rim. The
  /// height on a ball is H/2 - R_ball sin^2/(1 + cos): of a thin lens no large numbers cancel.
  template <class L>
  [[gnu::always_inline]] Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> unit = ball_support(L(1.0), dir);
    const L sine_sq = unit.x * unit.x + unit.y * unit.y;
    const L height = L(half) - L(ball_radius) * (sine_sq / (L(1.0) + absolute(unit.z)));
    const Vec3<L> on_ball{L(ball_radius) * unit.x, L(ball_radius) * unit.y, copy_sign(height, dir.z)};
    return select<L>(sine_sq > L(rim_sine_sq), disc_support(radius, dir), on_ball);
  }
  double support_error() const { return 48.0 * kUnitRoundoff * (radius + half); }

  double radius, half, ball_radius, rim_sine_sq;
};

/// What a segment of a circle sweeps as it turns about its chord.
struct SpindleProfile {
  /// Half of the length from tip to tip, and the radius at the equator.
  SpindleProfile(double half_length, double equator_radius) : half(half_length), radius(equator_radius) {
    arc_radius = 0.5 * (half * (half / radius) + radius);
    const double cosine = half / arc_radius;
    tip_cosine_sq = cosine * cosine;
  }

  /// On the arc where the direction is within its normals; else a tip. The radius there is R - R_arc cos^2/(1 + sin) of
  /// the direction's angle to the axis: of a slender one no large numbers cancel.
  template <class L>
  [[gnu::always_inline]] Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> unit = ball_support(L(1.0), dir);
    const L cosine_sq = unit.z * unit.z, sine = square_root(unit.x * unit.x + unit.y * unit.y);
    const L across = L(radius) - L(arc_radius) * (cosine_sq / (L(1.0) + sine));
    const Vec3<L> around = disc_support(1.0, dir);
    const Vec3<L> on_arc{across * around.x, across * around.y, L(arc_radius) * unit.z};
    const Vec3<L> tip{L(0.0), L(0.0), copy_sign(L(half), dir.z)};
    return select<L>(cosine_sq > L(tip_cosine_sq), tip, on_arc);
  }
  double support_error() const { return 48.0 * kUnitRoundoff * (radius + half); }

  double half, radius, arc_radius, tip_cosine_sq;
};

/// A ball between two planes across the axis.
struct CutBallProfile {
  /// The ball's radius, and how far below and above its middle the planes are.
  CutBallProfile(double ball_radius, double height_below, double height_above)
      : radius(ball_radius),
        below(height_below),
        above(height_above),
        below_rim(rim(height_below)),
        above_rim(rim(height_above)) {}

  /// On the ball, or on the rim of a face where the ball's point is beyond the plane.
  template <class L>
  [[gnu::always_inline]] Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> on_ball = ball_support(L(radius), dir), unit_rim = disc_support(1.0, dir);
    const L upper(above), lower(-below);
    const Vec3<L> on_upper{L(above_rim) * unit_rim.x, L(above_rim) * unit_rim.y, upper};
    const Vec3<L> on_lower{L(below_rim) * unit_rim.x, L(below_rim) * unit_rim.y, lower};
    return select<L>(on_ball.z > upper, on_upper, select<L>(lower > on_ball.z, on_lower, on_ball));
  }
  double support_error() const { return 16.0 * kUnitRoundoff * radius; }

  double radius, below, above, below_rim, above_rim;

 private:
  // Times a power of two, so that no product over- or underflows.
  double rim(double height) const {
    const int exponent = std::ilogb(radius);
    const double r = std::ldexp(radius, -exponent), h = std::ldexp(height, -exponent);
    return std::ldexp(std::sqrt((r - h) * (r + h)), exponent);
  }
};

/// Two half spheroids of one equator, in the plane z = 0.
struct EggProfile {
  /// The radius at the equator, and the heights below and above it.
  EggProfile(double equator_radius, double height_below, double height_above)
      : radius(equator_radius), below(height_below), above(height_above) {
    scaled = scaled_to_unit_exponent(Vec3d{radius, below, above});
  }

  /// D (D d / |D d|), D of the spheroid that the direction looks at; the inner D's are divided by a power of two (E14).
  template <class L>
  [[gnu::always_inline]] Vec3<L> support(const Vec3<L>& dir) const {
    const MaskOf<L> looks_up = dir.z > L(0.0);
    const L height = select(looks_up, L(above), L(below)), its_scaled = select(looks_up, L(scaled.z), L(scaled.y));
    const Vec3<L> image{L(scaled.x) * dir.x, L(scaled.x) * dir.y, its_scaled * dir.z};
    const Vec3<L> unit = ball_support(L(1.0), image);
    return {L(radius) * unit.x, L(radius) * unit.y, height * unit.z};
  }
  double support_error() const { return 8.0 * kUnitRoundoff * std::max({radius, below, above}); }

  double radius, below, above;
  Vec3d scaled;  // radius, below, above
};

using ProfileForm = std::variant<LensProfile, SpindleProfile, CutBallProfile, EggProfile>;

}  // namespace vex
