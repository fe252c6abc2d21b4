// The steps of a time of impact: for a certificate.
#pragma once

#include <vector>

#include "engine/query/first_contact.h"
#include "engine/query/half_space.h"

namespace vex {

/// Along `normal` the bodies are apart at every time from `from` to `to`.
struct ApartDuring {
  double from, to;
  Vec3d normal;
};

/// `time_of_impact`, and how it was found that there is no contact before the one that it tells.
FirstContact time_of_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion_a,
                            const RigidMotion& motion_b, double until, std::vector<ApartDuring>& record);
FirstContact time_of_impact(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                            double until, std::vector<ApartDuring>& record);

}  // namespace vex
