// Superellipsoids (A. H. Barr, 1981) about the origin, and superballs (Y. Jiao, F. H. Stillinger and S. Torquato, Phys.
// Rev. Lett. 100, 245504, 2008), which are those with equal sizes and exponents.
#pragma once

#include "engine/numeric/rounding.h"
#include "engine/numeric/vec3.h"
#include "engine/support/power_form.h"
#include "engine/support/support_mapping.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

/// (|x/a|^2P + |y/b|^2P)^(Q/P) + |z/c|^2Q <= 1, P and Q from 1/2 to 1000: an octahedron, an ellipsoid, a cylinder (P =
/// 1, Q large) and a box in one. The body has no exact form: where double precision proves nothing, queries are
/// undecided.
class Superellipsoid {
 public:
  /// Semi-axes along x, y, z; P across the z axis and Q along it. Throws InputError where they are out of range.
  Superellipsoid(double semi_axis_x, double semi_axis_y, double semi_axis_z, double exponent_across,
                 double exponent_along);

  /// The point where Hoelder's inequality is an equality, in the plane and then with the axis. From `std::pow`, and in
  /// double alone.
  Vec3d support(const Vec3d& dir) const;
  /// Where `std::pow` is within two units in the last place (glibc: one), E2.
  double support_error() const { return 128.0 * kUnitRoundoff * (axes_.x + axes_.y + axes_.z); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

  PowerForm power_form() const { return {axes_, across_.p, along_.p}; }

  Vec3d semi_axes() const { return axes_; }
  double exponent_across() const { return 0.5 * across_.p; }
  double exponent_along() const { return 0.5 * along_.p; }

  /// V by gamma functions. S = 3 V <|d|> over the body's cone measure, d the point of the dual body of the normal
  /// there; M = 3 V* <1/|d|^4> over the dual body's (superellipsoid.cpp), both by a quadrature that is refined until it
  /// stands still to 1e-12, and otherwise refused by an InputError.
  Measures measures() const;
  SolidMoments solid_moments() const;
  NormalMeasure area_measure() const;
  NormalMeasure mean_curvature_measure() const;

 private:
  /// The unit circle of the norm (u^p + v^p)^(1/p), and of its dual.
  struct Curve {
    explicit Curve(double exponent);
    /// The point of the curve farthest along (u, v), both >= 0, and how far that is.
    struct Farthest {
      double u, v, height;
    };
    Farthest farthest(double u, double v) const;

    double p;        // 2P
    double inverse;  // 1/p
    double power;    // 1/(p - 1), infinite for p = 1
  };
  double largest_reach() const;
  double least_reach() const;

  Vec3d axes_;
  Curve across_, along_;
  double circumradius_ = 0.0, inradius_ = 0.0;
};

class Superball : public Superellipsoid {
 public:
  /// |x|^2P + |y|^2P + |z|^2P <= R^2P: R is half the width along x, y and z.
  Superball(double exponent, double radius) : Superellipsoid(radius, radius, radius, exponent, exponent) {}
};

}  // namespace vex
