// Corners of a face as heights over a plane, a few in each patch, for the question which of them is farthest above
// another plane: patches that are all below it by what is known of them are not looked at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/query/search/planar_polygon.h"

namespace vex {

struct ContactCorner {
  PlanarPoint at;
  double height;
  std::uint32_t number = 0;  // of its body's vertex
};

/// Of a height `slope` per length, through a corner.
struct ContactPlane {
  ContactCorner through;
  PlanarPoint slope;

  /// How far the corner is above it.
  double height_of(const ContactCorner& corner) const {
    return (corner.height - through.height) - dot(slope, corner.at - through.at);
  }
};

class ContactPatches {
 public:
  /// Of these corners from now on; memory is kept.
  void take(const std::vector<ContactCorner>& corners);

  /// None where none is above it by more than `least`, a length.
  const ContactCorner* farthest_above(const ContactPlane& plane, double least);

  /// The patches about a place, a few; and the same of their corners alone.
  void look_near(const PlanarPoint& place);
  const ContactCorner* farthest_near(const ContactPlane& plane, double least) const;
  /// Of those that are farther than `least` beyond a line of the plane, through `from` and across the unit vector
  /// `beyond`, the one that the plane comes to first if it is turned about the line, downwards from above them all.
  const ContactCorner* least_below(const ContactPlane& plane, const PlanarPoint& from, const PlanarPoint& beyond,
                                   double least) const;

 private:
  static constexpr std::size_t kNear = 4;

  // All of its corners are below a plane of its own, which goes about as they do.
  struct Patch {
    std::size_t from, to;
    PlanarPoint middle, half;
    ContactPlane cover;
  };

  Patch patch_of(std::size_t from, std::size_t to) const;
  void look_at(const Patch& patch, const ContactPlane& plane, double& least, const ContactCorner*& farthest) const;
  // No corner of it is higher above the plane.
  static double most_above(const Patch& patch, const ContactPlane& plane);

  std::vector<ContactCorner> corners_;
  std::vector<Patch> patches_;
  std::vector<double> most_above_;  // of each, the plane that is asked about
  std::array<std::size_t, kNear> near_{};
  std::size_t n_near_ = 0;
};

}  // namespace vex
