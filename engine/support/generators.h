// Zonotopes among the bodies: boxes, plates, needles and points, which are sums of segments.
#pragma once

#include <array>

#include "engine/numeric/vec3.h"

namespace vex {

/// {centre + sum of s_k g_k : |s_k| <= 1}. The difference of two such bodies is another one, whose faces are spanned by
/// pairs of the vectors: a query of a few pairs needs no search.
struct Generators {
  Vec3d centre;
  std::array<Vec3d, 3> vectors{};
  int n_vectors = 0;
};

}  // namespace vex
