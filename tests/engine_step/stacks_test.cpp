// Stacks at rest for 10^4 steps: contacts that are named alike from step to step, and nothing that creeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "tests/engine_step/small_engine.h"

namespace vex {
namespace {

constexpr int kSteps = 10'000, kSettling = 600;

struct Item {
  std::string shape;
  Vec3d inertia;  // of mass 1
  double height;  // from face to face
};

Item box(double x, double y, double z) {
  return {"box:" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z),
          (1.0 / 12.0) * Vec3d{y * y + z * z, x * x + z * z, x * x + y * y}, z};
}
Item cylinder(double length, double radius) {
  const double across = (3.0 * radius * radius + length * length) / 12.0;
  return {"cylinder:" + std::to_string(length) + "," + std::to_string(radius),
          {across, across, 0.5 * radius * radius},
          length};
}
// Of a regular polygon of n corners at this radius the second moment about the axis is (2 + cos(2 pi/n)) R^2/6.
Item prism(int n, double radius, double height) {
  const double along = radius * radius / 6.0 * (2.0 + std::cos(2.0 * std::numbers::pi / n));
  const double across = 0.5 * along + height * height / 12.0;
  return {"prism:" + std::to_string(n) + "," + std::to_string(radius) + "," + std::to_string(height),
          {across, across, along},
          height};
}

struct Rest {
  double drift = 0.0;    // how far any body has moved after the first kSettling steps
  double turned = 0.0;   // by how much, the largest change of its axes
  double speed = 0.0;    // at the end, of any body
  double kept = 1.0;     // the share of contacts that were the same ones in the step before; after settling
  double deepest = 0.0;  // signed distance, after settling
  double least_contacts = HUGE_VAL;
};

Rest rest_of(const std::vector<Item>& items, bool warm_starts = true) {
  SmallEngine engine({.warm_starts = warm_starts});
  engine.add_still(Box(20.0, 20.0, 1.0), Transformd{.translation = {0.0, 0.0, -0.5}});
  double top = 0.0;
  int k = 0;
  for (const Item& item : items) {
    // A little beside each other, and not all turned alike.
    const BodyId id = engine.add(parse_shape(item.shape).body, 1.0, item.inertia,
                                 {0.01 * (k % 3), 0.013 * (k % 2), top + 0.5 * item.height + 1e-4});
    engine.body(id).turn = {std::cos(0.1 * k), 0.0, 0.0, std::sin(0.1 * k)};
    top += item.height + 2e-4;
    ++k;
  }
  Rest rest;
  std::vector<Transformd> settled;
  std::size_t n_contacts = 0, n_kept = 0;
  for (int step = 0; step < kSteps; ++step) {
    const SmallEngine::Counts counts = engine.step();
    if (step < kSettling) continue;
    n_contacts += counts.n_contacts;
    n_kept += counts.n_kept;
    rest.deepest = std::min(rest.deepest, counts.deepest);
    rest.least_contacts = std::min(rest.least_contacts, static_cast<double>(counts.n_contacts));
    for (BodyId id = 0; id < engine.size(); ++id) {
      const Transformd pose = engine.pose(id).a_from_b();
      if (step == kSettling) settled.push_back(pose);
      rest.drift = std::max(rest.drift, norm(pose.translation - settled[id].translation));
      rest.turned = std::max({rest.turned, norm(pose.row_x - settled[id].row_x), norm(pose.row_y - settled[id].row_y),
                              norm(pose.row_z - settled[id].row_z)});
    }
  }
  for (BodyId id = 0; id < engine.size(); ++id) rest.speed = std::max(rest.speed, norm(engine.body(id).velocity));
  rest.kept = static_cast<double>(n_kept) / static_cast<double>(n_contacts);
  return rest;
}

// Where a stack is, is known to the slop within which overlaps are left as they are, 1e-3: what moves by a tenth of
// that once it is at rest creeps. Measured are 4e-13 and less (docs/engine_step.md); without warm starting by features
// 0.7 and more.
void expect_rests(const std::vector<Item>& items, double most_drift, double least_contacts) {
  const Rest rest = rest_of(items);
  EXPECT_LE(rest.drift, most_drift);
  EXPECT_LE(rest.turned, most_drift);
  EXPECT_LE(rest.speed, 1e-3);
  EXPECT_GE(rest.deepest, -2e-3) << "twice the slop";
  EXPECT_GE(rest.least_contacts, least_contacts);
  EXPECT_GE(rest.kept, 0.999);
}

TEST(Stacks, OfBoxesRest) { expect_rests({4, box(1.0, 0.8, 0.5)}, 1e-4, 16); }
TEST(Stacks, OfCylindersRest) { expect_rests({4, cylinder(0.6, 0.4)}, 1e-4, 16); }
TEST(Stacks, OfHullsRest) {
  expect_rests({prism(6, 0.5, 0.5), prism(5, 0.5, 0.4), prism(7, 0.45, 0.5), prism(6, 0.4, 0.4)}, 1e-4, 16);
}

}  // namespace
}  // namespace vex
