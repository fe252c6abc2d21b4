// The map from the unit cube to the rays of the radial estimator.
//
// V_ex(R) is the volume of K = A - RB. About a point of K, and for any regular matrix L,
//   |K| = det L * integral over the unit sphere of r(L e)^3 / 3 = mean over uniform e of (4 pi / 3) det L r(L e)^3,
// r being the radial function: L^-1 K has the volume |K| / det L and the radial function r(L e). L may depend on R. The
// nearer L^-1 K is to a ball, the less is left to vary: L L^T = Q_A + R Q_B R^T, Q being the matrix of an ellipsoid
// like the body. In the ball's place there may be any body: with d on the surface of a parallelepiped P, so that parts
// of it have the share of the volume that is between them and the centre, |K| = mean of |P| r(d)^3 (E19). So it is done
// where bodies are long.
#pragma once

#include <array>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "engine/numeric/elementary.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/block.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/radial/frames.h"
#include "engine/sampling/radial/radial_body.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/sampling/radial/radial_steps.h"
#include "engine/support/convex_body.h"

namespace vex {

template <class L>
struct RadialRay {
  Transform<L> rotation;
  Vec3<L> dir;
  std::array<Vec3<L>, 3> normals;  // of the ellipsoid's, around where the ray leaves it
  L pick{0.0};
  L weight{0.0};  // times r(dir)^3: the volume whose mean is V_ex
};

/// What a pair's rays are made of, but for the law, which is somebody else's: a copy is made of numbers alone.
class RadialNumbers {
 public:
  /// The law must outlive this.
  RadialNumbers(const ConvexBody& a, const ConvexBody& b, const OrientationLaw* law);

  /// Of each body the point that coincides with the other's where rays begin.
  BodyPoints points() const {
    return is_swapped_ ? BodyPoints{b_.centre, a_.centre} : BodyPoints{a_.centre, b_.centre};
  }

  static constexpr int kMaxDimension = 3 + OrientationLaw::kMaxDimension;
  /// Coordinates of the unit cube: two for e, those of the law, and the pick.
  int dimension() const { return 3 + law_->dimension(); }

  template <class L>
  RadialRay<L> operator()(std::span<const L> point) const {
    RadialRay<L> ray;
    ray.pick = point[2 + static_cast<std::size_t>(law_->dimension())];
    Transform<L> own;  // R as the bodies' own axes see it
    Frame<L> at;       // about e, in A's axes
    if (law_->kind() == OrientationLaw::Kind::isotropic) {
      if (has_block()) {
        // Where B's axis is as A sees it, and how B is turned about it.
        const L azimuth = in_some_sector(a_.turns.n_sectors, point[3], ray.pick);
        const L turn = in_some_sector(b_.turns.n_sectors, point[4], ray.pick);
        own = columns(turned(frame(point[2], azimuth), sincospi(turn + turn)));
      } else {
        at = frame_of_body(a_.turns, point[0], point[1], ray.pick);
        const Frame<L> as_b_sees = frame_of_body(b_.turns, point[2], point[3], ray.pick);
        own = rotation_to(turned(at, sincospi(point[4] + point[4])), as_b_sees);
      }
      ray.rotation = in_frames(own);
    } else {
      const Transform<L> r = law_->rotation(point.subspan(2, static_cast<std::size_t>(law_->dimension())));
      ray.rotation = is_swapped_ ? transposed(r) : r;
      own = in_own_axes(ray.rotation);
      if (!has_block()) at = frame(point[0], point[1]);
    }
    const Root<L> root = root_of(of_difference(own));
    Vec3<L> image;
    if (has_block()) {
      const Block<L> reference = block(own, root);
      image = reference.surface_point(point[0], point[1]);
      at = frame_about(scaled_to_unit(image));
      ray.weight = reference.volume;
    } else {
      image = at.axis;
      ray.weight = L(4.0 / 3.0 * std::numbers::pi) * root.determinant();
    }
    // K = A - RB is -R (B - R^T A).
    const auto in_frame = [&](const Vec3<L>& v) {
      const Vec3<L> of_a = a_.is_upright ? v : (v.x * axis<L>(a_, 0) + v.y * axis<L>(a_, 1)) + v.z * axis<L>(a_, 2);
      return is_swapped_ ? -ray.rotation.direction_to_b(of_a) : of_a;
    };
    ray.dir = in_frame(root(image));
    // Three normals about e. Were they alike, or one of them in a plane of symmetry, the next support point would be on
    // the ray, or in a plane with it and a corner, where the portal's side is left to rounding: for many round bodies.
    const auto leaning = [&](double to_1, double to_2) {
      return in_frame(
          root.normal((at.axis + L(kRadialSpread * to_1) * at.across_1) + L(kRadialSpread * to_2) * at.across_2));
    };
    ray.normals = {leaning(1.07, 0.16), leaning(-0.60, 0.83), leaning(-0.43, -0.94)};
    if (is_swapped_) ray.rotation = transposed(ray.rotation);
    return ray;
  }

  /// Whether K is thinner than 2^-22 of its length at most orientations, as of a needle and a ball of 1e-8: double
  /// precision does not tell the frame in which it is round, and few rays have most of the volume.
  bool is_too_thin() const;

  /// Whether K is compared with a parallelepiped rather than with an ellipsoid.
  bool has_block() const { return long_body_ != LongBody::none; }

 private:
  enum class LongBody { none, a, b, both };

  template <class L>
  static Transform<L> columns(const Frame<L>& f) {
    return {{f.across_1.x, f.across_2.x, f.axis.x},
            {f.across_1.y, f.across_2.y, f.axis.y},
            {f.across_1.z, f.across_2.z, f.axis.z},
            {}};
  }

  // The rotation that takes B's axis to A's, with a turn about it. Uniform over all rotations, whatever A's is, if B's
  // axis and the turn are. So one pair of coordinates is where the ray is as A sees it, another as B does, on whose
  // directions r depends more than on the turn: quasi-random points are best where few coordinates matter together.
  template <class L>
  static Transform<L> rotation_to(const Frame<L>& a, const Frame<L>& b) {
    const auto row = [&b](const L& x, const L& y, const L& z) {
      return (x * b.across_1 + y * b.across_2) + z * b.axis;
    };
    return {row(a.across_1.x, a.across_2.x, a.axis.x),
            row(a.across_1.y, a.across_2.y, a.axis.y),
            row(a.across_1.z, a.across_2.z, a.axis.z),
            {}};
  }

  template <class L>
  static Transform<L> transposed(const Transform<L>& r) {
    return {
        {r.row_x.x, r.row_y.x, r.row_z.x}, {r.row_x.y, r.row_y.y, r.row_z.y}, {r.row_x.z, r.row_y.z, r.row_z.z}, {}};
  }
  template <class L>
  static Vec3<L> axis(const RadialBody& body, int k) {
    return broadcast<L>(k == 0 ? body.axes.row_x : k == 1 ? body.axes.row_y : body.axes.row_z);
  }
  /// A^T R B, the rows of A and B being the bodies' axes.
  template <class L>
  Transform<L> in_frames(const Transform<L>& own) const {
    Transform<L> r = own;
    if (!b_.is_upright) {
      const auto row = [this](const Vec3<L>& v) {
        return (v.x * axis<L>(b_, 0) + v.y * axis<L>(b_, 1)) + v.z * axis<L>(b_, 2);
      };
      r = {row(r.row_x), row(r.row_y), row(r.row_z), {}};
    }
    if (a_.is_upright) return r;
    const Vec3d &x = a_.axes.row_x, &y = a_.axes.row_y, &z = a_.axes.row_z;
    const auto row = [&r](double along_x, double along_y, double along_z) {
      return (L(along_x) * r.row_x + L(along_y) * r.row_y) + L(along_z) * r.row_z;
    };
    return {row(x.x, y.x, z.x), row(x.y, y.y, z.y), row(x.z, y.z, z.z), {}};
  }
  /// A R B^T
  template <class L>
  Transform<L> in_own_axes(const Transform<L>& in_frames) const {
    Transform<L> r = in_frames;
    if (!b_.is_upright) {
      const auto row = [this](const Vec3<L>& v) {
        return Vec3<L>{dot(v, axis<L>(b_, 0)), dot(v, axis<L>(b_, 1)), dot(v, axis<L>(b_, 2))};
      };
      r = {row(r.row_x), row(r.row_y), row(r.row_z), {}};
    }
    if (a_.is_upright) return r;
    const auto row = [&r](const Vec3<L>& v) { return (v.x * r.row_x + v.y * r.row_y) + v.z * r.row_z; };
    return {row(axis<L>(a_, 0)), row(axis<L>(a_, 1)), row(axis<L>(a_, 2)), {}};
  }

  /// Q_A + R Q_B R^T, in A's axes.
  template <class L>
  Symmetric<L> of_difference(const Transform<L>& r) const {
    const Symmetric<double>&q_a = a_.q, &q_b = b_.q;
    const auto times_q_b = [&q_b](const Vec3<L>& v) -> Vec3<L> {
      return {(L(q_b.xx) * v.x + L(q_b.xy) * v.y) + L(q_b.xz) * v.z,
              (L(q_b.xy) * v.x + L(q_b.yy) * v.y) + L(q_b.yz) * v.z,
              (L(q_b.xz) * v.x + L(q_b.yz) * v.y) + L(q_b.zz) * v.z};
    };
    const Vec3<L> x = times_q_b(r.row_x), y = times_q_b(r.row_y), z = times_q_b(r.row_z);
    return {L(q_a.xx) + dot(r.row_x, x), L(q_a.yy) + dot(r.row_y, y), L(q_a.zz) + dot(r.row_z, z),
            L(q_a.xy) + dot(r.row_x, y), L(q_a.xz) + dot(r.row_x, z), L(q_a.yz) + dot(r.row_y, z)};
  }

  // In the coordinates before L. Where bodies are long, K is nearly the sum of two lines, and as thick as both. L^-1
  // makes the lines as long as each other and nearly orthogonal; so two edges are taken along both, but made
  // orthogonal, the third across. Of one long body and a flat one the lines are the one's axis, and where the other's
  // normal is across that. Edges are as long as the two ellipsoids' heights together, which is more than the root of
  // the sum of their squares.
  template <class L>
  Block<L> block(const Transform<L>& own, const Root<L>& root) const {
    const L zero(0.0), one(1.0), least(0x1p-40);
    const Vec3<L> axis_a = scaled_to_unit(root.inverse({zero, zero, one}));
    const Vec3<L> axis_b = scaled_to_unit(root.inverse({own.row_x.z, own.row_y.z, own.row_z.z}));
    Vec3<L> first, second;
    if (long_body_ == LongBody::both) {
      const Vec3<L> sum = axis_a + axis_b, difference = axis_a - axis_b;
      const MaskOf<L> is_opposite = dot(sum, sum) < least;
      first = select<L>(is_opposite, difference, sum);
      second = select<L>(is_opposite, sum, difference);
    } else {
      first = long_body_ == LongBody::a ? axis_a : axis_b;
      second = long_body_ == LongBody::a ? axis_b : axis_a;
    }
    first = scaled_to_unit(first);
    second = second - dot(second, first) * first;
    second = scaled_to_unit(select<L>(dot(second, second) < least, frame_about(first).across_1, second));
    const Vec3<L> third = cross(first, second);
    Block<L> found;
    if (long_body_ == LongBody::both) {
      const L diagonal(0.5 * std::numbers::sqrt2);
      found = {diagonal * (first + second), diagonal * (first - second), third, zero};
    } else {
      found = {second, third, first, zero};
    }
    found.volume = L(8.0) * root.determinant();
    const auto lengthen = [&](Vec3<L>& edge) {
      const L of_a = larger(height_sq_of_a(root.normal(edge)), zero), of_b = larger(one - of_a, zero);
      const L height = square_root(of_a) + square_root(of_b);
      edge = height * edge;
      found.volume = found.volume * height;
    };
    lengthen(found.x);
    lengthen(found.y);
    lengthen(found.z);
    return found;
  }
  /// n^T Q_A n
  template <class L>
  L height_sq_of_a(const Vec3<L>& n) const {
    const Symmetric<double>& q = a_.q;
    const L mixed = (L(q.xy) * (n.x * n.y) + L(q.xz) * (n.x * n.z)) + L(q.yz) * (n.y * n.z);
    return ((L(q.xx) * (n.x * n.x) + L(q.yy) * (n.y * n.y)) + L(q.zz) * (n.z * n.z)) + (mixed + mixed);
  }
  const OrientationLaw* law_;
  RadialBody a_, b_;         // A and B throughout; of the caller's it is B and A if they are swapped
  bool is_swapped_ = false;  // to begin with the body that has an axis: rays are told apart by the angle with it
  LongBody long_body_ = LongBody::none;
};

/// The same with a law of its own.
class RadialMap : public RadialNumbers {
 public:
  RadialMap(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law)
      : RadialMap(std::make_shared<const OrientationLaw>(law), a, b) {}

 private:
  RadialMap(std::shared_ptr<const OrientationLaw> law, const ConvexBody& a, const ConvexBody& b)
      : RadialNumbers(a, b, law.get()), law_of_all_copies_(std::move(law)) {}

  std::shared_ptr<const OrientationLaw> law_of_all_copies_;
};

}  // namespace vex
