#include "engine/sampling/percolation/placements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/numeric/errors.h"
#include "engine/numeric/pose.h"
#include "shapes/box.h"
#include "shapes/hemisphere.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

TEST(Placements, CentresAreUniformInTheCube) {
  const Placements placements({{Hemisphere(0.5), 1.0}}, {}, 5);
  const Vec3d own_centre = placements.parts()[0].body.centre();
  constexpr std::uint32_t kBodies = 20000;
  constexpr double kEdge = 3.0;
  Vec3d sum{}, squares{};
  for (std::uint32_t k = 0; k < kBodies; ++k) {
    const Vec3d centre = placements({2, 7}, k, kEdge).world_from_body.a_from_b()(own_centre);
    for (const double x : {centre.x, centre.y, centre.z}) EXPECT_LE(std::fabs(x), 0.5 * kEdge * (1.0 + 1e-12));
    sum = sum + centre;
    squares = squares + Vec3d{centre.x * centre.x, centre.y * centre.y, centre.z * centre.z};
  }
  const double error = kEdge / std::sqrt(12.0 * kBodies);
  const double error_of_square = kEdge * kEdge / std::sqrt(180.0 * kBodies);
  for (const double x : {sum.x, sum.y, sum.z}) EXPECT_NEAR(x / kBodies, 0.0, 5.0 * error);
  for (const double x : {squares.x, squares.y, squares.z}) {
    EXPECT_NEAR(x / kBodies, kEdge * kEdge / 12.0, 5.0 * error_of_square);
  }
}

TEST(Placements, KindsComeInTheirFractions) {
  const Placements placements({{Sphere(1.0), 3.0}, {Sphere(2.0), 1.0}, {Box(1.0, 1.0, 1.0), 4.0}}, {}, 1);
  constexpr std::uint32_t kBodies = 40000;
  std::array<double, 3> n{};
  for (std::uint32_t k = 0; k < kBodies; ++k) n[placements({}, k, 1.0).part] += 1.0;
  const std::array<double, 3> shares = {0.375, 0.125, 0.5};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(n[k] / kBodies, shares[k], 5.0 * std::sqrt(shares[k] * (1.0 - shares[k]) / kBodies));
  }
}

// cos^2 of the polar angle of each body's z axis: its mean, and that of its square for the error.
double mean_square_of_cosine(const BodyOrientations& orientations, std::uint32_t n_bodies) {
  const Placements placements({{Box(1.0, 1.0, 1.0), 1.0}}, orientations, 3);
  double sum = 0.0;
  for (std::uint32_t k = 0; k < n_bodies; ++k) {
    const Transformd pose = placements({}, k, 1.0).world_from_body.a_from_b();
    EXPECT_LE(distance_from_rotation(pose), 1e-13);
    sum += pose.row_z.z * pose.row_z.z;
  }
  return sum / n_bodies;
}

TEST(Placements, BodiesAreTurnedByTheLaw) {
  constexpr std::uint32_t kBodies = 40000;
  constexpr double kError = 0.35 / 200.0;  // no law scatters more: cos^2 is within 0 and 1
  EXPECT_NEAR(mean_square_of_cosine({OrientationLaw::isotropic()}, kBodies), 1.0 / 3.0, 5.0 * kError);
  EXPECT_EQ(mean_square_of_cosine({OrientationLaw::aligned()}, 100), 1.0);
  const double c = std::cos(30.0 / 180.0 * 3.14159265358979);
  EXPECT_NEAR(mean_square_of_cosine({OrientationLaw::cone(30.0)}, kBodies), (1.0 - c * c * c) / (3.0 * (1.0 - c)),
              5.0 * kError);
  const OrientationLaw onsager = OrientationLaw::onsager(4.0);
  EXPECT_NEAR(mean_square_of_cosine({onsager}, kBodies), (2.0 * *onsager.order_parameter() + 1.0) / 3.0, 5.0 * kError);
  // Not isotropic: the poles have too many.
  EXPECT_NEAR(mean_square_of_cosine({OrientationLaw::isotropic(), true}, kBodies), 0.5, 5.0 * kError);
}

TEST(Placements, OneBodyAlonePicturesTwo) {
  // R_A^T R_B of two placed bodies is distributed as OrientationLaw::rotation is: <P_2> of their z axes is the square
  // of the order parameter.
  const OrientationLaw law = OrientationLaw::onsager(3.0);
  const Placements placements({{Box(1.0, 1.0, 1.0), 1.0}}, {law}, 11);
  constexpr std::uint32_t kPairs = 40000;
  double sum = 0.0;
  for (std::uint32_t k = 0; k < kPairs; ++k) {
    const Transformd a = placements({}, 2 * k, 1.0).world_from_body.a_from_b(),
                     b = placements({}, 2 * k + 1, 1.0).world_from_body.a_from_b();
    const double cosine = a.row_x.z * b.row_x.z + a.row_y.z * b.row_y.z + a.row_z.z * b.row_z.z;
    sum += 1.5 * cosine * cosine - 0.5;
  }
  EXPECT_NEAR(sum / kPairs, *law.order_parameter() * *law.order_parameter(), 5.0 * 0.5 / std::sqrt(1.0 * kPairs));
}

TEST(Placements, WhatIsNotDrawnChangesNothingElse) {
  // Balls and aligned bodies need no rotation; where they are does not depend on that.
  const Placements turned({{Box(1.0, 1.0, 1.0), 1.0}}, {}, 4),
      aligned({{Box(1.0, 1.0, 1.0), 1.0}}, {OrientationLaw::aligned()}, 4), balls({{Sphere(1.0), 1.0}}, {}, 4),
      mixture({{Sphere(1.0), 1.0}, {Box(1.0, 1.0, 1.0), 1.0}}, {}, 4);
  std::uint32_t n_boxes = 0;
  for (std::uint32_t k = 0; k < 100; ++k) {
    const Transformd pose = turned({1, 2}, k, 3.0).world_from_body.a_from_b();
    for (const Placements* const other : {&aligned, &balls}) {
      const Transformd its = (*other)({1, 2}, k, 3.0).world_from_body.a_from_b();
      EXPECT_EQ(norm_1(its.translation - pose.translation), 0.0);
      EXPECT_EQ(its.row_x.x, 1.0);
    }
    const Placements::Placed one = mixture({1, 2}, k, 3.0);
    EXPECT_EQ(norm_1(one.world_from_body.a_from_b().translation - pose.translation), 0.0);
    EXPECT_EQ(one.world_from_body.a_from_b().row_x.x, one.part == 1 ? pose.row_x.x : 1.0);
    n_boxes += one.part;
  }
  EXPECT_GT(n_boxes, 20u);
  EXPECT_LT(n_boxes, 80u);
}

TEST(Placements, ManyAreTheBitsOfEach) {
  const RealisationId id{3, 1234567};
  const auto expect_same = [&](const Placements& placements, InstructionSet set, std::uint32_t first, std::uint32_t n) {
    Placements::Many many;
    placements.many(id, first, n, 7.0, set, many);
    ASSERT_EQ(many.part.size(), n);
    ASSERT_EQ(many.world_from_body.size(), n);
    for (std::uint32_t k = 0; k < n; ++k) {
      const Placements::Placed one = placements(id, first + k, 7.0);
      ASSERT_EQ(many.part[k], one.part);
      ASSERT_EQ(std::memcmp(&many.world_from_body[k], &one.world_from_body, sizeof(Pose)), 0);
    }
  };
  for (const InstructionSet set : instruction_sets()) {
    for (const std::uint32_t n : {1u, 23u, 96u, 97u, 300u}) {
      expect_same(Placements({{Box(1.0, 1.0, 1.0), 1.0}}, {}, 4), set, 1000, n);
      expect_same(Placements({{Sphere(1.0), 1.0}, {Hemisphere(1.0), 1.0}}, {}, 5), set, 0, n);
      expect_same(Placements({{Box(1.0, 1.0, 2.0), 1.0}}, {OrientationLaw::onsager(5.0)}, 6), set, 77, n);
      expect_same(Placements({{Box(1.0, 1.0, 1.0), 1.0}}, {OrientationLaw::aligned()}, 7), set, (1u << 30) - n, n);
    }
  }
}

TEST(Placements, WhatIsNoMixtureIsRefused) {
  EXPECT_THROW(Placements({}, {}, 1), UsageError);
  EXPECT_THROW(Placements({{Sphere(1.0), 0.0}}, {}, 1), UsageError);
  EXPECT_THROW(Placements({{Sphere(1.0), std::nan("")}}, {}, 1), UsageError);
  EXPECT_THROW(Placements({{Sphere(1.0), 1.0}}, {OrientationLaw::fixed(1.0, 0.0, 0.0, 0.0)}, 1), UsageError);
}

}  // namespace
}  // namespace vex
