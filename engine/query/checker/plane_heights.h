// How high a body is over a plane, as the checker of what half-spaces answer takes it: exactly (docs/derivations.md,
// E29; internal).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/turning.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/half_space_certificate.h"

namespace vex::checker {

using whole::Dyadic;
using whole::DyadicVector;
using Clear = HalfSpaceCertificate::Clear;

inline Dyadic magnitude(const Dyadic& x) { return whole::sign(x) < 0 ? -x : x; }

// The sign of p + r sqrt(s), s >= 0.
inline int sign_with_root(const Dyadic& p, const Dyadic& r, const Dyadic& s) {
  const int of_p = whole::sign(p), of_r = whole::sign(s) == 0 ? 0 : whole::sign(r);
  if (of_p == 0 || of_r == 0 || of_p == of_r) return of_p != 0 ? of_p : of_r;
  return of_p * whole::sign(p * p - r * r * s);
}
// The sign of e - sqrt(f) - q sqrt(g), f and g >= 0.
inline int sign_of_height(const Dyadic& e, const Dyadic& f, const Dyadic& q, const Dyadic& g) {
  const int of_rest = sign_with_root(e, -q, g);
  if (of_rest <= 0) return of_rest == 0 && whole::sign(f) == 0 ? 0 : -1;
  // (e - q sqrt(g))^2 - f
  return sign_with_root(e * e + q * q * g - f, Dyadic(-2.0) * e * q, g);
}

// A body over a plane, at rest or moved straight: all that is asked of it is told by the signs of algebraic numbers.
class Heights {
 public:
  Heights(const HalfSpace& a, const ExactPair& pair, const Transformd& pose)
      : normal_(whole::exactly(a.dir_normal())), normal_sq_(dot(normal_, normal_)), pair_(pair), offset_(a.offset()) {
    const ExactForm& form = pair.b();
    for (const Vec3d& point : form.points) {
      const DyadicVector placed =
          form.is_polytope() ? whole::exactly(pose(point)) : exactly(pose)(whole::exactly(point));
      items_.push_back({dot(normal_, placed) - offset_, {}});
    }
    const DyadicVector up = exactly(pose).direction_to_b(normal_);
    for (const ExactForm::Piece& piece : form.pieces) {
      const Dyadic x = Dyadic(piece.semi_axes.x) * up.x, y = Dyadic(piece.semi_axes.y) * up.y,
                   z = Dyadic(piece.semi_axes.z) * up.z;
      const bool has_z = !piece.is_dome || whole::sign(up.z) < 0;
      items_.push_back({dot(normal_, exactly(pose)(whole::exactly(piece.centre))) - offset_,
                        x * x + y * y + (has_z ? z * z : Dyadic())});
    }
  }

  // Of the least height, all of them raised, less `length` times the normal's.
  int sign_of_least(const Dyadic& length, const Dyadic& raised = {}) const {
    int least = 1;
    for (const auto& [centre, spread] : items_) {
      const int sign = sign_of_height(centre + raised, spread, length + Dyadic(pair_.b().ball_radius), normal_sq_);
      least = std::min(least, sign);
    }
    return least;
  }

  const DyadicVector& normal() const { return normal_; }
  const Dyadic& normal_sq() const { return normal_sq_; }
  const Dyadic& offset() const { return offset_; }

 private:
  struct Item {
    Dyadic centre, spread;
  };
  DyadicVector normal_;
  Dyadic normal_sq_;
  const ExactPair& pair_;
  Dyadic offset_;
  std::vector<Item> items_;
};

// A body that turns while it moves, its vertices not rounded.
class TurningHeights {
 public:
  TurningHeights(const Heights& heights, const ExactPair& pair, const Transformd& pose, const RigidMotion& motion,
                 const Vec3d& centre)
      : heights_(heights),
        pair_(pair),
        pose_(pose),
        motion_(motion),
        w_(whole::exactly(motion.angular_velocity)),
        turning_(cross(heights.normal(), w_)),
        rate_(dot(heights.normal(), whole::exactly(motion.velocity))),
        bent_(root_from_above(dot(turning_, turning_)) *
              pair.moved(exactly(pose)).reach_of_b_across(w_, whole::exactly(centre))),
        origin_(dot(heights.normal(), whole::exactly(pose.translation)) - heights.offset()) {}

  bool stays_clear(const Clear& interval) const {
    const Dyadic from(interval.from), to(interval.to), a_half(1, -1);
    if (interval.from == 0.0 && is_clear(exactly(pose_), Dyadic(), Dyadic(), Dyadic()) &&
        is_clear(exactly(pose_), Dyadic(), to, to)) {
      return true;
    }
    const Dyadic half = a_half * (to - from);
    const std::optional<ExactPose> middle = pose_at(pose_, motion_, a_half * (from + to));
    return middle && is_clear(*middle, a_half * (from + to), half, half) &&
           is_clear(*middle, a_half * (from + to), -half, half);
  }
  // The ball about the body's origin is over the plane.
  bool is_far_at(const Dyadic& time) const {
    const Dyadic reach = Dyadic(1.0000016) * pair_.reach_of_b() + Dyadic(pair_.b().ball_radius);
    return is_more_than(origin_ + time * rate_, reach, heights_.normal_sq());
  }
  bool is_far_after(double time) const { return whole::sign(rate_) >= 0 && is_far_at(Dyadic(time)); }
  bool has_turned_once(double time) const {
    const Dyadic turns = Dyadic(time) * Dyadic(time) * dot(w_, w_), once(6.283185307179588);
    return whole::sign(rate_) == 0 && !(turns < once * once);
  }
  bool meets(double time, const std::vector<Witness>& lowest) const {
    const std::optional<ExactPose> pose = pose_at(pose_, motion_, Dyadic(time));
    if (!pose || lowest.empty() || !are_finite(lowest)) return false;
    const ExactPair moved = pair_.moved(*pose);
    const Dyadic height = dot(heights_.normal(), moved.point_of_b(lowest.front())) - heights_.offset();
    return is_at_least(-height, moved.margin() - Dyadic(pair_.b().ball_radius), heights_.normal_sq());
  }

 private:
  // About a time at which B's pose is known, `by` earlier or later: the least of linear functions of it, less what
  // points bend out of them in `longest`.
  bool is_clear(const ExactPose& pose, const Dyadic& about, const Dyadic& by, const Dyadic& longest) const {
    ExactPose turn = pose;
    turn.translation = {};
    const Dyadic lowest = -pair_.moved(turn).support_of_b(-(heights_.normal() + times(by, turning_)));
    const Dyadic bent = Dyadic(1, -1) * longest * longest * bent_;
    return is_more_than(origin_ + (about + by) * rate_ + lowest - bent, Dyadic(pair_.b().ball_radius),
                        heights_.normal_sq());
  }

  const Heights& heights_;
  const ExactPair& pair_;
  const Transformd& pose_;
  const RigidMotion& motion_;
  DyadicVector w_, turning_;
  Dyadic rate_, bent_, origin_;
};

}  // namespace vex::checker
