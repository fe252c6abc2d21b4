// Corners of a face as heights over a plane, a few in each patch, for the question which of them is farthest above
// another plane: patches that are all below it by what is known of them are not looked at.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/query/search/planar_polygon.h"

namespace vex {

struct ContactCorner {
  PlanarPoint at;
  double height;
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
  ContactPatches() = default;
  explicit ContactPatches(std::vector<ContactCorner> corners);

  /// None where none is above it by more than `least`, a length.
  const ContactCorner* farthest_above(const ContactPlane& plane, double least) const;

 private:
  // All of its corners are below a plane of its own, which goes about as they do.
  struct Patch {
    std::size_t from, to;
    PlanarPoint middle, half;
    ContactPlane cover;
  };

  Patch patch_of(std::size_t from, std::size_t to) const;

  std::vector<ContactCorner> corners_;
  std::vector<Patch> patches_;
};

}  // namespace vex
