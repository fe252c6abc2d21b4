// What the radial estimator's map of rays has to know of a body: a point of it, an ellipsoid like it, and axes about
// which it is likely to be symmetric. Nothing but support points is asked for.
#pragma once

#include <array>
#include <cstdint>

#include "engine/numeric/lane.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/radial/frames.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A symmetric matrix. Units of length^2.
template <class L>
struct Symmetric {
  L xx{0.0}, yy{0.0}, zz{0.0}, xy{0.0}, xz{0.0}, yz{0.0};
};

/// L with L L^T = Q, that takes z to z and x and y there by a symmetric matrix: if Q is turned about z, L goes with it,
/// on both sides.
///
///       | sxx sxy  0 |
///   L = | sxy syy  0 |
///       |  bx  by zz |
template <class L>
struct Root {
  L sxx, syy, sxy, bx, by, zz;
  L one_by_det, one_by_zz;  // the first of the matrix of x and y

  /// L v
  Vec3<L> operator()(const Vec3<L>& v) const {
    return {sxx * v.x + sxy * v.y, sxy * v.x + syy * v.y, (bx * v.x + by * v.y) + zz * v.z};
  }
  /// L^-1 v
  Vec3<L> inverse(const Vec3<L>& v) const {
    const L x = one_by_det * (syy * v.x - sxy * v.y), y = one_by_det * (sxx * v.y - sxy * v.x);
    return {x, y, one_by_zz * ((v.z - bx * x) - by * y)};
  }
  /// L^-T v: across the image of the unit sphere where that is L v.
  Vec3<L> normal(const Vec3<L>& v) const {
    const L z = one_by_zz * v.z, x = v.x - bx * z, y = v.y - by * z;
    return {one_by_det * (syy * x - sxy * y), one_by_det * (sxx * y - sxy * x), z};
  }
  L determinant() const { return (sxx * syy - sxy * sxy) * zz; }
};

/// A pivot that rounding, or a flat body, leaves without a size is kept at 2^-50 of the trace, which rounding does not
/// reach. The root of a matrix M of two rows is (M + d) / sqrt(tr M + 2 d), d^2 = det M (Cayley and Hamilton).
template <class L>
Root<L> root_of(const Symmetric<L>& q) {
  const L least = L(0x1p-50) * ((q.xx + q.yy) + q.zz);
  const L xx = larger(q.xx, least), yy = larger(q.yy, least), trace = xx + yy;
  const L d = square_root(larger(xx * yy - q.xy * q.xy, least * trace));
  const L scale = L(1.0) / square_root(trace + (d + d));
  Root<L> root;
  root.sxx = scale * (xx + d);
  root.syy = scale * (yy + d);
  root.sxy = scale * q.xy;
  root.one_by_det = L(1.0) / (root.sxx * root.syy - root.sxy * root.sxy);
  root.bx = root.one_by_det * (root.syy * q.xz - root.sxy * q.yz);
  root.by = root.one_by_det * (root.sxx * q.yz - root.sxy * q.xz);
  root.zz = square_root(larger((q.zz - root.bx * root.bx) - root.by * root.by, least));
  root.one_by_zz = L(1.0) / root.zz;
  return root;
}

/// Its eigenvalues, from the largest on, to within 2^-50 of that.
std::array<double, 3> principal_values(const Symmetric<double>& q);

/// An ellipsoid like the body, of which nothing but its support points is asked: the directions that are uniform
/// normals of the ellipsoid have support points with the mean `centre`, a point of the body, and Q is 3 times the mean
/// of their squares (s - centre)(s - centre)^T. Of an ellipsoid not thinner than 2^-24 it is the ellipsoid, of a box
/// that of the half edges; what turns and stretches the body turns and stretches it. Found by a few rounds of the
/// equation, with as many directions as are symmetric about x, y and z like a cube.
struct MatchingEllipsoid {
  Vec3d centre;
  Symmetric<double> q;
};
MatchingEllipsoid matching_ellipsoid(const ConvexBody& body);

/// Everything here is a guess that only the estimator's variance depends on.
struct RadialBody {
  enum class Form {
    lump,
    rod,   // one direction in which it is long
    slab,  // one direction in which it is short
  };

  Vec3d centre;
  /// A rotation whose rows are the body's own axes. z is the one in which it is unlike the others. If there is none,
  /// and the frame's axes are not alike by the body's turns, nor are opposite sides, it is towards the farthest corner.
  Transformd axes;
  bool is_upright = true;  // axes is I
  Symmetric<double> q;     // of the matching ellipsoid, in the axes
  Form form = Form::lump;
  Turns turns;
};
RadialBody radial_body(const ConvexBody& body);

}  // namespace vex
