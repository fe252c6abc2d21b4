#include "engine/sampling/radial/radial_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

// Of every kind of map: of lumps, with own axes and with the frame's, of two long bodies, of a long and a flat one.
struct Pair {
  const char *a, *b;
};
const std::vector<Pair>& pairs() {
  static const std::vector<Pair> kPairs = {{"box:1,2,3", "cone:1,1"},          {"box:1,1,1", "box:1,9,1"},
                                           {"box:1,1,1", "tetrahedron:1"},     {"box:64,1,1", "box:1,8,1"},
                                           {"capsule:9,0.5", "capsule:9,0.5"}, {"box:9,1,1", "disc:1"},
                                           {"disc:1", "capsule:9,0.5"},        {"ellipsoid:1,0.1,1", "needle:2"}};
  return kPairs;
}
std::vector<OrientationLaw> laws() {
  return {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::cone(30.0),
          OrientationLaw::onsager(4.0), OrientationLaw::fixed(1, 2, 3, 4)};
}

TEST(RadialMap, ComparesWithAParallelepipedWhereABodyIsLong) {
  const auto has_block = [](const Pair& pair) {
    return RadialMap(parse_shape(pair.a).body, parse_shape(pair.b).body, {}).has_block();
  };
  for (std::size_t k = 0; k < pairs().size(); ++k) EXPECT_EQ(has_block(pairs()[k]), k >= 3);
  EXPECT_FALSE(has_block({"needle:1", "sphere:1"}));
  EXPECT_FALSE(has_block({"disc:1", "plate:1,1"}));
}

class RadialMapOfPairs : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Pairs, RadialMapOfPairs, testing::ValuesIn(pairs()),
                         [](const auto& pair) { return "Pair" + std::to_string(pair.index); });

// For every R weight r(d)^3 has the mean |K|, of any K: of an ellipsoid r is |S d|^-1 and the volume known.
TEST_P(RadialMapOfPairs, PreservesVolumes) {
  const RadialMap map(parse_shape(GetParam().a).body, parse_shape(GetParam().b).body,
                      OrientationLaw::fixed(0.3, -0.2, 0.5, 0.4));
  constexpr int kSteps = 400;
  const auto volume_of = [&](const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const std::array<double, 3> point{(i + 0.5) / kSteps, (j + 0.5) / kSteps, 0.5};
        const RadialRay<double> ray = map(std::span<const double>(point));
        const Vec3d s{dot(x, ray.dir), dot(y, ray.dir), dot(z, ray.dir)};
        sum += ray.weight / std::pow(dot(s, s), 1.5);
      }
    }
    return sum / (kSteps * kSteps) * dot(cross(x, y), z) / (4.0 / 3.0 * std::numbers::pi);
  };
  // Of about the shape of K, as directions are dense where that is long: other ellipsoids would need more steps.
  const std::array<double, 3> middle{0.5, 0.25, 0.5};
  const Transformd r = map(std::span<const double>(middle)).rotation;
  const RadialBody a = radial_body(parse_shape(GetParam().a).body), b = radial_body(parse_shape(GetParam().b).body);
  const auto times = [](const Symmetric<double>& q, const Vec3d& v) -> Vec3d {
    return {(q.xx * v.x + q.xy * v.y) + q.xz * v.z, (q.xy * v.x + q.yy * v.y) + q.yz * v.z,
            (q.xz * v.x + q.yz * v.y) + q.zz * v.z};
  };
  const auto of_k = [&](const Vec3d& v) {
    const Vec3d at_a = a.axes.direction_to_b(times(a.q, a.axes(v)));
    const Vec3d own_b = r.direction_to_b(v);
    return at_a + r(b.axes.direction_to_b(times(b.q, b.axes(own_b))));
  };
  const Vec3d x = of_k({1, 0, 0}), y = of_k({0, 1, 0}), z = of_k({0, 0, 1});
  const Root<double> root = root_of(Symmetric<double>{x.x, y.y, z.z, x.y, x.z, y.z});
  // S = L^-1, stretched to be another ellipsoid
  const auto row = [&](const Vec3d& e) {
    return Vec3d{dot(e, root.inverse({1, 0, 0})), dot(e, root.inverse({0, 1, 0})), dot(e, root.inverse({0, 0, 1}))};
  };
  EXPECT_NEAR(volume_of(row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})), 1.0, 2e-4);
  EXPECT_NEAR(volume_of(row({0.7, 0.2, 0}), row({0.1, 1.2, 0}), row({0, -0.3, 0.9})), 1.0, 2e-4);
}

TEST_P(RadialMapOfPairs, DrawsRotationsOfTheLaw) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  for (const OrientationLaw& law : laws()) {
    const RadialMap map(a, b, law);
    EXPECT_EQ(map.dimension(), 3 + law.dimension());
    std::mt19937_64 random(2);
    double sum_zz = 0.0, sum_zz_sq = 0.0, sum_of_law = 0.0;
    constexpr int kTrials = 20000;
    for (int k = 0; k < kTrials; ++k) {
      std::array<double, RadialMap::kMaxDimension> point;
      for (double& u : point) u = random_in_unit_interval(random);
      const RadialRay<double> ray = map(std::span<const double>(point));
      const Transformd& r = ray.rotation;
      EXPECT_NEAR(dot(r.row_x, r.row_x), 1.0, 1e-14);
      EXPECT_NEAR(dot(r.row_x, r.row_y), 0.0, 1e-14);
      EXPECT_NEAR(dot(cross(r.row_x, r.row_y), r.row_z), 1.0, 1e-14);
      sum_zz += r.row_z.z;
      sum_zz_sq += r.row_z.z * r.row_z.z;
      std::array<double, OrientationLaw::kMaxDimension> other;
      for (double& u : other) u = random_in_unit_interval(random);
      const double zz = law.rotation(std::span<const double>(other)).row_z.z;
      sum_of_law += zz * zz;
    }
    EXPECT_NEAR(sum_zz_sq / kTrials, sum_of_law / kTrials, 4.0 * 0.6 * std::sqrt(2.0 / kTrials)) << law.name();
    if (law.dimension() > 0) {
      EXPECT_NEAR(sum_zz / kTrials, 0.0, 4.0 / std::sqrt(kTrials)) << law.name();
    }
  }
}

TEST_P(RadialMapOfPairs, GivesEveryLaneWhatOneLaneGives) {
  using Lanes = ArrayLanes<4>;
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  for (const OrientationLaw& law : laws()) {
    const RadialMap map(a, b, law);
    std::mt19937_64 random(3);
    std::array<Lanes, RadialMap::kMaxDimension> lanes;
    std::array<std::array<double, RadialMap::kMaxDimension>, 4> points;
    for (std::size_t c = 0; c < RadialMap::kMaxDimension; ++c) {
      for (std::size_t j = 0; j < 4; ++j) lanes[c].lane[j] = points[j][c] = random_in_unit_interval(random);
    }
    const RadialRay<Lanes> all = map(std::span<const Lanes>(lanes));
    for (std::size_t j = 0; j < 4; ++j) {
      const RadialRay<double> one = map(std::span<const double>(points[j]));
      EXPECT_EQ(all.dir.x.lane[j], one.dir.x);
      EXPECT_EQ(all.rotation.row_z.y.lane[j], one.rotation.row_z.y);
      EXPECT_EQ(all.weight.lane[j], one.weight);
      EXPECT_EQ(all.normals[2].z.lane[j], one.normals[2].z);
      EXPECT_EQ(all.pick.lane[j], one.pick);
    }
  }
}

}  // namespace
}  // namespace vex
