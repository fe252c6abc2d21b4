// A - B of two exact forms in double-double arithmetic, in coordinates of their own: what the searches behind the
// filter work on.
#pragma once

#include <vector>

#include "engine/numeric/double_double.h"
#include "engine/query/certificate.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

using Extended = DoubleDouble;
using Vec3e = Vec3<Extended>;

inline Vec3e extended(const Vec3d& v) { return broadcast<Extended>(v); }

inline Vec3d high_part(const Vec3e& v) { return {v.x.high, v.y.high, v.z.high}; }
inline Vec3d low_part(const Vec3e& v) { return {v.x.low, v.y.low, v.z.low}; }

/// Two exact forms, each about the middle of its points and centres, in units of 2^exponent: lengths are then those of
/// the bodies and of what is between them, however far from the origins of their frames they are (E15).
class LocalForms {
 public:
  explicit LocalForms(const PlacedForms& forms);

  struct Piece {
    Vec3e centre, semi_axes;
    bool is_dome;
  };
  /// A point of a body that is the farthest one in some direction.
  struct Farthest {
    Vec3e point;  // in A's directions; of B about its middle
    Vec3d own;    // in the coordinates of its form, rounded
    Extended height;
    bool is_any = false;
  };

  Farthest farthest_of_a(const Vec3e& dir) const;
  /// `dir` in A's frame, `dir_b` the same in B's.
  Farthest farthest_of_b(const Vec3e& dir, const Vec3e& dir_b) const;

  /// From A's middle to B's; and B's frame turned into A's, which the middles are taken out of.
  const Transform<Extended>& a_from_b() const { return a_from_b_; }
  const Extended& ball_radius() const { return ball_radius_; }
  /// From the origins of the bodies' frames to their middles, in A's directions; of a B that turns.
  Vec3e arm_of_a() const { return local(middle_a_, {}); }
  Vec3e arm_of_b() const;
  int exponent() const { return exponent_; }

 private:
  Vec3e local(const Vec3d& point, const Vec3d& middle) const;
  Vec3d own(const Vec3e& local, const Vec3d& middle) const;
  Vec3e turned(const Vec3e& point) const;  // from B's frame into A's directions
  Vec3e vertex_of_a(std::size_t i) const;
  Vec3e vertex_of_b(std::size_t i) const;
  Farthest farthest_piece(const std::vector<Piece>& pieces, const Vec3e& dir) const;

  const PlacedForms& forms_;
  int exponent_ = 0;
  Vec3d middle_a_, middle_b_;
  Vec3d middle_of_placed_b_;  // where B's points are rounded as placed: the middle of those, in A's frame
  std::vector<Piece> pieces_a_, pieces_b_;
  Transform<Extended> a_from_b_;
  Extended ball_radius_;
  mutable std::vector<Vec3e> vertices_a_, vertices_b_;  // once many of them tie
};

/// The points of a difference that were looked at, as witnesses.
struct ExtendedRecord {
  Vec3e at;
  Witness witness;
};

/// All roundings of a support point of `ExtendedDifference` and of its height together are below this (E15).
inline constexpr double kExtendedError = 0x1p-92;

/// A - B.
class ExtendedDifference {
 public:
  explicit ExtendedDifference(const LocalForms& forms, std::vector<ExtendedRecord>* records = nullptr)
      : forms_(forms), records_(records) {}

  Vec3e support(const Vec3e& dir) const;

  /// A lower bound of the signed gap, in the units of the forms: no point of A - B is nearer along `best_dir`, of all
  /// directions that were looked at. Positive where the bodies are proven to be disjoint.
  double gap_lower() const { return gap_lower_; }
  const Vec3e& best_dir() const { return best_dir_; }

 private:
  const LocalForms& forms_;
  std::vector<ExtendedRecord>* records_;
  mutable double gap_lower_ = -HUGE_VAL;
  mutable Vec3e best_dir_;
};

}  // namespace vex
