// Laws that hold to the last bit, because the verdict is about coordinates that the law leaves as they are: order of
// the bodies, order of their vertices, powers of two, and shifts that round nothing.
//
// Polytopes are taken as placed coordinate sets: B's placed vertices are a polytope of their own in A's frame, and the
// pose is the identity. Half of the samples lie within 1e-3 to 1e-16 of contact, others touch exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "apps/referees/exact_overlap.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/contact.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

using Points = std::vector<Vec3d>;

constexpr int kLargestPowerOfTwo = 60;

/// Its point of the inside is a vertex, which needs no rounding; it claims no inner ball.
ConvexBody polytope(const Points& points) { return Polytope(points, points.front(), 0.0); }

/// Of two placed coordinate sets. A polytope is never undecided.
Outcome outcome_of(const Points& a, const Points& b) { return overlap(polytope(a), polytope(b), {}).outcome; }

Points scaled(const Points& points, int power_of_two) {
  Points result;
  for (const Vec3d& p : points) result.push_back(std::ldexp(1.0, power_of_two) * p);
  return result;
}

Points shuffled(Points points, std::mt19937_64& random) {
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

int random_power_of_two(std::mt19937_64& random) {
  return static_cast<int>(random() % (2 * kLargestPowerOfTwo + 1)) - kLargestPowerOfTwo;
}

/// A whole number from -largest to largest.
double random_whole(std::mt19937_64& random, int largest) {
  return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * largest + 1)) - largest);
}
Vec3d random_whole_vector(std::mt19937_64& random, int largest) {
  return {random_whole(random, largest), random_whole(random, largest), random_whole(random, largest)};
}

/// The sums, each of which must be exact: x + s rounds to nothing else where both differences give the parts back.
Points shifted(const Points& points, const Vec3d& shift) {
  Points result;
  for (const Vec3d& p : points) {
    result.push_back(p + shift);
    const Vec3d& sum = result.back();
    EXPECT_EQ(norm_1((sum - shift) - p) + norm_1((sum - p) - shift), 0.0) << "a shift that rounds shows nothing";
  }
  return result;
}

Points rounded_to_grid(const Points& points, double grid) {
  Points result;
  for (const Vec3d& p : points) {
    result.push_back(grid * Vec3d{std::nearbyint(p.x / grid), std::nearbyint(p.y / grid), std::nearbyint(p.z / grid)});
  }
  return result;
}

struct Share {
  int n = 0, n_overlap = 0;
  void count(Outcome outcome) {
    ++n;
    n_overlap += outcome == Outcome::overlap ? 1 : 0;
  }
  void expect_representative() const {
    EXPECT_GE(10 * n_overlap, 3 * n) << n;
    EXPECT_LE(10 * n_overlap, 7 * n) << n;
  }
};

// ---- Polytopes, by their placed coordinates.

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
  for (int k = 0; k < 200; ++k) {
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

// ---- Bodies of every kind.

/// The last translation along `dir` at which the bodies are not proven disjoint.
double last_contact(const ConvexBody& a, const ConvexBody& b, Transformd pose, const Vec3d& dir) {
  double together = 0.0, apart = 4.0 * (a.reach() + b.reach()) / norm(dir);
  for (int k = 0; k < 70; ++k) {
    const double middle = 0.5 * (together + apart);
    pose.translation = middle * dir;
    (overlap(a, b, pose).outcome == Outcome::disjoint ? apart : together) = middle;
  }
  return together;
}

class LawsOfEveryBody : public testing::TestWithParam<BodyPair> {
 protected:
  std::mt19937_64 random_{311};
};

TEST_P(LawsOfEveryBody, PowersOfTwoChangeNoVerdict) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  Share share;
  for (int k = 0; k < 12; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    const double contact = last_contact(a, b, pose, dir);
    const int power_of_two = random_power_of_two(random_);
    const double factor = std::ldexp(1.0, power_of_two);
    const ConvexBody scaled_a = parse_shape(GetParam().a, factor).body,
                     scaled_b = parse_shape(GetParam().b, factor).body;
    for (int digits = 3; digits <= 16; ++digits) {
      for (const double side : {-1.0, 1.0}) {
        pose.translation = (contact * (1.0 + side * std::pow(10.0, -digits))) * dir;
        const Verdict verdict = overlap(a, b, pose);
        if (digits <= 9) share.count(verdict.outcome);
        Transformd scaled_pose = pose;
        scaled_pose.translation = factor * pose.translation;
        ASSERT_EQ(overlap(scaled_a, scaled_b, scaled_pose), verdict) << "times 2^" << power_of_two << ", " << digits;
      }
    }
  }
  share.expect_representative();
}

INSTANTIATE_TEST_SUITE_P(Pairs, LawsOfEveryBody, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

/// Not those of two bodies in planes z = 0, which without a rotation meet in their plane or not at all.
std::vector<BodyPair> pairs_that_meet_unturned() {
  const auto is_flat = [](const std::string& text) {
    const ConvexBody body = parse_shape(text).body;
    return body.support({0, 0, 1}).z == 0.0 && body.support({0, 0, -1}).z == 0.0;
  };
  std::vector<BodyPair> pairs;
  for (const BodyPair& pair : unordered_pairs()) {
    if (!is_flat(pair.a) || !is_flat(pair.b)) pairs.push_back(pair);
  }
  return pairs;
}

class LawsOfBodiesUnturned : public LawsOfEveryBody {};

TEST_P(LawsOfBodiesUnturned, OverlapIsMutualUnderATranslation) {
  // B moved by t in A's frame, or A by -t in B's: the same two sets, moved as one. Polytopes have coordinates on a
  // grid, so that the placed ones are exact.
  constexpr double grid = 0x1p-40;
  const auto on_grid = [](const std::string& text) -> ConvexBody {
    const ConvexBody body = parse_shape(text).body;
    const Points vertices = vertices_of(body);
    return vertices.empty() ? body : polytope(rounded_to_grid(vertices, grid));
  };
  const ConvexBody a = on_grid(GetParam().a), b = on_grid(GetParam().b);
  const Points vertices_a = vertices_of(a), vertices_b = vertices_of(b);
  const bool has_vertices = !vertices_a.empty() || !vertices_b.empty();
  Share share;
  for (int k = 0; k < 20; ++k) {
    const Vec3d dir = random_direction(random_);
    const double contact = last_contact(a, b, {}, dir);
    if (contact < 1e-6) continue;  // a flat face on the origin, moved outwards
    for (int digits = 3; digits <= (has_vertices ? 12 : 16); ++digits) {
      for (const double side : {-1.0, 1.0}) {
        Vec3d step = (contact * (1.0 + side * std::pow(10.0, -digits))) * dir;
        if (has_vertices) step = rounded_to_grid({step}, grid).front();
        shifted(vertices_a, -step);  // checks that nothing is rounded
        shifted(vertices_b, step);
        Transformd there, back;
        there.translation = step;
        back.translation = -step;
        const Verdict one = overlap(a, b, there), other = overlap(b, a, back);
        if (digits <= 8) share.count(one.outcome);
        if (one.outcome != Outcome::undecided && other.outcome != Outcome::undecided) {
          ASSERT_EQ(one.outcome, other.outcome) << digits;
          continue;
        }
        // The two searches start from opposite ends and may give up within the rounding band, each on its own.
        ASSERT_FALSE(!vertices_a.empty() && !vertices_b.empty()) << "polytopes are always decided";
        ASSERT_GT(digits, 8);
        ASSERT_EQ((one.outcome == Outcome::undecided ? one : other).reason, UndecidedReason::rounding);
      }
    }
  }
  EXPECT_GT(share.n, 60);
  share.expect_representative();
}

INSTANTIATE_TEST_SUITE_P(Pairs, LawsOfBodiesUnturned, testing::ValuesIn(pairs_that_meet_unturned()),
                         [](const auto& pair) { return test_name(pair.param); });

}  // namespace
}  // namespace vex
