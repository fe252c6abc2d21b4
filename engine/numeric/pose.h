// A pose that has been looked at: of one body in another's frame.
#pragma once

#include "engine/numeric/transform.h"

namespace vex {

/// What queries take. It is made of a Transform, which it checks, so that queries need not: a matrix that mirrors or
/// that is no rotation, NaN and infinity are refused. R is then taken as it is (transform.h).
class Pose {
 public:
  /// Entries of R^T R may be off by this much.
  static constexpr double kRotationTolerance = 1e-6;

  Pose() = default;
  /// Throws InputError.
  Pose(const Transformd& a_from_b) : a_from_b_(a_from_b) { check(); }  // NOLINT(google-explicit-constructor): a test
  /// Of what is known to be a pose, in loops: drawn or checked before, or moved along from one that was.
  static Pose unchecked(const Transformd& a_from_b) { return Pose(a_from_b, Known{}); }

  const Transformd& a_from_b() const { return a_from_b_; }

 private:
  struct Known {};
  Pose(const Transformd& a_from_b, Known) : a_from_b_(a_from_b) {}
  void check() const;

  Transformd a_from_b_;
};

/// The largest magnitude of an entry of R^T R - 1; infinite where one is not finite.
double distance_from_rotation(const Transformd& pose);
/// To within Pose::kRotationTolerance, and no reflection.
bool is_rotation(const Transformd& pose);

}  // namespace vex
