#include "engine/scene/periodic_box.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/numeric/errors.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

std::vector<PeriodicBox> boxes() {
  return {PeriodicBox::cube(1.0), PeriodicBox(2, 3, 5), PeriodicBox(4, 3, 2, 0.5, -0.7, 1.3),
          PeriodicBox(1e-3, 1e3, 1, -2, 0.1, 3), PeriodicBox(1e50, 1e50, 2e50, 0.2, 0, 0)};
}

double determinant(const PeriodicBox& box) {
  return dot(box.shift({1, 0, 0}), cross(box.shift({0, 1, 0}), box.shift({0, 0, 1})));
}

TEST(PeriodicBox, HasTheVolumeAndTheFaceDistancesOfItsVectors) {
  for (const PeriodicBox& box : boxes()) {
    const Vec3d a = box.shift({1, 0, 0}), b = box.shift({0, 1, 0}), c = box.shift({0, 0, 1});
    EXPECT_NEAR(box.volume(), determinant(box), 1e-14 * box.volume());
    const Vec3d distances = box.face_distances();
    EXPECT_NEAR(distances.x * norm(cross(b, c)), box.volume(), 1e-13 * box.volume());
    EXPECT_NEAR(distances.y * norm(cross(c, a)), box.volume(), 1e-13 * box.volume());
    EXPECT_NEAR(distances.z * norm(cross(a, b)), box.volume(), 1e-13 * box.volume());
  }
}

TEST(PeriodicBox, ShiftsByWholeVectors) {
  for (const PeriodicBox& box : boxes()) {
    const Vec3d a = box.shift({1, 0, 0}), b = box.shift({0, 1, 0}), c = box.shift({0, 0, 1});
    EXPECT_EQ(a.x, box.edges().x);
    EXPECT_EQ(b.y, box.edges().y);
    EXPECT_EQ(c.z, box.edges().z);
    EXPECT_EQ(a.y, 0.0);
    EXPECT_EQ(a.z, 0.0);
    EXPECT_EQ(b.z, 0.0);
    const Vec3d sum = 2.0 * a - 3.0 * b + 5.0 * c, shift = box.shift({2, -3, 5});
    const double error = 1e-14 * (norm(a) + norm(b) + norm(c));
    EXPECT_NEAR(shift.x, sum.x, 5 * error);
    EXPECT_NEAR(shift.y, sum.y, 5 * error);
    EXPECT_NEAR(shift.z, sum.z, 5 * error);
    EXPECT_EQ(norm(box.shift({0, 0, 0})), 0.0);
  }
}

TEST(PeriodicBox, WrapsEveryPointIntoTheCellAndSaysByWhichImage) {
  std::mt19937_64 random(41);
  for (const PeriodicBox& box : boxes()) {
    for (int k = 0; k < 1000; ++k) {
      const double far = k % 3 == 0 ? 0.4 : 20.0;
      const Vec3d f = far * random_direction(random);
      const Vec3d a = box.shift({1, 0, 0}), b = box.shift({0, 1, 0}), c = box.shift({0, 0, 1});
      const Vec3d point = f.x * a + f.y * b + f.z * c;
      ImageOffset image{};
      const Vec3d wrapped = box.wrapped(point, &image);
      const Vec3d inside = box.fractional(wrapped);
      for (const double x : {inside.x, inside.y, inside.z}) {
        EXPECT_GE(x, -0.5 - 1e-11);
        EXPECT_LT(x, 0.5 + 1e-11);
      }
      const Vec3d sum = point + box.shift(image);
      EXPECT_EQ(wrapped.x, sum.x);
      EXPECT_EQ(wrapped.y, sum.y);
      EXPECT_EQ(wrapped.z, sum.z);
      if (far < 0.5) {
        EXPECT_EQ(image, ImageOffset{});
      }
    }
  }
}

TEST(PeriodicBox, RefusesWhatIsNoBox) {
  for (const double edge : {0.0, -1.0, 1e101, 1e-101, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(PeriodicBox(edge, 1, 1), InputError);
    EXPECT_THROW(PeriodicBox(1, edge, 1), InputError);
    EXPECT_THROW(PeriodicBox(1, 1, edge), InputError);
  }
  EXPECT_THROW(PeriodicBox(1, 1, 1, 101, 0, 0), InputError);
  EXPECT_THROW(PeriodicBox(1, 1, 1, 0, std::nan(""), 0), InputError);
  ImageOffset image{};
  EXPECT_THROW(PeriodicBox::cube(1.0).wrapped({1e10, 0, 0}, &image), InputError);
}

}  // namespace
}  // namespace vex
