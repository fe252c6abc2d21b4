// Fast marbles, and rods that spin, between thin walls: times of impact let none of them through.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/sphere.h"
#include "tests/engine_step/small_engine.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kHalf = 1.0, kWall = 0.01, kRadius = 0.03;
constexpr int kMarbles = 20, kRods = 6, kMarbleSteps = 600;

Transformd tilted(double angle, const Vec3d& at) {
  return {{std::cos(angle), 0.0, std::sin(angle)}, {0.0, 1.0, 0.0}, {-std::sin(angle), 0.0, std::cos(angle)}, at};
}

// A room of six walls a centimetre thick and two metres wide, with three ramps in it.
void add_room(SmallEngine& engine) {
  const double wide = 2.0 * (kHalf + kWall), off = kHalf + 0.5 * kWall;
  for (const double side : {-off, off}) {
    engine.add_still(Box(kWall, wide, wide), Transformd{.translation = {side, 0.0, 0.0}});
    engine.add_still(Box(wide, kWall, wide), Transformd{.translation = {0.0, side, 0.0}});
    engine.add_still(Box(wide, wide, kWall), Transformd{.translation = {0.0, 0.0, side}});
  }
  for (const double z : {-0.4, 0.1, 0.6}) {
    engine.add_still(Box(1.2, 2.0 * kHalf, kWall),
                     tilted(z > 0.0 && z < 0.5 ? 0.2 : -0.2, {z > 0.0 && z < 0.5 ? 0.35 : -0.35, 0.0, z}));
  }
}

struct Outcomes {
  int n_out = 0;       // bodies of which a point is outside of the room at the end of some step
  int n_overlaps = 0;  // pairs of a moving body and a wall that share a point then, over all steps
  std::size_t n_impacts = 0;
  double fastest = 0.0;  // way of a step over the walls' thickness
};

Outcomes run_marbles(bool finds_impacts) {
  // No gravity is needed to be fast: they are thrown.
  SmallEngine engine({.time_step = 1.0 / 120.0,
                      .friction = 0.1,
                      .restitution = 1.0,
                      .skin = 1e-3,
                      .slop = 0.0,
                      .finds_impacts = finds_impacts});
  add_room(engine);
  const BodyId first = static_cast<BodyId>(engine.size());
  std::mt19937_64 random(11);
  for (int k = 0; k < kMarbles + kRods; ++k) {
    const double m = 1.0, i = 0.4 * kRadius * kRadius;
    const Vec3d at{0.35 * ((k % 5) - 2), 0.3 * ((k / 5) - 2.5), 0.85};
    const bool is_rod = k >= kMarbles;
    const BodyId id = is_rod ? engine.add(Capsule(0.1, kRadius), m, {2e-3, 2e-3, i}, at)
                             : engine.add(Sphere(kRadius), m, {i, i, i}, at);
    SmallEngine::Body& body = engine.body(id);
    body.velocity = 60.0 * random_direction(random);
    if (is_rod) body.angular_velocity = 100.0 * random_direction(random);
    body.is_fast = true;
  }
  Outcomes found;
  std::vector<bool> is_out(engine.size(), false);
  ScenePairs pairs;
  for (int step = 0; step < kMarbleSteps; ++step) {
    for (BodyId id = first; id < engine.size(); ++id) {
      found.fastest = std::max(found.fastest, norm(engine.body(id).velocity) / 120.0 / kWall);
    }
    found.n_impacts += engine.step().n_impacts;
    for (BodyId id = first; id < engine.size(); ++id) {
      const Vec3d& p = engine.body(id).position;
      const double farthest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
      if (!(farthest < kHalf)) is_out[id] = true;
      engine.scene().move(id, engine.pose(id));
    }
    engine.scene().overlapping_pairs(pairs);
    for (const ScenePair& pair : pairs.pairs) found.n_overlaps += pair.a < first && pair.b >= first ? 1 : 0;
  }
  for (const bool out : is_out) found.n_out += out ? 1 : 0;
  return found;
}

TEST(MarbleRun, LetsNothingThroughByTimesOfImpact) {
  const Outcomes found = run_marbles(true);
  EXPECT_EQ(found.n_out, 0);
  EXPECT_EQ(found.n_overlaps, 0);
  EXPECT_GT(found.n_impacts, 500u) << "steps that would have gone into a wall";
  EXPECT_GT(found.fastest, 40.0) << "a step is many walls long";
}

TEST(MarbleRun, WithoutThemSomeGetThrough) {
  const Outcomes found = run_marbles(false);
  EXPECT_GT(found.n_out, kMarbles / 2);
  EXPECT_GT(found.n_overlaps, 0);
}

}  // namespace
}  // namespace vex
