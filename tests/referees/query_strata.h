// What queries are asked about where they are hardest: pairs of bodies, poses and motions in strata.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/query/first_contact.h"
#include "engine/support/convex_body.h"

namespace vex {

struct QueryScene {
  std::string a_text, b_text;
  ConvexBody a, b;
  Transformd pose;
  RigidMotion motion;       // of B beside A's velocity; of a cast the velocity alone
  RigidMotion motion_a;     // of impacts alone
  double until = HUGE_VAL;  // of motions

  std::string text() const;  // enough to ask again
};

struct QueryStratum {
  std::string name;
  std::function<QueryScene(std::mt19937_64& random, int k)> scene;
};

/// ordinary, thin, touching, leaving, grazing, parallel, coaxial, far, tiny and huge, fast, hulls of up to 1000
/// vertices, far from the origins of their own frames.
const std::vector<QueryStratum>& query_strata();

}  // namespace vex
