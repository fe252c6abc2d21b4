// What a third reader found in the memory of pairs (SceneSettings::skin), of which `unmoved` pairs were told wrongly:
// an answer about one copy of a body was kept for another one, the ball of a rounded body was taken for round in the
// scene's frame however the other body's rotation was rounded, and turns were added up until small ones were lost in
// the sum. And two small faults of single queries.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "engine/numeric/errors.h"
#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

Pose at(double x, double y, double z) {
  Transformd pose;
  pose.translation = {x, y, z};
  return Pose(pose);
}

// As the memory has it, and without it.
void expect_the_same(Scene& scene, std::size_t n_pairs) {
  ScenePairs remembered, fresh;
  scene.overlapping_pairs(remembered);
  scene.pairs_within(0.0, fresh);
  EXPECT_EQ(remembered.pairs, fresh.pairs);
  EXPECT_EQ(fresh.pairs.size(), n_pairs);
}

TEST(SceneMemory, AnAnswerAboutOneCopyIsNotKeptForAnother) {
  Scene scene(PeriodicBox(2.2, 4.0, 4.0), {.skin = 0.5});
  scene.add(Box(0.1, 3.0, 0.1), at(1.09, 0.0, 0.0));
  scene.add(Ellipsoid(0.1, 1.5, 0.1), at(-1.05, 0.0, 0.0));
  scene.add(Sphere(0.1), at(0.0, 0.0, 1.9));
  expect_the_same(scene, 1);
  scene.move(0, at(1.11, 0.0, 0.0));  // through a face: the pair is of the bodies themselves now
  expect_the_same(scene, 1);
  scene.move(2, at(0.5, 0.0, 1.9));  // far enough for a new list, while the pair rests
  expect_the_same(scene, 1);
}

TEST(SceneMemory, ABallIsRoundInTheOtherBodysFrame) {
  const auto scaled = [](double factor) {
    Transformd pose;
    pose.row_x = {factor, 0.0, 0.0};
    pose.row_y = {0.0, factor, 0.0};
    pose.row_z = {0.0, 0.0, factor};
    return Pose(pose);
  };
  const Box core(0.01, 9.0, 9.0);
  Scene scene({.skin = 0.5});
  scene.add(Box(0.02, 0.02, 0.02), scaled(1.0 + 0.9e-7));
  scene.add(Rounded<Box>(core, core.measures(), 5.0), at(0.01 + 0.005 + 5.0 + 1e-7, 0.0, 0.0));
  expect_the_same(scene, 0);
  scene.move(0, scaled(1.0 - 0.9e-7));
  expect_the_same(scene, 1);
}

TEST(SceneMemory, SmallTurnsAreNotLostInManyLargeOnes) {
  const auto turned = [](double angle_rad, double x) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    Transformd pose;
    pose.row_x = {c, -s, 0.0};
    pose.row_y = {s, c, 0.0};
    pose.translation = {x, 0.0, 0.0};
    return pose;
  };
  for (const auto& [n_turns, gap, step] : {std::tuple{1000, 2e-12, 1e-13}, {100000, 1e-9, 1e-11}}) {
    Scene scene({.skin = 0.5});
    const ShapeId cube = scene.add_shape(Box(2.0, 2.0, 2.0));
    scene.add(cube, at(0.0, 0.0, 0.0));
    const Transformd home = turned(0.0, 2.0 + gap);
    Transformd half_turn = home;
    half_turn.row_y = {0.0, -1.0, 0.0};
    half_turn.row_z = {0.0, 0.0, -1.0};
    scene.add(cube, home);
    expect_the_same(scene, 0);
    for (int k = 0; k < n_turns; ++k) scene.move(1, Pose(k % 2 == 0 ? half_turn : home));
    ScenePairs remembered, fresh;
    for (int k = 1; k * step < 4.0 * gap; ++k) {
      scene.move(1, Pose(turned(k * step, home.translation.x)));
      scene.overlapping_pairs(remembered);
      scene.pairs_within(0.0, fresh);
      ASSERT_EQ(remembered.pairs, fresh.pairs) << n_turns << " turns before, angle " << k * step;
    }
    EXPECT_EQ(fresh.pairs.size(), 1u) << "it was not turned far enough";
  }
}

// A user's own, without an exact form.
struct Egg {
  double x, y, z;
  template <class T>
  Vec3<T> support(const Vec3<T>& dir) const {
    const Vec3<T> scaled{T(x) * dir.x, T(y) * dir.y, T(z) * dir.z};
    const T length = norm(scaled);
    return {T(x) * (scaled.x / length), T(y) * (scaled.y / length), T(z) * (scaled.z / length)};
  }
  double support_error() const { return 0x1p-49 * circumradius(); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return std::fmax(x, std::fmax(y, z)); }
  double inradius() const { return std::fmin(x, std::fmin(y, z)); }
};

TEST(SceneNearest, AnswersWhereADistanceHasNoUpperBound) {
  for (const double size : {1.0, 1e30, 1e60, 1e80, 1e-50}) {
    Scene scene(PeriodicBox::cube(3.0 * size));
    scene.add(ConvexBody(Egg{0.5 * size, 0.3 * size, 0.8 * size}), Pose());
    scene.add(ConvexBody(Egg{0.5 * size, 0.3 * size, 0.7 * size}), at(size, 0.2 * size, 0.0));
    // Of two infinite upper bounds none is lower: a copy of body 0 itself is as good an answer.
    const SceneNeighbour found = scene.nearest(0);
    EXPECT_NE(found.body, kNoBody) << size;
    if (std::isfinite(found.separation.upper)) {
      EXPECT_EQ(found.body, 1u) << size;
    }
  }
}

TEST(SceneMargins, ThatAreTooSmallAreRefusedWhateverIsNear) {
  ScenePairs found;
  for (const double x : {1.0, 50.0}) {
    Scene scene;
    scene.add(Sphere(1.0), Pose());
    scene.add(Sphere(1.0), at(x, 0.0, 0.0));
    EXPECT_THROW(scene.pairs_within(1e-310, found), UsageError);
    EXPECT_NO_THROW(scene.pairs_within(1e-300, found));
  }
}

// A box whose support mapping throws once, at a call that is set.
struct FailingBox : Box {
  int* calls_left;
  FailingBox(double x, double y, double z, int* calls) : Box(x, y, z), calls_left(calls) {}
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    if (--*calls_left == 0) throw InputError("the user's own body failed");
    return Box::support(dir);
  }
  std::optional<ExactForm> exact_form() const { return std::nullopt; }
};

// Pairs that bounds had not told apart were taken for apart from then on, while their bodies rested.
TEST(SceneMemory, NothingIsKeptOfAQueryThatEndedByAnException) {
  int n_failed = 0;
  for (int call = 1; call < 200; ++call) {
    int calls_left = 0;
    Scene scene({.skin = 0.5});
    const ShapeId shape = scene.add_shape(ConvexBody(FailingBox(1.0, 0.6, 0.4, &calls_left)));
    for (const Vec3d& x : {Vec3d{0, 0, 0}, Vec3d{0.9, 0.2, 0.1}, Vec3d{30, 0, 0}, Vec3d{30, 0, 0.9}}) {
      scene.add(shape, at(x.x, x.y, x.z));
    }
    calls_left = call;
    ScenePairs pairs;
    try {
      scene.overlapping_pairs(pairs);
    } catch (const InputError&) {
      ++n_failed;
    }
    calls_left = 0;
    expect_the_same(scene, 1);
  }
  EXPECT_GT(n_failed, 10);
}

}  // namespace
}  // namespace vex
