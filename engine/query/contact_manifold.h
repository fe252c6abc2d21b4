// Where two bodies in contact touch: the polygon in which their faces across the contact meet, as solvers of
// constraints want it.
#pragma once

#include <memory>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/query/feature_id.h"
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
    // What of A and what of B makes the contact. From step to step the same pair of them is the same contact, as long
    // as the same vertices, edges and faces touch: for warm starts. No two of 64 contacts or fewer have both in common.
    FeatureId feature_a = 0, feature_b = 0;
  };
  Separation separation;          // its normal is the manifold's
  std::vector<Contact> contacts;  // corners of a convex polygon, counter-clockwise seen against the normal; of faces
                                  // that meet in an edge or a point, two or one; none where the bodies are apart by
                                  // more than the margin. Corners within 2^-27 of the pair's reach are one, of a pair
                                  // with a curved body within 6e-8 of it
};

struct ManifoldSettings {
  /// Contacts are given up to this gap, a length from 0 up.
  double margin = 0.0;
  /// What of a body is within so many radians of the plane across the normal is its face; up to pi/2.
  double feature_angle = 0.01;
  /// Four contacts at most: those of the largest area, and the deepest. They span at least .61 of the polygon's area,
  /// and half of that at least where the deepest has to be put among them, which happens where it is deeper
  /// than all of them by more than a 64th of the feature angle times the smaller side of a box around the polygon.
  bool four_at_most = false;
};

/// Throws UsageError where the margin or the angle is negative or no number, or the angle above pi/2.
void check(const ManifoldSettings& settings);

/// What manifolds are made in: a thread that keeps one has nothing allocated once it has seen manifolds as large. It
/// holds nothing of one manifold that the next depends on.
class ManifoldMemory {
 public:
  ManifoldMemory();
  ~ManifoldMemory();
  ManifoldMemory(ManifoldMemory&&) noexcept;
  ManifoldMemory& operator=(ManifoldMemory&&) noexcept;

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// The contacts of any two bodies. One face is clipped by the sides of the other (I. Sutherland, G. Hodgman, 1974).
///
/// *Polytopes*, rounded or not: the face is the vertices within the feature angle of the plane across the normal.
/// Vertices are numbered as in the exact form. Points are on the faces to within rounding; those of a rounded one,
/// whose ball is added along the contact's normal, are below its surface by up to half the feature angle's square times
/// the radius. Facets that are less than the feature angle apart are one face: gaps at its corners are off from the
/// deepest point's by up to that angle times the face's width.
///
/// *Any other body* is asked for its support points in directions tilted by the feature angle about the normal, so that
/// a body of one's own works as well, and cylinders, cones, hemispheres, rounded discs are no special cases.
/// - What is flat about the normal, as a cap, becomes a polygon of sixteen corners, support points all: one each 22.5
///   degrees about the cap's own normal, from an axis of the body's frame on, so that they are the same points of the
///   body from step to step however it leans within the feature angle, unless that normal crosses 45 degrees from x. Of
///   a disc that is .974 of its area, and the polygon is off the rim by .0192 radii at most. The separation's own point
///   comes to them where it is farther out by more than sin(feature_angle) times R_A + R_B, or deeper by more than a
///   1024th of that; where the middle of a face is deepest by as much it is the one contact. So there is always a
///   contact about as deep as the separation. Points are on the body, or, where the face is not flat but bends by less
///   than the feature angle, in it and below its surface by no more than tan(feature_angle) times the face's width.
/// - A straight line within the feature angle, on which a cylinder, cone or frustum lies, becomes an edge of two ends,
///   each to within the support mapping's error and the normal's own. Which end has which name may change as the body
///   turns. The line of a coin's rim, a tenth of its radius or shorter, is looked for at narrower angles, down to a
///   512th of that one: a coin that leans by more, or is thinner than three thousandths of its radius, may have one end
///   of it. A body that leans nearly by the feature angle may have part of its rim besides.
/// - What bends away is the separation's point, one contact; with B's moved along the normal to be at the signed
///   distance.
/// The points of pairs with such a body, and their gaps along the normal, are as near to the truth as the separation
/// (1e-9 of |signed distance| + R_A + R_B, `promised_accuracy`). Where its search gave more than 1e-6 of that away, its
/// point is the one contact.
///
/// `warm_start`: as for `signed_distance`, of which it may be the same pair's.
///
/// Throws UsageError where `check` of the settings does.
void contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ManifoldSettings& settings,
                      ManifoldMemory& memory, ContactManifold& manifold, WarmStart* warm_start = nullptr);

/// The same, with memory of the thread's own for all but the contacts.
ContactManifold contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, double margin = 0.0,
                                 double feature_angle = 0.01);

}  // namespace vex
