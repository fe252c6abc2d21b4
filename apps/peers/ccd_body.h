// Bodies as libccd takes them: by the engine's own support mappings.
#pragma once

#include <ccd/ccd.h>

#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// What libccd's queries are handed. They pass it on as constant; the counter is ours.
struct CcdBody {
  const ConvexBody* body = nullptr;
  const Transformd* a_from_b = nullptr;  // none for A, which stays in its own frame
  unsigned long n_support_calls = 0;

  /// After so many calls the body answers with a point behind the origin, which ends every loop of libccd.
  bool has_given_up() const;
};

/// libccd's defaults, but for the support mappings and centres, which are those of two CcdBodies.
ccd_t ccd_of_bodies();

}  // namespace vex
