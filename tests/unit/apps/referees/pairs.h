// What the tests of apps/referees run over, and what they ask of every test of a pair.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "apps/referees/exact_referee.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "tests/referees/random_poses.h"

namespace vex {

inline Outcome decide_one(OverlapBackend& backend, const Transformd& pose) {
  const Verdict verdict = backend.decide(pose);
  EXPECT_EQ(verdict.by, DecidedBy::peer);
  EXPECT_NE(verdict.reason, UndecidedReason::iteration_cap);
  return verdict.outcome;
}

/// u times the sizes that the error bounds are counted in.
inline double rounding_unit(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  return 0x1p-53 * (a.reach() + 2.0 * b.reach() + norm_1(pose.translation));
}

/// A rotation by `angle_rad` about an axis.
inline Transformd rotation_about(const Vec3d& dir, double angle_rad) {
  const Vec3d n = (1.0 / norm(dir)) * dir;
  const double s = std::sin(angle_rad), c = 1.0 - std::cos(angle_rad);
  return {{1.0 - c * (n.y * n.y + n.z * n.z), c * n.x * n.y - s * n.z, c * n.x * n.z + s * n.y},
          {c * n.x * n.y + s * n.z, 1.0 - c * (n.x * n.x + n.z * n.z), c * n.y * n.z - s * n.x},
          {c * n.x * n.z - s * n.y, c * n.y * n.z + s * n.x, 1.0 - c * (n.x * n.x + n.y * n.y)},
          {}};
}

/// Counts of what a sample held.
struct Held {
  int n_overlap = 0, n_disjoint = 0, n_undecided = 0;
};

/// B moved outwards along a ray until it comes apart from A.
///
/// The common part of a ray and A - B is a segment, so the exact referee, which is slow, need be asked only within
/// `shift_of_doubt` of the contact: verdicts beyond follow from two there. (Rounding of placed vertices moves a box by
/// less than a thousandth of that.)
class Ray {
 public:
  Ray(const ConvexBody& a, const ConvexBody& b, const Transformd& turn, const Vec3d& step)
      : a_(a), b_(b), pose_(turn), step_(step) {
    // Placed boxes are where the exact referee is slow, and where the engine is exact or, with a ball, silent.
    const bool ask_the_engine = b.target<Box>() != nullptr;
    double together = 0.0, apart = 4.0 * (a.reach() + b.reach()) / norm(step);
    for (int k = 0; k < 58; ++k) {
      const double middle = 0.5 * (together + apart);
      pose_.translation = middle * step;
      Outcome outcome = ask_the_engine ? overlap(a, b, pose_).outcome : Outcome::undecided;
      if (outcome == Outcome::undecided) outcome = exact_outcome(a, b, pose_);
      (outcome == Outcome::overlap ? together : apart) = middle;
    }
    contact_ = together;
    shift_of_doubt_ = 1e-2 * relative_band(1e5, at(0.0));
    EXPECT_EQ(exact_outcome(a_, b_, at(-shift_of_doubt_)), Outcome::overlap);
    EXPECT_EQ(exact_outcome(a_, b_, at(shift_of_doubt_)), Outcome::disjoint);
  }

  /// B at this relative distance beyond the contact.
  Transformd at(double shift) const {
    Transformd pose = pose_;
    pose.translation = (contact_ * (1.0 + shift)) * step_;
    return pose;
  }
  Outcome exact_at(double shift) const {
    if (std::fabs(shift) <= shift_of_doubt_) return exact_outcome(a_, b_, at(shift));
    return shift < 0.0 ? Outcome::overlap : Outcome::disjoint;
  }
  /// The relative shift that opens or closes a gap of `units` (of `rounding_unit`) at the least: contacts are no more
  /// oblique than the inscribed balls allow.
  double relative_band(double units, const Transformd& pose) const {
    return units * rounding_unit(a_, b_, pose) / (a_.inradius() + b_.inradius());
  }

  /// The verdict is the exact one, or undecided; undecided only where a shift of `band` (in units of `rounding_unit`)
  /// changes the exact one.
  void expect_right(OverlapBackend& backend, double shift, double band, Held& held) const {
    const Outcome found = decide_one(backend, at(shift));
    if (found == Outcome::undecided) {
      ++held.n_undecided;
      const double relative = relative_band(band, at(shift));
      EXPECT_EQ(exact_at(shift - relative), Outcome::overlap);
      EXPECT_EQ(exact_at(shift + relative), Outcome::disjoint);
      return;
    }
    EXPECT_EQ(found, exact_at(shift));
    ++(found == Outcome::overlap ? held.n_overlap : held.n_disjoint);
  }

  /// From contact to either side by powers of ten from 1e-3 to 1e-16, relative.
  void expect_right_near_contact(OverlapBackend& backend, double band, Held& held) const {
    for (const int digits : {3, 6, 9, 12, 13, 14, 15, 16}) {
      expect_right(backend, -std::pow(10.0, -digits), band, held);
      expect_right(backend, std::pow(10.0, -digits), band, held);
    }
  }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  Transformd pose_;
  Vec3d step_;
  double contact_ = 0.0, shift_of_doubt_ = 0.0;
};

}  // namespace vex
