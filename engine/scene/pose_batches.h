// One pair of bodies in many poses: distances, depths and casts into a caller's buffer, in threads.
#pragma once

#include <span>

#include "engine/numeric/pose.h"
#include "engine/query/first_contact.h"
#include "engine/query/separation.h"
#include "engine/support/convex_body.h"

namespace vex {

// out[k] is what the query of one pose with the same name answers of a_from_b[k], whatever the number of threads and
// the machine's instruction set. First the packets that decide overlaps are asked (overlap_backend.h): where they prove
// that there is no distance, or no depth, nothing is searched. Distances and casts of bodies that are apart begin where
// packets guess the nearest points, or where the motion meets the body (packets/nearest_guess.h, cast_guess.h): they
// are as near as those of the query of one pose, and their last digits are others. Depths are the query's to the bit,
// but for `n_support_calls` and the stage in `verdict.by`. Nothing is kept from one pose to the next. Spans of one
// length and at least one thread, or UsageError.

void signed_distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                     std::span<Separation> out, const SeparationSettings& settings = {}, int n_threads = 1);
void distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<Separation> out,
              const SeparationSettings& settings = {}, int n_threads = 1);
void penetration_depth(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                       std::span<Separation> out, const SeparationSettings& settings = {}, int n_threads = 1);

/// Motions of B, one for each pose.
void linear_cast(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                 std::span<const Vec3d> motions, std::span<FirstContact> out, double until = HUGE_VAL,
                 int n_threads = 1);
/// Rays against one body, in its frame.
void cast_ray(const ConvexBody& a, std::span<const Vec3d> origins, std::span<const Vec3d> dirs,
              std::span<FirstContact> out, double until = HUGE_VAL, int n_threads = 1);

}  // namespace vex
