// The separating axes against the descent over simplices, which shares nothing with them.
#include "tests/referees/exact_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/referees/exact_overlap.h"
#include "tests/referees/contact.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

using Points = std::vector<Vec3d>;

class Census {
 public:
  void expect_agreement(const Points& a, const Points& b) {
    const bool meets = exact::overlap(a, b);
    const Outcome expected = meets ? Outcome::overlap : Outcome::disjoint;
    ASSERT_EQ(exact_axes_outcome(a, b), expected);
    ASSERT_EQ(exact_axes_outcome(b, a), expected);
    ++n_;
    n_overlap_ += meets ? 1 : 0;
  }
  void expect_representative() const {
    EXPECT_GT(n_overlap_, 3 * n_ / 10) << n_;
    EXPECT_LT(n_overlap_, 7 * n_ / 10) << n_;
  }

 private:
  int n_ = 0, n_overlap_ = 0;
};

// Points of a lattice of `width` places along each coordinate axis, in a random affine subspace of dimension
// `dimension` or less: everything touches, repeats, is in line or in a plane again and again.
Points lattice_points(std::mt19937_64& random, int n, int dimension, int width) {
  const auto place = [&] { return static_cast<double>(random() % static_cast<unsigned>(width)); };
  const Vec3d start{place(), place(), place()};
  Points steps;
  for (int k = 0; k < dimension; ++k) steps.push_back({place() - 1.0, place() - 1.0, place() - 1.0});
  Points points;
  for (int k = 0; k < n; ++k) {
    Vec3d p = start;
    for (const Vec3d& step : steps) p = p + (place() - 1.0) * step;
    points.push_back(p);
  }
  return points;
}

TEST(ExactAxes, AgreeOnPointsOfALatticeOfEveryDimension) {
  std::mt19937_64 random(101);
  for (int dimension_a = 0; dimension_a <= 3; ++dimension_a) {
    for (int dimension_b = 0; dimension_b <= dimension_a; ++dimension_b) {
      SCOPED_TRACE(testing::Message() << dimension_a << " and " << dimension_b);
      int n_overlap = 0;
      constexpr int n = 200;
      for (int k = 0; k < n; ++k) {
        const Points a = lattice_points(random, 1 + static_cast<int>(random() % 7), dimension_a, 3);
        Points b = lattice_points(random, 1 + static_cast<int>(random() % 7), dimension_b, 3);
        if (k % 4 == 0) {  // a point in common: a vertex, or the middle of two
          const Vec3d shared = 0.5 * (a[random() % a.size()] + a[random() % a.size()]);
          const Vec3d shift = shared - b[random() % b.size()];
          for (Vec3d& p : b) p = p + shift;
        }
        const bool meets = exact::overlap(a, b);
        n_overlap += meets ? 1 : 0;
        ASSERT_EQ(exact_axes_outcome(a, b), meets ? Outcome::overlap : Outcome::disjoint);
        ASSERT_EQ(exact_axes_outcome(b, a), meets ? Outcome::overlap : Outcome::disjoint);
      }
      EXPECT_GE(n_overlap, n / 4);
      EXPECT_LE(n_overlap, 9 * n / 10);
    }
  }
}

TEST(ExactAxes, AgreeOnRandomHulls) {
  std::mt19937_64 random(103);
  Census census;
  for (int k = 0; k < 60; ++k) {
    const TestPolytope a = test_point_hull(4 + static_cast<int>(random() % 5), {1, 2, 0.5}, random());
    const TestPolytope b = test_point_hull(4 + static_cast<int>(random() % 5), {1, 1, 1}, random());
    Transformd pose = random_rotation(random);
    pose.translation = 1.5 * random_direction(random);
    census.expect_agreement(a.vertices, exact::placed(b.vertices, pose));
  }
  census.expect_representative();
}

TEST(ExactAxes, AgreeWithinBitsOfContact) {
  std::mt19937_64 random(107);
  const TestPolytope bodies[] = {test_box(1, 1, 1), test_box(0.2, 1, 3), test_tetrahedron(0.7),
                                 test_hull({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, {}, 0.0)};
  Census census;
  for (const TestPolytope& a : bodies) {
    for (const TestPolytope& b : bodies) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const auto [apart, together] = exact::contact_along(a, b, pose, dir);
      for (const double distance : {std::nextafter(together, 0.0), together, apart, std::nextafter(apart, 100.0)}) {
        pose.translation = distance * dir;
        census.expect_agreement(a.vertices, exact::placed(b.vertices, pose));
      }
    }
  }
  census.expect_representative();
}

TEST(ExactAxes, ParallelBoxesThatShareAFaceAnEdgeOrACornerOverlapAndOneBitApartTheyDoNot) {
  const Points cube = box_vertices(1, 1, 1);
  for (const Vec3d& step : {Vec3d{1, 0, 0}, Vec3d{1, 0.5, 0}, Vec3d{1, 1, 0}, Vec3d{1, -1, 1}, Vec3d{1, 0.25, 1}}) {
    Transformd pose;
    pose.translation = step;
    EXPECT_EQ(exact_axes_outcome(cube, exact::placed(cube, pose)), Outcome::overlap);
    Points moved = exact::placed(cube, pose);
    for (Vec3d& p : moved) p.x = std::nextafter(p.x, 2.0);
    EXPECT_EQ(exact_axes_outcome(cube, moved), Outcome::disjoint);
  }
}

TEST(ExactAxes, TakeEveryDouble) {
  const Points far{{1e300, 1e300, -1e300}, {1e300, -1e300, 0}, {-1e300, 0, 1e300}, {5e-324, 0, 0}};
  const Points zero{{0, 0, 0}}, tiny{{5e-324, 0, 0}};
  EXPECT_EQ(exact_axes_outcome(far, tiny), Outcome::overlap);
  EXPECT_EQ(exact_axes_outcome(zero, tiny), Outcome::disjoint);
  EXPECT_EQ(exact_axes_outcome(tiny, tiny), Outcome::overlap);
}

TEST(ExactAxes, KnowTheDimensionOfADifference) {
  const std::vector<exact::WholePoint> point{{1, 2, 3}}, along_x{{0, 0, 0}, {2, 0, 0}}, along_y{{5, 5, 5}, {5, 6, 5}};
  const std::vector<exact::WholePoint> along_z{{0, 0, 1}, {0, 0, 3}, {0, 0, 2}};
  std::vector<exact::WholePoint> plate = along_x;
  plate.push_back({0, 1, 0});
  EXPECT_EQ(exact::dimension_of_difference(point, point), 0);
  EXPECT_EQ(exact::dimension_of_difference(point, along_x), 1);
  EXPECT_EQ(exact::dimension_of_difference(along_x, along_x), 1);
  EXPECT_EQ(exact::dimension_of_difference(along_x, along_y), 2);
  EXPECT_EQ(exact::dimension_of_difference(plate, along_y), 2);
  EXPECT_EQ(exact::dimension_of_difference(plate, along_z), 3);
}

}  // namespace
}  // namespace vex
