// Laws that hold to the last bit, because the verdict is about coordinates that the law leaves as they are: order of
// the bodies, order of their vertices, powers of two, and shifts that round nothing.
//
// Polytopes are taken as placed coordinate sets: B's placed vertices are a polytope of their own in A's frame, and the
// pose is the identity. Half of the samples lie within 1e-3 to 1e-16 of contact, others touch exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "apps/referees/exact_overlap.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/contact.h"
#include "tests/referees/coordinate_sets.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

/// Of two placed coordinate sets. A polytope is never undecided.
Outcome outcome_of(const Points& a, const Points& b) { return overlap(polytope(a), polytope(b), {}).outcome; }

/// Every law that needs no grid, of one pair of coordinate sets; `expected` is exact arithmetic's answer.
void expect_laws(const Points& a, const Points& b, Outcome expected, std::mt19937_64& random) {
  ASSERT_EQ(outcome_of(a, b), expected);
  ASSERT_EQ(outcome_of(b, a), expected) << "swapped";
  ASSERT_EQ(outcome_of(shuffled(a, random), shuffled(b, random)), expected) << "permuted";
  const int k = random_power_of_two(random);
  ASSERT_EQ(outcome_of(scaled(a, k), scaled(b, k)), expected) << "times 2^" << k;
}

Outcome exact_outcome_of(const Points& a, const Points& b) {
  return exact::overlap(a, b) ? Outcome::overlap : Outcome::disjoint;
}

/// Of the sets rounded to multiples of 2^-40, and shifts of up to 2^42 times that: sums have 53 bits. Returns the
/// verdict.
Outcome expect_shift_law(const Points& a, const Points& b, std::mt19937_64& random) {
  constexpr double grid = 0x1p-40;
  const Points on_grid_a = rounded_to_grid(a, grid), on_grid_b = rounded_to_grid(b, grid);
  const Outcome expected = exact_outcome_of(on_grid_a, on_grid_b);
  EXPECT_EQ(outcome_of(on_grid_a, on_grid_b), expected);
  const Vec3d shift = grid * Vec3d{random_whole(random, 1 << 30) * 2047.0, random_whole(random, 1 << 30) * 1023.0,
                                   random_whole(random, 1 << 20)};
  EXPECT_EQ(outcome_of(shifted(on_grid_a, shift), shifted(on_grid_b, shift)), expected);
  return expected;
}

std::vector<TestPolytope> test_polytopes() {
  std::vector<TestPolytope> all;
  for (const char* text : kTestBodies) {
    const ConvexBody body = parse_shape(text).body;
    if (const Points vertices = vertices_of(body); !vertices.empty()) all.push_back({vertices, body});
  }
  all.push_back(test_point_hull(12, {1, 2, 0.3}, 401));
  all.push_back(test_hull({{0.25, -0.5, 1.0}}, {0.25, -0.5, 1.0}, 0.0));  // a point
  all.push_back(test_hull(box_vertices(1e-9, 1, 1), {}, 0.0));
  all.push_back(test_hull(box_vertices(1e-9, 1e-9, 1), {}, 0.0));
  return all;
}

class LawsOfPlacedPolytopes : public testing::Test {
 protected:
  const std::vector<TestPolytope> bodies_ = test_polytopes();
  std::mt19937_64 random_{307};
};

TEST_F(LawsOfPlacedPolytopes, HoldNearContact) {
  Share share, share_on_grid;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const Points &a = bodies_[i].vertices, &b = bodies_[j].vertices;
      Transformd pose = random_rotation(random_);
      const Vec3d dir = random_direction(random_);
      if (!exact::overlap(a, exact::placed(b, pose))) continue;  // no contact to be found along the ray
      const exact::Contact contact = exact::contact_along(bodies_[i], bodies_[j], pose, dir);
      for (int digits = 3; digits <= 16; ++digits) {
        const double side = random_() % 2 == 0 ? 1.0 : -1.0;
        pose.translation = (contact.together * (1.0 + side * std::pow(10.0, -digits))) * dir;
        const Points placed_b = exact::placed(b, pose);
        const Outcome expected = exact_outcome_of(a, placed_b);
        share.count(expected);
        expect_laws(a, placed_b, expected, random_);
        if (HasFatalFailure()) FAIL() << digits << " digits";
        if (digits > 12) continue;
        share_on_grid.count(expect_shift_law(a, placed_b, random_));
        if (HasFatalFailure()) FAIL() << digits << " digits";
      }
    }
  }
  EXPECT_GT(share.n, 900);
  share.expect_representative();
  share_on_grid.expect_representative();
}

TEST_F(LawsOfPlacedPolytopes, HoldAtRandom) {
  Share share;
  for (const TestPolytope& a : bodies_) {
    for (const TestPolytope& b : bodies_) {
      for (int k = 0; k < 6; ++k) {
        Transformd pose = random_rotation(random_);
        pose.translation = (0.8 * (a.body.reach() + b.body.reach())) * random_direction(random_);
        const Points placed_b = exact::placed(b.vertices, pose);
        const Outcome expected = exact_outcome_of(a.vertices, placed_b);
        if (a.body.inradius() > 0.0 && b.body.inradius() > 0.0) share.count(expected);
        expect_laws(a.vertices, placed_b, expected, random_);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(share.n, 100);
  share.expect_representative();
}

TEST_F(LawsOfPlacedPolytopes, HoldWhereBodiesTouchExactly) {
  // Hulls of lattice points, flat and thin ones among them; B's copy is put so that a vertex of it is on a vertex of A,
  // on the middle of two, or on that of four (of a face or inside), and pushed off the touch by nothing at all.
  int n_touching = 0;
  Share share;
  for (int k = 0; k < 1500; ++k) {
    const auto lattice_set = [&] {
      const int dimension = static_cast<int>(random_() % 4);
      Points points;
      const int n = 1 + static_cast<int>(random_() % 9);
      for (int i = 0; i < n; ++i) {
        Vec3d p = 4.0 * random_whole_vector(random_, 2);
        if (dimension < 3) p.z = 0.0;
        if (dimension < 2) p.y = 0.0;
        if (dimension < 1) p.x = 0.0;
        points.push_back(p);
      }
      return points;
    };
    const Points a = lattice_set();
    Points b = lattice_set();
    const auto corner = [&] { return a[random_() % a.size()]; };
    const Vec3d on_a = 0.25 * (corner() + corner() + corner() + corner());
    if (k % 2 == 0) {
      b = shifted(b, on_a - b[random_() % b.size()]);
      ASSERT_EQ(exact_outcome_of(a, b), Outcome::overlap);
      ++n_touching;
    } else {
      b = shifted(b, random_whole_vector(random_, 12));
      share.count(exact_outcome_of(a, b));
    }
    const Outcome expected = exact_outcome_of(a, b);
    expect_laws(a, b, expected, random_);
    if (HasFatalFailure()) FAIL() << k;
    const Vec3d shift = std::ldexp(1.0, static_cast<int>(random_() % 40)) * random_whole_vector(random_, 99);
    ASSERT_EQ(outcome_of(shifted(a, shift), shifted(b, shift)), expected) << "shifted, " << k;
  }
  EXPECT_EQ(n_touching, 750);
  EXPECT_GT(share.n_overlap, 40) << "some of the others must overlap, too";
  EXPECT_LT(share.n_overlap, share.n - 100);
}

TEST_F(LawsOfPlacedPolytopes, ParallelBoxesThatShareAFaceAnEdgeOrACornerOverlap) {
  for (int k = 0; k < 60; ++k) {
    const auto edge = [&] { return std::ldexp(1.0 + static_cast<double>(random_() % 7), -3); };
    const Vec3d a{edge(), edge(), edge()}, b{edge(), edge(), edge()};
    const Points box_a = box_vertices(a.x, a.y, a.z), box_b = box_vertices(b.x, b.y, b.z);
    const Vec3d contact = 0.5 * (a + b);
    const Vec3d steps[] = {
        {contact.x, 0, 0}, {0, -contact.y, 0}, {0, contact.y, contact.z}, {-contact.x, contact.y, contact.z}};
    for (const Vec3d& step : steps) {
      const Points placed_b = shifted(box_b, step);
      expect_laws(box_a, placed_b, Outcome::overlap, random_);
      const Vec3d off = 0x1p-45 * Vec3d{std::copysign(step.x == 0 ? 0.0 : 1.0, step.x),
                                        std::copysign(step.y == 0 ? 0.0 : 1.0, step.y),
                                        std::copysign(step.z == 0 ? 0.0 : 1.0, step.z)};
      expect_laws(box_a, shifted(placed_b, off), Outcome::disjoint, random_);
      expect_laws(box_a, shifted(placed_b, -off), Outcome::overlap, random_);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace vex
