// What a reader with referees of his own found in scenes before they were released: pairs that were missed where
// coordinates are large against the bodies, or after an exception; lists that hung on the threads; calls that never
// ended.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "shapes/polytope.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

// A segment whose centre is outside of it by its support error, as the concept allows.
struct UserSegment {
  double error;

  Vec3d support(const Vec3d& d) const { return {d.x > 0.0 ? 1.0 : error, 0.0, 0.0}; }
  double support_error() const { return error; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 1.0 + 1e-9; }
  double inradius() const { return 0.0; }
};

constexpr BroadPhase kPhases[] = {BroadPhase::automatic, BroadPhase::grid, BroadPhase::tree};

// A ball without an exact form: where two of them touch, nothing is proven. It throws once where it is told to.
struct UserBall {
  double radius;
  const bool* throws = nullptr;

  Vec3d support(const Vec3d& d) const {
    if (throws != nullptr && *throws) throw std::runtime_error("the user's own");
    const double length = norm(d);
    return length > 0.0 ? (radius / length) * d : Vec3d{};
  }
  double support_error() const { return 8.0 * 0x1p-53 * radius; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return radius * (1.0 + 0x1p-48); }
  double inradius() const { return 0.0; }
};

// Cells were as wide as the balls without what rounding adds to them far out.
TEST(SceneReferee, BodiesOffTheirOriginsFarOutAreInNeighbouringCells) {
  const std::vector<Vec3d> vertices = {{0.75, 0, 0}, {1.05, 0, 0}, {0.9, 0.05, 0}, {0.9, 0, 0.05}};
  const ConvexBody body = Polytope(vertices, {0.9, 0.01, 0.01}, 0.0);
  Transformd turned{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0x1p53 + 2.0, 0, 0}};
  for (const BroadPhase phase : kPhases) {
    Scene scene({.broad_phase = phase});
    scene.add(body, Transformd{.translation = {0x1p53, 0, 0}});
    scene.add(body, turned);
    ASSERT_EQ(overlap(body, body, Pose(scene.relative_pose({0, 1, {}}))).outcome, Outcome::overlap);
    ScenePairs found;
    scene.overlapping_pairs(found);
    EXPECT_EQ(found.pairs.size(), 1u);
    scene.overlaps_of(0, found);
    EXPECT_EQ(found.pairs.size(), 1u);
    EXPECT_EQ(scene.would_overlap(0, scene.pose(0)), Outcome::overlap);
  }
}

// A body from 10^9 boxes away was left a hundred-millionth of a box outside.
TEST(SceneReferee, BodiesFromManyBoxesAwayComeIntoTheBox) {
  const double edge = 2366.016562;
  for (const BroadPhase phase : kPhases) {
    Scene scene(PeriodicBox::cube(edge), {.broad_phase = phase});
    for (int k = 0; k < 200; ++k) {
      const double x = (9.0e8 + 1e5 * k + 0.5) * edge;
      const BodyId body = scene.add(Sphere(0.5), Transformd{.translation = {x, 0, 0}});
      const Vec3d f = scene.box()->fractional(scene.pose(body).translation);
      EXPECT_LE(std::fabs(f.x), 0.5 + 1e-15);
    }
  }
  EXPECT_THROW(Scene(PeriodicBox::cube(1.0)).add(Sphere(0.1), Transformd{.translation = {1e10, 0, 0}}), InputError);
}

// A search that an exception had ended kept entries of its table.
TEST(SceneReferee, AQueryAfterAnExceptionIsAsGoodAsBefore) {
  bool throws = false;
  Scene scene({.broad_phase = BroadPhase::grid});
  std::vector<ShapeId> shapes;
  for (int k = 0; k < 5; ++k) shapes.push_back(scene.add_shape(UserBall{0.5 + 0.01 * k, &throws}));
  for (int k = 0; k < 100; ++k) {
    const double x = 3.0 * k;
    scene.add(shapes[static_cast<std::size_t>(k % 5)], Transformd{.translation = {x, 0, 0}});
    scene.add(shapes[static_cast<std::size_t>(k / 5 % 5)], Transformd{.translation = {x + 0.6, 0, 0}});
  }
  ScenePairs before, after;
  scene.overlapping_pairs(before);
  EXPECT_EQ(before.pairs.size(), 100u);
  Scene other({.broad_phase = BroadPhase::grid});
  for (BodyId k = 0; k < scene.end(); ++k) other.add(scene.shape(scene.shape_of(k)), scene.pose(k));
  throws = true;
  EXPECT_THROW(other.overlapping_pairs(after), std::runtime_error);
  throws = false;
  other.overlapping_pairs(after);
  EXPECT_EQ(after.pairs, before.pairs);
}

// More threads than bodies, and thousands of pairs: the list's order was made from before its beginning.
TEST(SceneReferee, FewBodiesWithManyCopiesAndThreads) {
  std::vector<ScenePair> first;
  for (const int n_threads : {1, 8}) {
    Scene scene(PeriodicBox::cube(1.0), {.broad_phase = BroadPhase::tree, .n_threads = n_threads});
    scene.add(Sphere(6.0), Transformd{});
    scene.add(Sphere(6.0), Transformd{.translation = {0.25, 0, 0}});
    ScenePairs found;
    scene.overlapping_pairs(found);
    EXPECT_GT(found.pairs.size(), 4096u);
    if (first.empty()) first = found.pairs;
    EXPECT_EQ(found.pairs, first);
  }
}

// Whether an undecided pair was listed hung on what had been joined before.
TEST(SceneReferee, UndecidedPairsOfClustersAreTheSameForAnyOrder) {
  std::vector<ScenePair> first;
  for (const int n_threads : {1, 2, 8}) {
    for (const BroadPhase phase : kPhases) {
      Scene scene({.broad_phase = phase, .n_threads = n_threads});
      const ShapeId ball = scene.add_shape(UserBall{0.5}), small = scene.add_shape(UserBall{0.3});
      // Rows of touching balls; in every other row a ball joins two of them.
      for (int row = 0; row < 30; ++row) {
        for (int k = 0; k < 30; ++k) {
          scene.add(ball, Transformd{.translation = {1.0 * k, 3.0 * row, 0}});
          if (row % 2 == 0 && k % 3 == 0) scene.add(small, Transformd{.translation = {k + 0.5, 3.0 * row, 0.1}});
        }
      }
      Clusters clusters;
      scene.clusters(clusters);
      EXPECT_FALSE(clusters.undecided.empty());
      if (first.empty()) first = clusters.undecided;
      EXPECT_EQ(clusters.undecided, first);
    }
  }
}

// Pieces of a ray of no length were added up for ever; the tables of images of flat boxes were endless.
TEST(SceneReferee, RaysAndBoxesOutOfProportionAreRefused) {
  Scene scene(PeriodicBox::cube(1.0));
  scene.add(Sphere(0.1), Transformd{});
  EXPECT_THROW(scene.cast_ray({0.3, 0.3, 0.3}, {1.7e308, 1.7e308, 1.7e308}, 0.0), UsageError);
  EXPECT_THROW(scene.cast_ray({0.3, 0.3, 0.3}, {1e-310, 0, 0}), UsageError);
  EXPECT_THROW(PeriodicBox(1e15, 1.0, 1.0), InputError);
  EXPECT_NO_THROW(PeriodicBox(1e8, 1.0, 1.0));
}

// Distances in the asking body's frame were held against boxes in the scene's.
TEST(SceneReferee, TheNearestIsTheNearestAsTheAskingBodySeesIt) {
  Scene scene;
  scene.add(Sphere(0.5), Transformd{{1.0 + 0.95e-7, 0, 0}, {0, 1.0 - 0.95e-7, 0}, {0, 0, 1}, {}});
  scene.add(Sphere(0.5), Transformd{.translation = {1000.0, 0, 0}});
  scene.add(Sphere(0.5), Transformd{.translation = {0, 1000.00014, 0}});
  const SceneNeighbour next = scene.nearest(0);
  for (const BodyId other : {1u, 2u}) {
    const Separation found = distance(scene.shape(0), scene.shape(0), Pose(scene.relative_pose({0, other, {}})));
    EXPECT_LE(next.separation.signed_distance, found.signed_distance);
  }
}

TEST(SceneReferee, VisitorsAreCheckedAsBodiesAre) {
  Scene scene;
  scene.add(Sphere(0.5), Transformd{});
  const Transformd rough{{1.0 + 4.5e-7, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
  ScenePairs found;
  EXPECT_THROW(scene.overlaps_of(Sphere(0.5), rough, found), InputError);
  EXPECT_THROW(scene.nearest(Sphere(0.5), rough), InputError);
  EXPECT_THROW(scene.linear_cast(Sphere(0.5), rough, {1, 0, 0}, 1.0), InputError);
  EXPECT_THROW(scene.overlaps_of(Sphere(1e200), Transformd{}, found), InputError);
  EXPECT_THROW(scene.overlaps_of(Sphere(0.5), Transformd{.translation = {1e200, 0, 0}}, found), InputError);
}

// Squares of distances that are subnormal told nothing.
TEST(SceneReferee, PointsWithinADistanceWhoseSquareUnderflows) {
  const ConvexBody point = UserBall{0.0};
  for (const BroadPhase phase : kPhases) {
    Scene scene({.broad_phase = phase});
    scene.add(point, Transformd{});
    scene.add(point, Transformd{.translation = {1.575e-162, 1.575e-162, 1.575e-162}});
    ScenePairs found;
    scene.pairs_within(2.729e-162, found);
    EXPECT_EQ(found.pairs.size() + found.undecided.size(), 1u);
  }
}

// Numbers that no body had were clusters.
TEST(SceneReferee, RemovedBodiesAreInNoCluster) {
  Scene scene;
  for (const double x : {0.0, 5.0, 9.0}) scene.add(Sphere(0.5), Transformd{.translation = {x, 0, 0}});
  scene.remove(1);
  Clusters clusters;
  scene.clusters(clusters);
  EXPECT_EQ(clusters.n_clusters(), 2u);
  EXPECT_EQ(clusters.labels(), (std::vector<std::uint32_t>{0, kNoCluster, 1}));
  EXPECT_EQ(clusters.n_bodies(0), 1u);
  EXPECT_EQ(clusters.n_bodies(1), 0u);
  EXPECT_EQ(clusters.wraps(1), (std::array<bool, 3>{}));
  EXPECT_EQ(clusters.largest(), 1u);
  EXPECT_THROW(clusters.join(0, 1), UsageError);
  EXPECT_THROW(clusters.join(1, 1, {1, 0, 0}), UsageError);
  EXPECT_EQ(clusters.join(0, 2), Clusters::Joined::united);
  clusters.root_at_lowest();
  EXPECT_EQ(clusters.labels(), (std::vector<std::uint32_t>{0, kNoCluster, 0}));
  scene.add(Sphere(0.5), Transformd{.translation = {0.5, 0, 0}});
  scene.clusters(clusters);
  EXPECT_EQ(clusters.labels(), (std::vector<std::uint32_t>{0, 0, 1}));
}

// Bounds tell apart what supports alone cannot: the scene's verdict was said to be that of `overlap`.
TEST(SceneReferee, OfBodiesWithoutExactFormsASceneMayProveMoreAndNeverOtherwise) {
  Scene scene;
  scene.add(UserBall{0.5}, Transformd{});
  for (const double x : {1.0, 1.0 + 0x1p-40, 1.0 - 0x1p-40, 1.5}) {
    scene.add(UserBall{0.5}, Transformd{.translation = {0, x, 0}});
    ScenePairs found;
    scene.overlaps_of(0, found);
    const Outcome alone = overlap(scene.shape(0), scene.shape(0), Pose(scene.relative_pose({0, 1, {}}))).outcome;
    const Outcome in_scene = !found.pairs.empty()       ? Outcome::overlap
                             : !found.undecided.empty() ? Outcome::undecided
                                                        : Outcome::disjoint;
    EXPECT_TRUE(in_scene == alone || alone == Outcome::undecided) << x;
    scene.remove(1);
  }
}

// Only the latest 64 shapes were looked at.
TEST(SceneReferee, CopiesOfABodyAreOneShape) {
  std::vector<ConvexBody> bodies;
  for (int k = 0; k < 100; ++k) bodies.emplace_back(Sphere(1.0 + k));
  Scene scene;
  for (int round = 0; round < 3; ++round) {
    for (const ConvexBody& body : bodies) scene.add(body, Transformd{});
  }
  EXPECT_EQ(scene.n_shapes(), 100u);
}

Transformd turned_about_z(double angle, const Vec3d& place = {}) {
  return {{std::cos(angle), -std::sin(angle), 0.0}, {std::sin(angle), std::cos(angle), 0.0}, {0.0, 0.0, 1.0}, place};
}

// Turns that are smaller than the last place of what a body has turned already add up: the sum was rounded to nearest,
// and stayed where it was. A rod turns towards a cube that is 1.2e-12 above it, or away from one that is 1e-11 deep in
// it.
TEST(SceneReferee, OfManyTurnsTooSmallForTheirSumNoneIsLost) {
  for (const bool meets_first : {false, true}) {
    const double depth = meets_first ? 1e-11 : 0.0, per_move = meets_first ? -1e-16 : 1e-16;
    const ConvexBody rod = meets_first ? Box(2.0, 0.0625, 0.0625) : Box(2.0, 0.1, 0.1);
    const ConvexBody block = Box(0.5, meets_first ? 0.5625 + 2.0 * depth : 0.5, 0.5);
    const Vec3d place = meets_first ? Vec3d{1.0, 0.3125, 0.0} : Vec3d{0.8, 0.05 + 0.25 + 1.2e-12, 0.0};
    Scene scene({.skin = 6.0});
    scene.add(rod, turned_about_z(0.0));
    scene.add(block, turned_about_z(0.0, place));
    ScenePairs found;
    scene.overlapping_pairs(found);
    for (const double angle : {0.37, 0.0, 0.37, 0.0}) scene.move(0, turned_about_z(angle));
    scene.overlapping_pairs(found);
    ASSERT_EQ(found.pairs.size(), meets_first ? 1u : 0u);
    int n_moves = 0;
    double angle = 0.0;
    for (; n_moves < 1500000; ++n_moves) {
      angle = per_move * n_moves;
      scene.move(0, turned_about_z(angle));
      if (n_moves % 1000 != 0) continue;
      scene.overlapping_pairs(found);
      Scene fresh;
      fresh.add(rod, turned_about_z(angle));
      fresh.add(block, turned_about_z(0.0, place));
      ScenePairs truth;
      fresh.overlapping_pairs(truth);
      ASSERT_EQ(found.pairs, truth.pairs) << n_moves;
      if (truth.pairs.empty() == meets_first) break;
    }
    EXPECT_LT(n_moves, 1500000) << "the verdict never changes";
  }
}

// Balls about centres that a body does not hold told that it overlaps what it is beside.
TEST(SceneReferee, CentresOutsideOfTheirBodiesProveNothing) {
  for (const double error : {0.05, 1e-3, 1e-6, 1e-9}) {
    const ConvexBody segment = UserSegment{error}, ball = Sphere(0.5);
    for (const double skin : {0.0, 0.1}) {
      for (const bool is_turned : {false, true}) {
        Scene scene({.skin = skin});
        Transformd at;
        at.translation = {-0.5 + 0.4 * error, 0.0, 0.0};  // a gap of .6 of the error
        scene.add(is_turned ? ball : segment, is_turned ? Pose(at) : Pose());
        scene.add(is_turned ? segment : ball, is_turned ? Pose() : Pose(at));
        ScenePairs found;
        scene.overlapping_pairs(found);
        EXPECT_TRUE(found.pairs.empty()) << error << ' ' << skin;
      }
    }
  }
}

// By steps of more than a radian, too.
TEST(SceneReferee, TurnsOfAnySizeLeaveWhatIsKnownTrue) {
  const ConvexBody ball = Sphere(0.5), cube = Box(1.0, 1.0, 1.0);
  for (const double angle : {0.9, 1.2, 2.0, 3.1}) {
    Scene scene({.skin = 0.2}), other({.skin = 0.0});
    for (Scene* const one : {&scene, &other}) {
      for (int k = 0; k < 60; ++k) {
        Transformd at;
        at.translation = {1.02 * (k % 5), 1.01 * (k / 5 % 4), 1.3 * (k / 20)};
        one->add(k % 2 == 0 ? cube : ball, Pose(at));
      }
    }
    ScenePairs found, fresh;
    for (int step = 0; step < 20; ++step) {
      for (Scene* const one : {&scene, &other}) {
        for (BodyId body = 0; body < one->end(); ++body) {
          const double by = angle * step + body, c = std::cos(by), s = std::sin(by);
          Transformd at{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}, one->pose(body).translation};
          one->move(body, Pose(at));
        }
      }
      scene.overlapping_pairs(found);
      other.overlapping_pairs(fresh);
      ASSERT_EQ(found.pairs, fresh.pairs) << angle << ' ' << step;
    }
  }
}

}  // namespace
}  // namespace vex
