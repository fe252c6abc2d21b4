// The cores as they are for the machine that every set extends, two lanes to a register; four lanes here.
#define VEX_ISA packet_core_test
#include "engine/query/packets/packet_core.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/support/direction_map.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr int kLanes = 2 * packet_core_test::kRegisterLanes;
using L = packet_core_test::Packet<kLanes>;

struct Lanes {
  double x[kLanes], y[kLanes], z[kLanes];
  void set(int lane, const Vec3d& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
  Vec3<L> packet() const { return {L::load(x), L::load(y), L::load(z)}; }
  Vec3d at(int lane) const { return {x[lane], y[lane], z[lane]}; }
};
Lanes lanes_of(const Vec3<L>& v) {
  Lanes lanes;
  v.x.store(lanes.x);
  v.y.store(lanes.y);
  v.z.store(lanes.z);
  return lanes;
}

struct TableOf {
  explicit TableOf(const std::vector<Vec3d>& points) : vertices(points), map(columns(0), columns(1), columns(2)) {}
  std::vector<double> columns(int axis) const {
    std::vector<double> column;
    for (const Vec3d& v : vertices) column.push_back(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
    return column;
  }
  packet_core_test::TableCore core() const {
    CoreForm form;
    form.table = map.table().value();
    return packet_core_test::TableCore(form);
  }
  bool has(const Vec3d& p) const {
    for (const Vec3d& v : vertices) {
      if (v.x == p.x && v.y == p.y && v.z == p.z) return true;
    }
    return false;
  }

  std::vector<Vec3d> vertices;
  DirectionMap map;
};

TEST(TableCore, FindsTheFarthestVertexOfEachLane) {
  std::mt19937_64 random(1);
  std::vector<TableOf> tables;
  for (const int n : {1, 5, 33, 100, 1000}) {
    for (const Vec3d& stretch : {Vec3d{1, 1, 1}, Vec3d{3, 2, 1}, Vec3d{100, 1, 1}}) {
      tables.emplace_back(test_point_hull(n, stretch, 1).vertices);
    }
  }
  // Of the cubes' facets many vertices tie.
  std::vector<Vec3d> cube, flat, facets;
  for (int k = 0; k < 8 * 8 * 8; ++k) cube.push_back({k % 8 - 3.5, k / 8 % 8 - 3.5, k / 64 - 3.5});
  for (int k = 0; k < 100; ++k) flat.push_back({std::cos(k), std::sin(k), 0.5});
  tables.emplace_back(cube);
  for (int k = 0; k < 24 * 24; ++k) {
    for (const double side : {-1.0, 1.0}) facets.push_back({side, k % 24 / 12.0 - 1.0, k / 24 / 12.0 - 1.0});
  }
  tables.emplace_back(flat);
  tables.emplace_back(facets);
  for (const TableOf& table : tables) {
    double reach = 0.0;
    for (const Vec3d& v : table.vertices) reach = std::max(reach, norm(v));
    for (int k = 0; k < 2000; ++k) {
      Lanes dirs;
      for (int lane = 0; lane < kLanes; ++lane) {
        Vec3d d = random_direction(random);
        // Axes and diagonals, borders of cells, and coordinates far smaller than others.
        if (k % 4 == 1) d = {double(random() % 3) - 1.0, double(random() % 3) - 1.0, double(random() % 3) - 1.0};
        if (k % 4 == 2) d = {1.0, double(random() % 17) / 8.0 - 1.0, double(random() % 17) / 8.0 - 1.0};
        if (k % 4 == 3) d = {d.x * 1e-18, d.y, d.z * 1e-9};
        if (norm(d) == 0.0) d = {0.0, 0.0, -1.0};
        dirs.set(lane, std::ldexp(1.0, static_cast<int>(random() % 301) - 150) * d);
      }
      const Lanes found = lanes_of(table.core().support(dirs.packet()));
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vec3d dir = dirs.at(lane);
        double most = -HUGE_VAL;
        for (const Vec3d& v : table.vertices) most = std::max(most, dot(v, dir));
        ASSERT_EQ(dot(found.at(lane), dir), most) << dir.x << " " << dir.y << " " << dir.z;
        if (k % 50 == 0) {
          ASSERT_TRUE(table.has(found.at(lane)));
        }
      }
    }
  }
}

TEST(TableCore, GivesSomeVertexForWhatIsNoDirection) {
  const TableOf table(test_point_hull(300, {3, 2, 1}, 1).vertices);
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> numbers = {0.0,    -0.0,  1.0,    -1.0,     5e-324,    -5e-324,
                                       1e-310, 1e308, -1e308, infinity, -infinity, nan};
  Lanes dirs;
  int lane = 0;
  for (const double x : numbers) {
    for (const double y : numbers) {
      for (const double z : numbers) {
        dirs.set(lane, {x, y, z});
        lane = (lane + 1) % kLanes;
        if (lane != 0) continue;
        const Lanes found = lanes_of(table.core().support(dirs.packet()));
        for (int k = 0; k < kLanes; ++k) ASSERT_TRUE(table.has(found.at(k)));
      }
    }
  }
}

TEST(PiecesCore, FindsTheBestPieceOfEachLane) {
  // Those of a cylinder and a point; a flat disc's middle where the direction is along its axis.
  CoreForm form;
  form.pieces = {
      {{0, 0, -1}, {2, 2, 0}}, {{0, 0, 1}, {2, 2, 0}, false, true}, {{0, 0, 4}, {}}, {{0, 0, -2}, {1, 1, 1}, true}};
  const packet_core_test::PiecesCore core(form);
  const std::vector<Vec3d> dirs = {{0, 0, 1},  {0, 0, -1},      {1, 0, 0}, {1, 0, -1e-200},
                                   {0, 1, 5},  {1e-300, 0, -1}, {3, 4, 0}, {1e-100, 1e-100, -1},
                                   {0, 1, -3}, {0, -1, 1e-9},   {0, 0, 2}, {-1, 0, -1}};
  for (std::size_t first = 0; first < dirs.size(); first += kLanes) {
    Lanes lanes;
    for (int lane = 0; lane < kLanes; ++lane) lanes.set(lane, dirs[first + static_cast<std::size_t>(lane)]);
    const Lanes found = lanes_of(core.support(lanes.packet()));
    for (int lane = 0; lane < kLanes; ++lane) {
      const Vec3d d = lanes.at(lane);
      const double across = std::hypot(d.x, d.y);
      const double most =
          std::max({4 * d.z, 2 * across + std::fabs(d.z), -2 * d.z + std::hypot(across, std::max(d.z, 0.0))});
      EXPECT_NEAR(dot(found.at(lane), d), most, 20.0 * kUnitRoundoff * 4.0 * norm(d));
    }
  }
}

}  // namespace
}  // namespace vex
