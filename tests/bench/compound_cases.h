// A landscape of triangles and bodies about it, for timing compounds beside a loop over the triangles and FCL.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

struct CompoundCase {
  std::vector<std::array<Vec3d, 3>> triangles;
  std::string body_name;
  ConvexBody body;
  std::vector<Pose> poses;
};

/// What another library answers: whether it sees an overlap; a distance, or 0.
struct CompoundPeer {
  std::function<bool(std::size_t pose)> overlap;
  std::function<double(std::size_t pose)> distance;
};
/// FCL's tree of oriented boxes and swept spheres with its default solver; empty functions without FCL.
CompoundPeer fcl_compound(const CompoundCase& of);

}  // namespace vex
