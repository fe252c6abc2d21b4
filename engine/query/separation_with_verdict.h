// Distances and depths for queries that have asked `overlap` about the same pose already, or will: where bounds leave
// the sign open its answer decides, and of bodies that touch that is as dear as all the rest.
#pragma once

#include <optional>

#include "engine/query/exact/placed_forms.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"

namespace vex {

/// As the functions without `overlap`, which is what `overlap_answer` says of the bodies in that pose; where it is
/// empty it receives what that says, if it is asked. `n_support_calls` counts what is asked here.
Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           std::optional<OverlapAnswer>& overlap);
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings,
                    WarmStart* warm_start, std::optional<OverlapAnswer>& overlap);
Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             std::optional<OverlapAnswer>& overlap);

/// `signed_distance` of bodies that touch, or nearly, whose points and normal alone are asked for: where its bounds
/// leave the sign open nothing is asked about it, and the verdict is undecided.
Separation distance_of_any_sign(const ConvexBody& a, const ConvexBody& b, const Pose& pose);

/// What `overlap_answer` says of the bodies as their forms are placed.
OverlapAnswer overlap_answer(const ConvexBody& a, const ConvexBody& b, const PlacedForms& placed);

}  // namespace vex
