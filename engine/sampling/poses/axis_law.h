// How the axis of one body is distributed about a common axis: the part of an orientation law that is about one body.
//
// A law is a density over cos(theta), theta the polar angle; all azimuths are alike. It is drawn by inverting the
// cumulated density, without rejection: in closed form for cones, Onsager's trial function and densities that are
// piecewise linear, by polynomials between exact points for Maier and Saupe's. No C library function and no fused
// operation: an angle is the same bits everywhere.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/numeric/elementary.h"

namespace vex {

/// A density over cos(theta), linear between its points and 0 outside of them; of any scale.
struct AxisTable {
  std::vector<double> cosines;    // ascending, within [-1, 1]
  std::vector<double> densities;  // not negative
  bool operator==(const AxisTable&) const = default;
};

/// What the polar coordinate is looked up in: pieces of the cumulated density.
struct AxisPieces;

/// A value: cheap to copy, never changes.
class AxisLaw {
 public:
  enum class Kind {
    isotropic,    // uniform in solid angle
    aligned,      // along the common axis
    cone,         // within an angle of it, up or down
    onsager,      // Onsager's trial function
    maier_saupe,  // Maier and Saupe's
    table,        // a density given by points
  };
  static constexpr double kLargestMaierSaupe = 1000.0;
  static constexpr std::size_t kMostPoints = 100000;  // of a table

  AxisLaw();  // isotropic
  static AxisLaw aligned();
  /// cos(theta) uniform on [cos(degrees), 1] times a random sign. 0 <= degrees <= 90.
  static AxisLaw cone(double degrees);
  /// Density proportional to cosh(alpha cos(theta)) (L. Onsager, Ann. N.Y. Acad. Sci. 51, 627, 1949). alpha >= 0.
  static AxisLaw onsager(double alpha);
  /// Density proportional to exp(A P_2(cos(theta))), P_2(x) = (3 x^2 - 1) / 2 (W. Maier, A. Saupe, Z. Naturforsch. 14a,
  /// 882, 1959): A > 0 along the common axis, A < 0 across it, 0 isotropic. |A| <= kLargestMaierSaupe.
  static AxisLaw maier_saupe(double strength);
  /// Two points at least, at most kMostPoints. Throws InputError where it is no density.
  static AxisLaw table(AxisTable table);

  Kind kind() const { return kind_; }
  /// Degrees, alpha, or A; 0 of all others.
  double parameter() const { return parameter_; }
  /// isotropic, aligned, cone:30, onsager:5, maier-saupe:4; of a table the checksum of its numbers,
  /// table:0123456789abcdef, whichever file they are from.
  std::string name() const;
  /// The points of a table, its integral made 1; null of all others.
  const AxisTable* points() const;
  /// The mean of P_2(cos theta): closed, or exact integrals between the points of a table, or for Maier and Saupe's law
  /// by quadrature, to some 1e-14.
  double order_parameter() const;
  /// Whether every axis is along the common one, up or down.
  bool is_along() const { return kind_ == Kind::aligned || (kind_ == Kind::cone && parameter_ == 0.0); }

  friend bool operator==(const AxisLaw& x, const AxisLaw& y);

  template <class L>
  struct Polar {
    L sin, cos;
  };
  /// For a coordinate of the open unit interval, an odd multiple of 2^-53. The cumulated density at what is drawn is
  /// off by at most 2^-43 (E31).
  template <class L>
  Polar<L> polar_angle(const L& u) const;

 private:
  template <class L>
  L piece_at(const L& v) const;
  template <class L>
  L along_polynomials(const L& v) const;
  template <class L>
  L along_lines(const L& v) const;
  void look_up_in(std::shared_ptr<const AxisPieces> pieces);

  Kind kind_ = Kind::isotropic;
  double parameter_ = 0.0;
  double height_ = 1.0;  // of cone: 1 - cos(degrees), of isotropic 1; of onsager: 1 - exp(-2 alpha)
  std::shared_ptr<const AxisPieces> pieces_;
  // Of the pieces, by their numbers, for kernels that share no inline function: the cumulated density where a piece
  // begins, filled up with infinities to a power of two, and columns of what is within.
  const double* cumulated_ = nullptr;
  const double* column_[7] = {};
  double half_of_all_ = 0.0;
};

/// The last piece that begins at or below v.
template <class L>
L AxisLaw::piece_at(const L& v) const {
  L index = L(0.0);
  for (double step = half_of_all_; step >= 1.0; step *= 0.5) {
    const L probe = index + L(step);
    index = select(gather(cumulated_, probe) <= v, probe, index);
  }
  return index;
}

/// The inverse of the cumulated density between two of its points, with its first two derivatives at both: columns are
/// where the piece begins, one over its share, and five coefficients.
template <class L>
L AxisLaw::along_polynomials(const L& v) const {
  const L piece = piece_at(v);
  const L t = (v - gather(cumulated_, piece)) * gather(column_[1], piece);
  L x = gather(column_[6], piece);
  for (int k = 5; k >= 2; --k) x = gather(column_[k], piece) + t * x;
  return gather(column_[0], piece) + t * x;
}

/// d for a density that is linear in a piece, f + s x: m = f x + s x^2 / 2. Columns are where the piece begins, how
/// long it is, f, and 2 s.
template <class L>
L AxisLaw::along_lines(const L& v) const {
  const L piece = piece_at(v);
  const L m = v - gather(cumulated_, piece);
  const L f = gather(column_[2], piece);
  const L root = square_root(larger(f * f + gather(column_[3], piece) * m, L(0.0)));
  const L x = (m + m) / larger(f + root, L(0x1p-1000));  // 0 / 0 where a piece begins with no density
  const L longest = gather(column_[1], piece);
  return gather(column_[0], piece) + select(x > longest, longest, x);
}

/// sin and cos of the polar angle. But for a table the coordinate's upper bit is the sign of cos, and the rest is
/// spread over d = 1 - |cos|: of a cone uniformly; of onsager over 1 - cos of the density exp(alpha cos), of which with
/// both signs cosh is made.
template <class L>
AxisLaw::Polar<L> AxisLaw::polar_angle(const L& u) const {
  const L one = L(1.0), two = L(2.0), zero = L(0.0), twice = u + u;
  if (kind_ == Kind::aligned) return {zero, one};
  MaskOf<L> up = twice > one;
  const L v = select(up, twice - one, twice);  // exact, and never 0 or 1: u is an odd multiple of 2^-53
  L d;
  if (kind_ == Kind::table) {
    d = along_lines(u);
    up = one > zero;
  } else if (kind_ == Kind::maier_saupe) {
    d = along_polynomials(v);
    if (parameter_ < 0.0) d = one - d;
  } else if (kind_ != Kind::onsager) {
    d = L(height_) * v;
  } else if (parameter_ < 0x1p-60) {
    d = v + v;  // exp(alpha cos) is 1 to rounding
  } else {
    d = minus_log_of_complement(L(height_) * v) / L(parameter_);
  }
  d = select(d > two, two, d);  // which only rounding can exceed
  d = select(d < zero, zero, d);
  const L cos = one - d;
  return {square_root(d * (two - d)), select(up, cos, -cos)};
}

}  // namespace vex
