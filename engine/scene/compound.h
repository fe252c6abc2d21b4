// A compound: the union of convex bodies that stand fast in one frame; a static mesh of triangles is one of them. What
// it is asked of another body is asked of the parts that a tree of their boxes lets near.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/numeric/pose_algebra.h"
#include "engine/query/first_contact.h"
#include "engine/query/half_space.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/scene/aabb_tree.h"
#include "engine/support/convex_body.h"

namespace vex {

/// One of the convex bodies, which copies share.
struct CompoundPart {
  ConvexBody body;
  Pose compound_from_part{};
};

/// Never changes; queries may run in several threads at once.
class Compound {
 public:
  static constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();

  /// Parts are numbered as they come, and may overlap each other. Throws InputError where there is none, or one reaches
  /// farther than 1e100.
  explicit Compound(std::vector<CompoundPart> parts);

  std::size_t size() const { return parts_.size(); }
  const ConvexBody& body(std::size_t part) const { return parts_[part].body; }
  const Pose& compound_from_part(std::size_t part) const { return parts_[part].compound_from_part; }

  /// Of a body with this pose in the compound's frame, its pose in the part's: `relative_pose`, or, of a part that
  /// stands in the compound's own frame, the pose as it is, to the bit. Throws InputError where rotations that are no
  /// better than 2e-7 make a product that is none.
  Pose part_from_b(std::size_t part, const Pose& compound_from_b) const;
  /// The other way round: a part's pose in the frame that has the compound at this pose.
  Pose frame_from_part(std::size_t part, const Pose& frame_from_compound) const;
  /// Whether the part stands in the compound's own frame.
  bool is_in_place(std::size_t part) const { return is_in_place_[part]; }

  /// Boxes of the parts, each of which holds its part as seen from any other body's frame; and of all of them.
  const AabbTree& tree() const { return tree_; }
  const Aabb& bounds() const { return bounds_; }

 private:
  std::vector<CompoundPart> parts_;
  std::vector<bool> is_in_place_;
  AabbTree tree_;
  Aabb bounds_;
};

/// The surface of triangles that stand in one frame: a part for each, so that it is answered about with its vertices as
/// they are. It is a surface, and what is wholly inside it touches nothing. Throws InputError where there is none, or a
/// coordinate is not finite.
Compound compound_of_triangles(std::span<const std::array<Vec3d, 3>> triangles);

// What a query of a compound A is about: the union of its parts, each seen with the pose `part_from_b` of B, or of a
// part of B. That pose is the input of a proven answer, as `relative_pose` is of two bodies with poses in the world
// (world_queries.h). Parts that stand in the compound's own frame, as triangles do, are all asked about the same pose,
// the one given: then it is the union itself that is answered about, without any rounding between parts.

struct CompoundVerdict {
  /// Overlap: two parts share a point, proven. Disjoint: all are apart, proven; of those whose boxes are, by that.
  /// Undecided: neither, some pair of parts being undecided.
  Verdict verdict;
  std::uint32_t part_a = Compound::kNoPart, part_b = Compound::kNoPart;  // such a pair; of a convex B part_b is 0
  std::uint32_t n_pairs = 0;                                             // pairs of parts asked
};

CompoundVerdict overlap(const Compound& a, const ConvexBody& b, const Pose& a_from_b);
CompoundVerdict overlap(const Compound& a, const Compound& b, const Pose& a_from_b);

/// Pairs of parts; a convex B's part is 0.
struct PartPair {
  std::uint32_t a, b;
  friend auto operator<=>(const PartPair&, const PartPair&) = default;
};
/// A caller's buffer, which keeps its memory. Sorted.
struct PartPairs {
  std::vector<PartPair> pairs;      // proven to share a point
  std::vector<PartPair> undecided;  // neither that nor the opposite is proven
};
/// All of them: what contacts are asked of, pair by pair, with part_from_b.
void overlapping_parts(const Compound& a, const ConvexBody& b, const Pose& a_from_b, PartPairs& out);
void overlapping_parts(const Compound& a, const Compound& b, const Pose& a_from_b, PartPairs& out);

struct CompoundSeparation {
  /// The least over all pairs of parts, in A's frame; `point_b_in_b` in the frame of B's part. Lengths are as the part
  /// of A sees them.
  Separation separation;
  std::uint32_t part_a = Compound::kNoPart, part_b = Compound::kNoPart;
  std::uint32_t n_pairs = 0;
};

/// As `distance` of two bodies: 0, without witnesses, where the unions overlap; bounds are on both sides of the true
/// distance of the unions, undecided pairs among it. With `max_distance`, `disjoint` with an infinite `upper` and no
/// witnesses says that no part is nearer; `lower` is then that distance. It never is more where `upper` is, for parts
/// whose boxes are farther away are not asked.
///
/// There is no penetration depth: the way out of a union leads past all of its parts, so it is no shorter than the
/// largest depth of a pair of parts, and may be any amount longer. `overlapping_parts` tells whose depths there are.
CompoundSeparation distance(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                            const SeparationSettings& settings = {});
CompoundSeparation distance(const Compound& a, const Compound& b, const Pose& a_from_b,
                            const SeparationSettings& settings = {});

/// Of a half-space A, as the parts of B have it, placed by `frame_from_part`. Here the depth is that of the union: the
/// deepest part's.
CompoundSeparation signed_distance(const HalfSpace& a, const Compound& b, const Pose& a_from_b);

struct CompoundContact {
  /// In A's frame. Overlap: the union is met, proven, between `lower` and `upper`; a part that may be met before, and
  /// is not proven to be, only makes `lower` less. Undecided: none is proven to be met, and some may be, not before
  /// `lower`.
  FirstContact contact;
  std::uint32_t part_a = Compound::kNoPart, part_b = Compound::kNoPart;
  std::uint32_t n_pairs = 0;
};

/// As the functions of two bodies with these names, motions in A's frame. A part that is not in place sees them turned
/// by R^T, rounded: these are what is answered about (world_queries.h). Of a compound B every part goes through A's
/// tree.
CompoundContact cast_ray(const Compound& a, const Vec3d& origin, const Vec3d& dir, double until = HUGE_VAL);
CompoundContact linear_cast(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion,
                            double until = HUGE_VAL);
CompoundContact linear_cast(const Compound& a, const Compound& b, const Pose& a_from_b, const Vec3d& motion,
                            double until = HUGE_VAL);
CompoundContact time_of_impact(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                               double until = HUGE_VAL);
/// Both may move, each turning about the origin of its frame: of a compound that turns, parts that do not stand in that
/// origin are asked about with their points told from it, each rounded once. Where a body that turns is far from where
/// it could touch is told by boxes of intervals of time.
CompoundContact time_of_impact(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                               const RigidMotion& motion_a, const RigidMotion& motion_b, double until = HUGE_VAL);
CompoundContact time_of_impact(const Compound& a, const Compound& b, const Pose& a_from_b, const RigidMotion& motion_a,
                               const RigidMotion& motion_b, double until = HUGE_VAL);

/// Onto a half-space A, all parts of B, which is placed as for `signed_distance`.
CompoundContact linear_cast(const HalfSpace& a, const Compound& b, const Pose& a_from_b, const Vec3d& motion,
                            double until = HUGE_VAL);
CompoundContact time_of_impact(const HalfSpace& a, const Compound& b, const Pose& a_from_b, const RigidMotion& motion,
                               double until = HUGE_VAL);

/// Many poses of B: out[k] is what the query above answers for a_from_b[k], whatever the number of threads. Spans of
/// one length, or UsageError.
void overlap(const Compound& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<CompoundVerdict> out,
             int n_threads = 1);
void distance(const Compound& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<CompoundSeparation> out,
              const SeparationSettings& settings = {}, int n_threads = 1);

}  // namespace vex
