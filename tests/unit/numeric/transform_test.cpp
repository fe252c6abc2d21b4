#include "engine/numeric/transform.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/numeric/eigen.h"

namespace vex {
namespace {

double random_unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; }

TEST(Transform, PlacesAPointInTheDocumentedOrderOfOperations) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k) {
    Transformd a_from_b;
    for (double* entry : {&a_from_b.row_x.x, &a_from_b.row_x.y, &a_from_b.row_x.z, &a_from_b.translation.x}) {
      *entry = random_unit(random);
    }
    const Vec3d p{random_unit(random), random_unit(random), random_unit(random)};
    // Each product and sum rounded on its own: volatile forbids the compiler any other order.
    volatile double first = a_from_b.row_x.x * p.x;
    volatile double second = a_from_b.row_x.y * p.y;
    volatile double third = a_from_b.row_x.z * p.z;
    volatile double sum = first + second;
    sum = sum + third;
    sum = sum + a_from_b.translation.x;
    EXPECT_EQ(bits_of(a_from_b(p).x), bits_of(double(sum)));
  }
}

TEST(Transform, AgreesWithEigen) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  pose.pretranslate(Eigen::Vector3d(3, -4, 5));
  const Transformd a_from_b = from_eigen(pose);
  const Eigen::Vector3d p(0.3, -0.2, 0.9);
  EXPECT_LT(norm(a_from_b(from_eigen(p)) - from_eigen(Eigen::Vector3d(pose * p))), 1e-15 * 10);
  const Eigen::Vector3d turned_back = pose.linear().transpose() * p;
  EXPECT_LT(norm(a_from_b.direction_to_b(from_eigen(p)) - from_eigen(turned_back)), 1e-15);
}

}  // namespace
}  // namespace vex
