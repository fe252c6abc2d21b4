// What the tests of apps/referees run over, and what they ask of every test of a pair.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "apps/referees/exact_referee.h"
#include "engine/query/overlap_backend.h"
#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {

inline Outcome decide_one(OverlapBackend& backend, const Transformd& pose) {
  Verdict verdict;
  backend.decide({&pose, 1}, {&verdict, 1});
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

/// One after the other, rounded.
inline Transformd turned_by(const Transformd& second, const Transformd& first) {
  const auto column = [&](const Vec3d& e) { return second(first(e)); };
  const Vec3d x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, {}};
}

/// The factor of `step` at which B, moved outwards, comes apart from A; to the last bits.
inline double contact_factor(const ConvexBody& a, const ConvexBody& b, Transformd pose, const Vec3d& step) {
  double together = 0.0, apart = 4.0 * (a.reach() + b.reach()) / norm(step);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (together + apart);
    pose.translation = middle * step;
    (exact_outcome(a, b, pose) == Outcome::overlap ? together : apart) = middle;
  }
  return together;
}

/// Counts of what a sample held.
struct Held {
  int n_overlap = 0, n_disjoint = 0, n_undecided = 0;
};

/// The verdict is the exact one, or undecided; undecided only where a shift of `band` (in units of `rounding_unit`)
/// along the translation changes the exact one. Bodies hold a ball of `inner` each, which the obliquity of the contact is
/// bounded by.
inline void expect_right(OverlapBackend& backend, const ConvexBody& a, const ConvexBody& b, const Transformd& pose,
                         double band, Held& held) {
  const Outcome found = decide_one(backend, pose);
  if (found == Outcome::undecided) {
    ++held.n_undecided;
    const double relative = band * rounding_unit(a, b, pose) / (a.inradius() + b.inradius());
    Transformd nearer = pose, farther = pose;
    nearer.translation = (1.0 - relative) * pose.translation;
    farther.translation = (1.0 + relative) * pose.translation;
    EXPECT_EQ(exact_outcome(a, b, nearer), Outcome::overlap);
    EXPECT_EQ(exact_outcome(a, b, farther), Outcome::disjoint);
    return;
  }
  EXPECT_EQ(found, exact_outcome(a, b, pose));
  ++(found == Outcome::overlap ? held.n_overlap : held.n_disjoint);
}

/// Along `step`, from contact to either side by every power of ten from 1e-3 to 1e-16, relative.
inline void expect_right_near_contact(OverlapBackend& backend, const ConvexBody& a, const ConvexBody& b, Transformd pose,
                                      const Vec3d& step, double band, Held& held) {
  const double contact = contact_factor(a, b, pose, step);
  for (int digits = 3; digits <= 16; ++digits) {
    for (const double sign : {-1.0, 1.0}) {
      pose.translation = (contact * (1.0 + sign * std::pow(10.0, -digits))) * step;
      expect_right(backend, a, b, pose, band, held);
    }
  }
}

}  // namespace vex
