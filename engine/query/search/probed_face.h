// What of a curved body is across a direction, from its support mapping alone: a face, an edge, or a point.
//
// The points of the surface that have a normal within the feature angle of a direction are what directions tilted by
// that angle about it find: the rim of a cap, the two ends of a line on which a cylinder lies. What shrinks with the
// angle is no face and no edge, but the surface that bends away.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/query/search/contact_feature.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Numbers of a curved body's points. Corners of a face have those below: each kCornersOfFace-th of a turn about the
/// face's normal one, the first along an axis of the body's frame, whichever direction is asked.
inline constexpr std::uint32_t kCornersOfFace = 16;
inline constexpr std::uint32_t kNearestPoint = 16;            // the point that the separation tells
inline constexpr std::uint32_t kEdgeFrom = 17, kEdgeTo = 18;  // the ends of an edge
inline constexpr std::uint32_t kWholeBody = (1U << 25) - 1;   // of a contact that no face has a part in

/// Points of the core, in the body's own frame. Of a face up to kCornersOfFace corners; of an edge, which is straight
/// to 2^-26 of the circumradius, its two ends; none of what is neither. `unit_dir`, and `nearest`, a point of the core
/// that is farthest along it, are in that frame, too.
void probe_face(const ConvexBody& body, const Vec3d& unit_dir, const Vec3d& nearest, double feature_angle,
                std::vector<NumberedPoint>& corners);

}  // namespace vex
