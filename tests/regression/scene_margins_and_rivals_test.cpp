// What a second reader with referees of his own found in scenes: pairs within a distance that were decided for a
// rounded sum of a radius and the distance; first hits that nothing proved to be the first; a neighbour of unknown
// distance that was preferred; and cells as large as a scene is wide, because of one body far away.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "shapes/sphere.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Transformd at(const Vec3d& place) {
  Transformd pose;
  pose.translation = place;
  return pose;
}

// A body whose half width along x is exactly `half`, and how it is made.
struct Wide {
  ConvexBody body;
  double half;
  bool has_vertices;
};

// The sum was rounded, and of it the answer was proven: two bodies on the x axis, a last place or two from the margin.
TEST(SceneMargins, AreThoseAskedForAndNoRoundedSums) {
  std::mt19937_64 random(21);
  int n_within = 0, n_apart = 0, n_undecided = 0, n_rounded = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto size = [&] { return 0.1 + random_in_unit_interval(random); };
    const auto some_body = [&]() -> Wide {
      const double half = size();
      if (random() % 2 == 0) return {Sphere(half), half, false};
      return {Box(2.0 * half, 3.0, 3.0), half, true};
    };
    const Wide a = some_body(), b = some_body();
    const double margin = size();
    double x = a.half + b.half + margin;
    for (std::uint64_t n = random() % 3; n > 0; --n) x = std::nextafter(x, random() % 2 == 0 ? 0.0 : 10.0);
    Scene scene;
    scene.add(a.body, at({0, 0, 0}));
    scene.add(b.body, at({x, 0, 0}));
    ScenePairs found;
    scene.pairs_within(margin, found);
    // A polytope's vertices are rounded where it is placed, and are the input then; those of one that has a ball about
    // it, such as the margin, are not: both are what was asked.
    const Rational exact = Rational(x) - Rational(b.half) - Rational(a.half);
    const Rational placed = b.has_vertices ? Rational(x - b.half) - Rational(a.half) : exact;
    n_rounded += Rational(a.half + margin) != Rational(a.half) + Rational(margin) ? 1 : 0;
    if (!found.undecided.empty()) {
      ++n_undecided;
    } else if (found.pairs.empty()) {
      ++n_apart;
      ASSERT_GT(std::max(exact, placed), Rational(margin)) << k;
    } else {
      ++n_within;
      ASSERT_LE(std::min(exact, placed), Rational(margin)) << k;
    }
  }
  EXPECT_GT(n_within, 500);
  EXPECT_GT(n_apart, 500);
  EXPECT_LT(n_undecided, 2000);
  EXPECT_GT(n_rounded, 1000);
}

// Times were compared, and not what is known of them.
TEST(SceneRivals, OfAFirstHitAreListed) {
  std::mt19937_64 random(22);
  int n_listed = 0, n_later = 0;
  for (int k = 0; k < 4000; ++k) {
    const double x = 2.0 + 8.0 * random_in_unit_interval(random), from = random_in_unit_interval(random),
                 dir = 0.1 + random_in_unit_interval(random);
    double places[2] = {x, x};
    for (std::uint64_t n = random() % 4; n > 0; --n) places[0] = std::nextafter(places[0], 20.0);
    Scene scene;
    scene.add(Box(1, 1, 1), at({places[0], 0.1, 0}));
    scene.add(Box(1, 1, 1), at({places[1], -0.1, 0}));
    const SceneHit hit = scene.cast_ray({from, 0, 0}, {dir, 0, 0});
    ASSERT_NE(hit.body, kNoBody);
    const BodyId first = places[0] < places[1] ? 0 : 1, other = 1 - hit.body;
    const bool is_listed = hit.undecided == std::vector<ScenePair>{{kNoBody, other, {}}};
    n_listed += is_listed ? 1 : 0;
    if (!is_listed && places[0] != places[1]) {
      ++n_later;
      ASSERT_EQ(hit.body, first);
    }
    // The same of a body that moves.
    const SceneHit swept = scene.linear_cast(Box(0.5, 0.5, 0.5), at({from - 2.0, 0, 0}), {dir, 0, 0});
    ASSERT_TRUE(swept.body == first || places[0] == places[1] || swept.undecided.size() == 1);
  }
  EXPECT_GT(n_listed, 100);
  // Far apart nothing is listed.
  Scene scene;
  scene.add(Box(1, 1, 1), at({5, 0.1, 0}));
  scene.add(Box(1, 1, 1), at({5.0001, -0.1, 0}));
  const SceneHit hit = scene.cast_ray({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(hit.body, 0u);
  EXPECT_TRUE(hit.undecided.empty());
}

// A segment without an exact form.
struct Rod {
  Vec3d end;

  Vec3d support(const Vec3d& d) const { return dot(d, end) >= 0.0 ? end : -end; }
  double support_error() const { return 0x1p-50 * norm_1(end); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return norm(end) * (1.0 + 0x1p-48); }
  double inradius() const { return 0.0; }
};

// Of the rod nothing was found but that it is at least 0 away, and 0 was taken for its distance.
TEST(SceneRivals, ANeighbourOfUnknownDistanceIsNotTheNearest) {
  for (const double s : {1.0, 1e58, 1e-58}) {
    Scene scene;
    scene.add(Sphere(0.1 * s), at({0, 0, 0}));
    scene.add(Rod{{5.0 * s, 5.0 * s, 0}}, at({5.0 * s, -s, 0}));
    scene.add(Sphere(0.1 * s), at({-0.5 * s, 0, 0}));
    const SceneNeighbour found = scene.nearest(0);
    EXPECT_EQ(found.body, 2u) << s;
    EXPECT_NEAR(found.separation.signed_distance / s, 0.3, 1e-12) << s;
  }
}

TEST(SceneBroadPhase, OneBodyFarAwayDoesNotMakeAllOthersNeighbours) {
  Scene scene;
  const ShapeId ball = scene.add_shape(Sphere(0.5));
  for (int x = 0; x < 22; ++x) {
    for (int y = 0; y < 22; ++y) {
      for (int z = 0; z < 22; ++z) scene.add(ball, at({1.2 * x, 1.2 * y, 1.2 * z}));
    }
  }
  scene.add(ball, at({1e7, 0, 0}));
  ScenePairs found;
  scene.overlapping_pairs(found);
  EXPECT_LT(found.counts[SceneStage::balls].seen, 40 * scene.size());
  scene.overlaps_of(5000, found);
  EXPECT_LT(found.counts[SceneStage::balls].seen, 200u);
  // What is beyond the outermost cells is found all the same.
  const BodyId far = scene.add(ball, at({1e7 + 0.5, 0, 0}));
  scene.overlaps_of(far, found);
  EXPECT_EQ(found.pairs.size(), 1u);
}

}  // namespace
}  // namespace vex
