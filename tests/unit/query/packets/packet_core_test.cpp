// The cores as they are for the machine that every set extends, two lanes to a register; four lanes here.
#define VEX_ISA packet_core_test
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/query/packets/packet_curved_core.h"
#include "engine/support/direction_map.h"
#include "shapes/any_shape.h"
#include "shapes/cut_sphere.h"
#include "shapes/egg.h"
#include "shapes/lens.h"
#include "shapes/spindle.h"
#include "shapes/superellipsoid.h"
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

// E32, held against more digits.
TEST(PacketPowers, AreAsNearAsIsProven) {
  std::mt19937_64 random(5);
  double worst_logarithm = 0.0, worst_exponential = 0.0;
  for (int k = 0; k < 200000; ++k) {
    double x[kLanes], y[kLanes], of_x[kLanes], of_y[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const double unit = random_in_unit_interval(random);
      x[lane] = k % 3 == 0 ? 1.0 + (k % 2 == 0 ? 1.0 : -0.5) * std::ldexp(unit, -int(random() % 53))
                           : std::ldexp(1.0 + unit, k % 3 == 1 ? 0 - int(random() % 3) : 1 - int(random() % 900));
      y[lane] = k % 2 == 0 ? -unit : -700.0 * unit * unit;
    }
    packet_core_test::logarithm(L::load(x)).store(of_x);
    packet_core_test::exponential(L::load(y)).store(of_y);
    for (int lane = 0; lane < kLanes; ++lane) {
      const long double log_x = std::log(static_cast<long double>(x[lane]));
      const long double exp_y = std::exp(static_cast<long double>(y[lane]));
      if (log_x == 0.0L) {
        ASSERT_EQ(of_x[lane], 0.0);
      } else {
        worst_logarithm = std::max(worst_logarithm, double(std::fabs((of_x[lane] - log_x) / log_x)));
      }
      worst_exponential = std::max(worst_exponential, double(std::fabs((of_y[lane] - exp_y) / exp_y)));
    }
  }
  EXPECT_LT(worst_logarithm, 8.7 * kUnitRoundoff);
  EXPECT_LT(worst_exponential, 4.8 * kUnitRoundoff);
  EXPECT_GT(worst_logarithm, 0.5 * kUnitRoundoff);
  EXPECT_GT(worst_exponential, 0.5 * kUnitRoundoff);
}

TEST(PowersCore, FindsWhatTheBodyFinds) {
  std::mt19937_64 random(6);
  for (const auto& [axes, across, along] :
       std::vector<std::tuple<Vec3d, double, double>>{{{0.5, 0.5, 0.5}, 2.5, 2.5},
                                                      {{1.0, 2.0, 3.0}, 0.5, 0.5},
                                                      {{1.0, 0.01, 1.0}, 0.5, 1000.0},
                                                      {{1.0, 1.0, 1.0}, 1000.0, 1000.0},
                                                      {{1e-12, 1e-12, 3e-12}, 1.0, 1.0},
                                                      {{1e12, 2e12, 1e12}, 0.5000001, 30.0}}) {
    const ConvexBody body = Superellipsoid(axes.x, axes.y, axes.z, across, along);
    const std::optional<CoreForm> form = core_form(body);
    ASSERT_TRUE(form && form->kind == CoreForm::Kind::powers);
    const packet_core_test::PowersCore core(*form);
    const double error = 200.0 * kUnitRoundoff * (axes.x + axes.y + axes.z);
    for (int k = 0; k < 3000; ++k) {
      Lanes dirs;
      for (int lane = 0; lane < kLanes; ++lane) {
        Vec3d d = random_direction(random);
        if (k % 4 == 1) d = {double(random() % 3) - 1.0, double(random() % 3) - 1.0, double(random() % 3) - 1.0};
        if (k % 4 == 2)
          d = {d.x * std::ldexp(1.0, -int(random() % 60)), d.y, d.z * std::ldexp(1.0, -int(random() % 1074))};
        if (k % 4 == 3) d = {d.x, d.x * (1.0 + std::ldexp(d.y, -int(random() % 53))), d.z};
        if (norm(d) == 0.0) d = {0.0, 0.0, -1.0};
        dirs.set(lane, std::ldexp(1.0, static_cast<int>(random() % 301) - 150) * d);
      }
      const Lanes found = lanes_of(core.support(dirs.packet()));
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vec3d dir = dirs.at(lane), at = found.at(lane);
        // As far as the body's own point, to both errors, and in the body: along its own farthest directions, too.
        const double own = dot(body.support(dir), dir);
        ASSERT_NEAR(dot(at, dir), own, (error + body.support_error()) * norm_1(dir))
            << dir.x << " " << dir.y << " " << dir.z;
        const Vec3d other = random_direction(random);
        ASSERT_LE(dot(at, other), dot(body.support(other), other) + (error + body.support_error()) * norm_1(other));
      }
    }
  }
}

TEST(ProfileCore, FindsWhatTheBodyFinds) {
  std::mt19937_64 random(8);
  const ConvexBody bodies[] = {Lens(1.0, 0.3),
                               Lens(2.0, 1e-8),
                               Lens(1e12, 2e12),
                               Spindle(2.0, 0.5),
                               Spindle(1e-12, 1e-20),
                               Spindle(3.0, 1.5),
                               CutSphere(1.0, 0.3, 0.2),
                               CutSphere(5.0, 5.0, 1e-9),
                               Egg(1.0, 0.5, 0.3),
                               Egg(1e-9, 1.0, 3e6),
                               parse_shape("rounded:0.2,lens:1,0.3")};
  for (const ConvexBody& body : bodies) {
    const std::optional<CoreForm> form = core_form(body);
    ASSERT_TRUE(form && form->kind == CoreForm::Kind::profile);
    EXPECT_GT(form->support_error, 0.9 * body.core_support_error());
    const packet_core_test::ProfileCore core(*form);
    for (int k = 0; k < 3000; ++k) {
      Lanes dirs;
      for (int lane = 0; lane < kLanes; ++lane) {
        Vec3d d = random_direction(random);
        if (k % 4 == 1) d = {double(random() % 3) - 1.0, double(random() % 3) - 1.0, double(random() % 3) - 1.0};
        if (k % 4 == 2)
          d = {d.x * std::ldexp(1.0, -int(random() % 60)), d.y, d.z * std::ldexp(1.0, -int(random() % 300))};
        if (k % 4 == 3) d = {d.x * std::ldexp(1.0, -int(random() % 60)), 0.0, d.z};
        if (norm(d) == 0.0) d = {0.0, 0.0, -1.0};
        dirs.set(lane, std::ldexp(1.0, static_cast<int>(random() % 101) - 50) * d);
      }
      const Lanes found = lanes_of(core.support(dirs.packet()));
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vec3d dir = dirs.at(lane), own = body.core_support(dir);
        // Both are as near to the farthest point, so that they are nearly as far.
        ASSERT_NEAR(dot(found.at(lane), dir), dot(own, dir), 2.0 * body.support_error() * norm_1(dir))
            << dir.x << " " << dir.y << " " << dir.z;
        const Vec3d other = random_direction(random);
        ASSERT_LE(dot(found.at(lane), other),
                  dot(body.core_support(other), other) + 2.0 * body.support_error() * norm_1(other));
      }
    }
  }
}

TEST(ProfileCore, OfEggsThatAreThinBeyondMeasureThereIsNone) {
  EXPECT_FALSE(core_form(Egg(1e-31, 1.0, 1.0)));
  EXPECT_TRUE(core_form(Egg(1e-31, 1e-31, 1e-31)));
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
