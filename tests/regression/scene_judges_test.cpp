// A judge of pairs that asked its own scene for a body's pairs ended the program: the inner query took away the search
// that waited for the judge. Such calls are refused, and the scene stays what it was.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/query/contact_manifold.h"
#include "engine/scene/scene.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

Pose along_x(double x) {
  Transformd pose;
  pose.translation.x = x;
  return Pose(pose);
}

TEST(SceneJudges, MayNotSearchOrChangeTheirOwnScene) {
  for (const std::size_t n : {std::size_t{3}, std::size_t{300}}) {  // one by one, and sorted
    Scene scene;
    const ShapeId ball = scene.add_shape(Sphere(0.6));
    std::vector<Pose> poses;
    for (std::size_t k = 0; k < n; ++k) poses.push_back(along_x(static_cast<double>(k)));
    scene.add(ball, poses);
    ScenePairs inner, found;
    SceneManifolds manifolds;
    Clusters clusters;
    const std::vector<std::function<void()>> calls = {
        [&] { scene.overlaps_of(0, inner); },
        [&] { scene.overlaps_of(Sphere(1.0), along_x(0.0), inner); },
        [&] { scene.overlaps_of_added(0, inner); },
        [&] { scene.would_overlap(0, along_x(1.0)); },
        [&] { scene.overlapping_pairs(inner); },
        [&] { scene.pairs_within(0.5, inner); },
        [&] { scene.any_overlap(); },
        [&] { scene.clusters(clusters); },
        [&] { scene.contact_manifolds(manifolds, 0.1); },
        [&] { scene.nearest(0); },
        [&] {
          scene.cast_ray({-5.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
        },
        [&] {
          scene.linear_cast(Sphere(0.1), along_x(-5.0), {1.0, 0.0, 0.0});
        },
        [&] { scene.add_shape(Sphere(1.0)); },
        [&] { scene.add(ball, along_x(0.5)); },
        [&] { scene.add(ball, poses); },
        [&] { scene.remove(0); },
        [&] { scene.clear(); },
        [&] { scene.expect(10); },
        [&] { scene.move(0, along_x(0.5)); },
        [&] { scene.move_all(poses); },
        [&] { scene.set({}); },
    };
    for (std::size_t k = 0; k < calls.size(); ++k) {
      int n_asked = 0;
      const PairJudge judge = [&](ShapeId, ShapeId, const Transformd&) {
        ++n_asked;
        EXPECT_EQ(scene.size(), n) << "what its bodies are may be read";
        EXPECT_THROW(calls[k](), UsageError) << "call " << k;
        return Outcome::overlap;
      };
      scene.overlaps_of_added(0, found, nullptr, &judge);
      EXPECT_EQ(found.pairs.size(), n - 1) << "call " << k;
      EXPECT_GE(n_asked, static_cast<int>(n) - 1);
    }
    const PairJudge refuses = [](ShapeId, ShapeId, const Transformd&) -> Outcome {
      throw InputError("no - ask another");
    };
    EXPECT_THROW(scene.overlaps_of_added(0, found, nullptr, &refuses), InputError);
    scene.overlapping_pairs(inner);
    EXPECT_EQ(inner.pairs.size(), n - 1);
    scene.overlaps_of_added(0, found);
    EXPECT_EQ(found.pairs.size(), n - 1);
  }
}

// What does not hang on the bodies is looked at though no pair is near.
TEST(SceneSettings, ThatMeanNothingAreRefusedInAnEmptyScene) {
  Scene scene;
  SceneManifolds manifolds;
  EXPECT_THROW(scene.contact_manifolds(manifolds, {.feature_angle = -1.0}), UsageError);
  EXPECT_THROW(scene.contact_manifolds(manifolds, {.margin = -1.0}), UsageError);
  EXPECT_THROW(scene.set({.broad_phase = static_cast<BroadPhase>(77)}), UsageError);
}

}  // namespace
}  // namespace vex
