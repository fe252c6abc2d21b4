// Where two polytopes in contact touch: the polygon in which their faces across the contact meet, as solvers of
// constraints want it.
#pragma once

#include <vector>

#include "engine/numeric/pose.h"
#include "engine/query/separation.h"
#include "engine/support/convex_body.h"

namespace vex {

/// In A's frame.
struct ContactManifold {
  struct Contact {
    // On the two faces, opposite each other along the normal; on edges that are parallel but for the feature angle, at
    // one place along them, and beside each other by no more than that angle times their length.
    Vec3d point_a, point_b;
    double signed_distance = 0.0;  // (point_b - point_a) . normal: negative where they are in each other
  };
  Separation separation;          // its normal is the manifold's
  std::vector<Contact> contacts;  // corners of a convex polygon, counter-clockwise seen against the normal; of faces
                                  // that meet in an edge or a point, two or one; none where the bodies are apart by
                                  // more than the margin. Corners within 2^-27 of the pair's reach are one
};

/// Of polytopes, rounded or not; any other body touches in one point, the separation's, with B's moved along the normal
/// to be at the signed distance. The faces are the vertices within `feature_angle` radians of the plane across the
/// normal; one face is clipped by the sides of the other (I. Sutherland, G. Hodgman, 1974). `margin`: contacts are
/// given up to this gap.
ContactManifold contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, double margin = 0.0,
                                 double feature_angle = 0.01);

}  // namespace vex
