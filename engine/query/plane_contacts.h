// Where a body touches a half-space: its points near the plane, with names that stay from step to step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/query/half_space.h"
#include "engine/support/convex_body.h"

namespace vex {

/// In the frame of the half-space.
struct PlaneContact {
  Vec3d point_a, point_b;        // on the plane, and of the body; opposite each other along the normal
  double signed_distance = 0.0;  // (point_b - point_a) . normal: negative where the point is in the half-space
  std::uint32_t feature = 0;     // which point of the body: the same number in every step
};

/// The points of a body that may touch a plane, looked up once; asked in any number of poses without an allocation but
/// the caller's buffer's, from several threads at once.
///
/// Of a polytope, rounded or not, its vertices. Of a curved part its lowest point, and where it is flat, or has a flat
/// face (the caps of a cylinder, a disc, the base of a cone, the face of a hemisphere), four points of the rim, a
/// quarter apart: a cylinder stands on the four of its cap and lies on the lowest ones of both. Of a face that leans by
/// less than 2^-40 these alone, so that up to 2^-41 of its radius may be missing. Of a body without an exact form the
/// support point alone.
class PlaneContacts {
 public:
  explicit PlaneContacts(const ConvexBody& b);

  /// Overwrites `out` with all points that are no farther than `margin` above the plane, in the order of their
  /// features. Each point is one of the body to the errors of `signed_distance`, and its distance is as near. Whether
  /// there is a contact at all is for `overlap` to say: within those errors of the margin a point may be missing or be
  /// there. Throws UsageError for a margin that is no number.
  void find(const HalfSpace& a, const Pose& a_from_b, double margin, std::vector<PlaneContact>& out) const;

 private:
  struct Part {
    ExactForm::Piece piece;
    std::array<Vec3d, 6> rim{};  // in B's frame
    int n_rim = 0;
    std::uint32_t feature = 0;  // of its lowest point; behind it the rim's
  };

  ConvexBody body_;
  std::vector<Vec3d> vertices_;
  std::vector<Part> parts_;
  bool has_form_ = false;
};

}  // namespace vex
