#include "engine/scene/compound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/query/world_queries.h"
#include "engine/support/triangle_body.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_compound.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Triangle = std::array<Vec3d, 3>;

// A bowl: a grid of triangles over z = (x^2 + y^2) / 4, its vertices shared.
std::vector<Triangle> bowl(int n) {
  std::vector<Triangle> triangles;
  const auto at = [n](int i, int j) {
    const double x = 2.0 * i / n - 1.0, y = 2.0 * j / n - 1.0;
    return Vec3d{x, y, 0.25 * (x * x + y * y)};
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

// What must be answered, from every pair of parts with no tree between.
struct EveryPart {
  Outcome outcome = Outcome::disjoint;
  double lower = HUGE_VAL, upper = HUGE_VAL;
  std::vector<PartPair> overlapping, undecided;

  void add(const ConvexBody& a, const ConvexBody& b, const Pose& pose, PartPair pair) {
    const Separation found = distance(a, b, pose);
    lower = std::fmin(lower, found.lower);
    upper = std::fmin(upper, found.upper);
    if (found.verdict.outcome == Outcome::overlap) {
      outcome = Outcome::overlap;
      overlapping.push_back(pair);
    } else if (found.verdict.outcome == Outcome::undecided) {
      undecided.push_back(pair);
      if (outcome == Outcome::disjoint) outcome = Outcome::undecided;
    }
  }
};

EveryPart every_part(const Compound& a, const ConvexBody& b, const Pose& pose) {
  EveryPart all;
  for (std::uint32_t k = 0; k < a.size(); ++k) {
    all.add(a.body(k), b, relative_pose(a.compound_from_part(k), pose), {k, 0});
  }
  return all;
}
EveryPart every_part(const Compound& a, const Compound& b, const Pose& pose) {
  EveryPart all;
  for (std::uint32_t k = 0; k < a.size(); ++k) {
    for (std::uint32_t l = 0; l < b.size(); ++l) {
      all.add(a.body(k), b.body(l), relative_pose(a.compound_from_part(k), pose * b.compound_from_part(l)), {k, l});
    }
  }
  return all;
}

template <class B>
void expect_as_every_part(const Compound& a, const B& b, const Pose& pose) {
  const EveryPart all = every_part(a, b, pose);
  const CompoundVerdict verdict = overlap(a, b, pose);
  ASSERT_EQ(verdict.verdict.outcome, all.outcome);
  PartPairs pairs;
  overlapping_parts(a, b, pose, pairs);
  EXPECT_EQ(pairs.pairs, all.overlapping);
  EXPECT_EQ(pairs.undecided, all.undecided);
  if (all.outcome == Outcome::overlap) {
    EXPECT_TRUE(std::binary_search(pairs.pairs.begin(), pairs.pairs.end(), PartPair{verdict.part_a, verdict.part_b}));
  }
  const CompoundSeparation found = distance(a, b, pose);
  ASSERT_EQ(found.separation.verdict.outcome, all.outcome);
  if (all.outcome == Outcome::overlap) {
    EXPECT_EQ(found.separation.signed_distance, 0.0);
    EXPECT_FALSE(found.separation.has_witnesses);
    return;
  }
  EXPECT_EQ(found.separation.lower, all.lower);
  EXPECT_EQ(found.separation.upper, all.upper);
  const Separation& of_union = found.separation;
  const double rounding = 1e-8 * (of_union.signed_distance + 10.0);
  EXPECT_LT(norm((of_union.point_b - of_union.point_a) - of_union.signed_distance * of_union.normal), rounding);
}

TEST(Compound, AnswersAsEveryPartDoes) {
  std::mt19937_64 random(311);
  const Compound a = random_compound(random, 30, 6.0);
  int n_overlaps = 0, n_pairs = 0;
  constexpr int kPoses = 60;
  for (int k = 0; k < kPoses; ++k) {
    const ConvexBody b = parse_shape(kTestBodies[static_cast<std::size_t>(k) % kTestBodies.size()]).body;
    Transformd pose = random_rotation(random);
    pose.translation = 6.5 * random_direction(random);
    expect_as_every_part(a, b, pose);
    const CompoundVerdict verdict = overlap(a, b, pose);
    n_overlaps += verdict.verdict.outcome == Outcome::overlap ? 1 : 0;
    n_pairs += static_cast<int>(verdict.n_pairs);
  }
  EXPECT_GT(n_overlaps, kPoses / 5);
  EXPECT_LT(n_overlaps, kPoses * 4 / 5);
  EXPECT_LT(n_pairs, kPoses * 10) << "the tree keeps far parts away";
}

TEST(Compound, AnswersAsEveryPartDoesWhereRotationsAreOnlyNearlyOnes) {
  // Off by 2e-7 each, so that boxes, parts and bodies are where the compound's frame has them to no more than that; and
  // large, so that it shows.
  std::mt19937_64 random(318);
  const auto stretched = [&](double far) {
    Transformd pose = random_rotation(random);
    for (Vec3d* const row : {&pose.row_x, &pose.row_y, &pose.row_z}) *row = (1.0 + 0.99e-7) * *row;
    pose.translation = far * random_direction(random);
    return pose;
  };
  std::vector<CompoundPart> parts;
  const ConvexBody slab = parse_shape("box:1000,1000,1").body, ball = parse_shape("sphere:300").body;
  for (int k = 0; k < 20; ++k) parts.push_back({k % 2 == 0 ? slab : ball, stretched(2500.0)});
  const Compound a(std::move(parts));
  int n_near = 0;
  for (int k = 0; k < 60; ++k) {
    Transformd pose = stretched(1.0);
    pose.translation = (6000.0 / norm(pose.translation)) * pose.translation;
    // Until the least gap of all is a billionth of what the bodies measure; parts see ways 1e-7 longer than they are.
    for (const double gap : {1.0, 1e-3, 1e-6}) {
      const Separation now = distance(a, slab, pose).separation;
      if (now.has_witnesses) pose.translation = pose.translation - (now.signed_distance - gap) * now.normal;
    }
    expect_as_every_part(a, slab, pose);
    const CompoundSeparation found = distance(a, slab, pose);
    n_near += found.separation.has_witnesses && found.separation.signed_distance < 1e-3 ? 1 : 0;
  }
  EXPECT_GT(n_near, 10);
}

TEST(Compound, AnswersOfTwoCompoundsAreThoseOfEveryPairOfParts) {
  std::mt19937_64 random(312);
  const Compound a = random_compound(random, 12, 3.0), b = random_compound(random, 9, 2.0);
  int n_overlaps = 0;
  constexpr int kPoses = 24;
  for (int k = 0; k < kPoses; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 9.0 * random_direction(random);
    expect_as_every_part(a, b, pose);
    n_overlaps += overlap(a, b, pose).verdict.outcome == Outcome::overlap ? 1 : 0;
  }
  EXPECT_GT(n_overlaps, 4);
  EXPECT_LT(n_overlaps, kPoses - 4);
}

TEST(Compound, NearContactOfAMeshAndAPolytopeIsTheTruthOfRationalNumbers) {
  std::mt19937_64 random(313);
  const std::vector<Triangle> triangles = bowl(4);
  const Compound mesh = compound_of_triangles(triangles);
  const TestPolytope gem = test_point_hull(12, {0.3, 0.3, 0.3}, 5);
  int n_overlaps = 0, n = 0;
  for (int k = 0; k < 40; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = {0.6 * random_in_unit_interval(random) - 0.3, 0.6 * random_in_unit_interval(random) - 0.3, 0.0};
    // Down until it touches, to the last place of its height; and there, or a little above.
    double above = 1.0, below = 0.1;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (above + below);
      pose.translation.z = middle;
      (overlap(mesh, gem.body, pose).verdict.outcome == Outcome::disjoint ? above : below) = middle;
    }
    pose.translation.z = k % 2 == 0 ? above : below;
    bool meets = false;
    const std::vector<Vec3d> placed = exact::placed(gem.vertices, pose);
    for (const Triangle& triangle : triangles) {
      meets = meets || exact::overlap({triangle.begin(), triangle.end()}, placed);
    }
    ASSERT_EQ(overlap(mesh, gem.body, pose).verdict.outcome, meets ? Outcome::overlap : Outcome::disjoint);
    n_overlaps += meets ? 1 : 0;
    ++n;
  }
  EXPECT_GT(n_overlaps, n / 10);
  EXPECT_LT(n_overlaps, n * 9 / 10);
}

TEST(Compound, APartThatIsUndecidedMakesTheUnionUndecidedUnlessAnotherOneOverlaps) {
  // Two lenses have no exact form; tip to tip they are undecided.
  const ConvexBody lens = parse_shape("lens:0.9,0.7").body, box = parse_shape("box:1,1,1").body;
  double apart = 2.0 * lens.circumradius(), together = 0.0;
  const auto at = [](double x) { return Pose(Transformd{.translation = {x, 0.0, 0.0}}); };
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (apart + together);
    const Outcome outcome = overlap(lens, lens, at(middle)).outcome;
    (outcome == Outcome::disjoint ? apart : together) = middle;
    if (outcome == Outcome::undecided) break;
  }
  ASSERT_EQ(overlap(lens, lens, at(together)).outcome, Outcome::undecided);
  const Compound one({{lens, Pose()}, {box, at(10.0)}}), two({{lens, Pose()}, {box, at(together)}});
  const CompoundVerdict open = overlap(one, lens, at(together));
  EXPECT_EQ(open.verdict.outcome, Outcome::undecided);
  EXPECT_EQ(open.part_a, 0u);
  const Separation apart_by = distance(one, lens, at(together)).separation;
  EXPECT_EQ(apart_by.verdict, distance(lens, lens, at(together)).verdict);
  const CompoundVerdict met = overlap(two, lens, at(together));
  EXPECT_EQ(met.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(met.part_a, 1u);
  PartPairs pairs;
  overlapping_parts(two, lens, at(together), pairs);
  EXPECT_EQ(pairs.pairs, (std::vector<PartPair>{{1, 0}}));
  EXPECT_EQ(pairs.undecided, (std::vector<PartPair>{{0, 0}}));
}

TEST(Compound, PartsInTheirPlaceAreAskedAboutThePoseAsItIs) {
  std::mt19937_64 random(314);
  Transformd pose = random_rotation(random);
  pose.translation = {1e8, 3.0, -1e-3};
  const Compound mesh = compound_of_triangles(bowl(2));
  const Transformd same = mesh.part_from_b(3, pose).a_from_b(), back = mesh.frame_from_part(3, pose).a_from_b();
  for (const Transformd& got : {same, back}) {
    EXPECT_EQ(got.row_x.y, pose.row_x.y);
    EXPECT_EQ(got.row_z.x, pose.row_z.x);
    EXPECT_EQ(got.translation.z, pose.translation.z);
  }
}

template <class Ask>
void expect_earliest(const CompoundContact& found, std::size_t n_parts, const Ask& ask) {
  double lower = HUGE_VAL, upper = HUGE_VAL;
  bool is_open = false;
  for (std::uint32_t k = 0; k < n_parts; ++k) {
    const FirstContact one = ask(k);
    if (one.verdict.outcome == Outcome::disjoint) continue;
    is_open = is_open || one.verdict.outcome == Outcome::undecided;
    lower = std::fmin(lower, one.lower);
    if (one.verdict.outcome == Outcome::overlap) upper = std::fmin(upper, one.upper);
  }
  const FirstContact& contact = found.contact;
  if (upper < HUGE_VAL) {
    ASSERT_EQ(contact.verdict.outcome, Outcome::overlap);
    EXPECT_EQ(contact.lower, std::fmin(lower, contact.lower));
    EXPECT_NEAR(contact.lower, lower, 1e-9 * (1.0 + lower));
    EXPECT_NEAR(contact.upper, upper, 1e-9 * (1.0 + upper));
    EXPECT_LE(contact.lower, contact.time);
    EXPECT_LE(contact.time, contact.upper);
  } else {
    EXPECT_EQ(contact.verdict.outcome, is_open ? Outcome::undecided : Outcome::disjoint);
  }
}

TEST(Compound, CastsAndImpactsAreTheEarliestOfEveryPart) {
  std::mt19937_64 random(315);
  const Compound a = random_compound(random, 25, 5.0);
  const ConvexBody b = parse_shape("rounded:0.1,tetrahedron:1").body;
  int n_met = 0, n_later = 0;
  for (int k = 0; k < 40; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 12.0 * random_direction(random);
    const Vec3d motion = 4.0 * random_direction(random) - 0.5 * pose.translation;
    const CompoundContact found = linear_cast(a, b, pose, motion);
    n_met += found.contact.verdict.outcome == Outcome::overlap ? 1 : 0;
    expect_earliest(found, a.size(), [&](std::uint32_t part) {
      const Transformd& part_pose = a.compound_from_part(part).a_from_b();
      return linear_cast(a.body(part), b, relative_pose(part_pose, pose, {}), part_pose.direction_to_b(motion));
    });
    if (found.contact.verdict.outcome == Outcome::overlap) {
      // Moved there, it touches.
      Transformd there = pose;
      there.translation = there.translation + found.contact.time * motion;
      EXPECT_LT(distance(a, b, there).separation.signed_distance, 1e-8);
      EXPECT_NEAR(norm(found.contact.normal), 1.0, 1e-9);
    }
    if (found.contact.verdict.outcome == Outcome::overlap && found.contact.time > 0.0) {
      ++n_later;
      EXPECT_LT(norm(found.contact.point_a - found.contact.point_b), 1e-6);
      const double early = 0.99 * found.contact.lower;
      EXPECT_EQ(linear_cast(a, b, pose, motion, early).contact.verdict.outcome, Outcome::disjoint);
    }
    expect_earliest(cast_ray(a, pose.translation, motion), a.size(), [&](std::uint32_t part) {
      const Transformd& p = a.compound_from_part(part).a_from_b();
      return cast_ray(a.body(part), p.direction_to_b(pose.translation - p.translation), p.direction_to_b(motion));
    });
    const RigidMotion turning{motion, 0.3 * random_direction(random)};
    if (k % 4 == 0) {
      expect_earliest(time_of_impact(a, b, pose, turning, 3.0), a.size(), [&](std::uint32_t part) {
        const Transformd& p = a.compound_from_part(part).a_from_b();
        return time_of_impact(a.body(part), b, relative_pose(p, pose, {}),
                              {p.direction_to_b(turning.velocity), p.direction_to_b(turning.angular_velocity)}, 3.0);
      });
    }
  }
  EXPECT_GT(n_later, 10);
  EXPECT_LT(n_met, 40);
}

TEST(Compound, ABodyThatOnlyTurnsMeetsWhatItSweeps) {
  const ConvexBody ball = parse_shape("sphere:0.5").body, bar = parse_shape("box:4,0.1,0.1").body;
  const Compound posts(
      {{ball, Transformd{.translation = {0.0, 2.0, 0.0}}}, {ball, Transformd{.translation = {0.0, -9.0, 0.0}}}});
  const CompoundContact hit = time_of_impact(posts, bar, Pose(), {{}, {0.0, 0.0, 1.0}});
  ASSERT_EQ(hit.contact.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(hit.part_a, 0u);
  EXPECT_GT(hit.contact.time, 1.0);
  EXPECT_LT(hit.contact.time, 1.5708);
  // Turned the other way it meets the same post with its other end, at the same time.
  const CompoundContact other = time_of_impact(posts, bar, Pose(), {{}, {0.0, 0.0, -1.0}});
  EXPECT_NEAR(other.contact.time, hit.contact.time, 1e-9);
}

TEST(Compound, TwoCompoundsMeetWhenTheirFirstPartsDo) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  const Compound a({{box, Pose()}, {box, Transformd{.translation = {0.0, 3.0, 0.0}}}});
  const Compound b(
      {{box, Transformd{.translation = {2.0, 0.0, 0.0}}}, {box, Transformd{.translation = {0.5, 3.0, 0.0}}}});
  const CompoundContact hit = linear_cast(a, b, Transformd{.translation = {4.0, 0.0, 0.0}}, {-1.0, 0.0, 0.0});
  ASSERT_EQ(hit.contact.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(hit.contact.time, 3.5, 1e-12);
  EXPECT_EQ(hit.part_a, 1u);
  EXPECT_EQ(hit.part_b, 1u);
  EXPECT_EQ(linear_cast(a, b, Transformd{.translation = {4.0, 0.0, 0.0}}, {1.0, 0.0, 0.0}).contact.verdict.outcome,
            Outcome::disjoint);
}

TEST(Compound, OnAFloorTheDeepestPartIsTheDepth) {
  const ConvexBody box = parse_shape("box:1,1,1").body, ball = parse_shape("sphere:0.5").body;
  const Compound table(
      {{box, Transformd{.translation = {0.0, 0.0, 2.0}}}, {ball, Transformd{.translation = {0.5, 0.0, 1.0}}}});
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const CompoundSeparation above = signed_distance(floor, table, Transformd{.translation = {0.0, 0.0, 0.25}});
  EXPECT_NEAR(above.separation.signed_distance, 0.75, 1e-14);
  EXPECT_EQ(above.part_b, 1u);
  EXPECT_EQ(above.separation.verdict.outcome, Outcome::disjoint);
  const CompoundSeparation below = signed_distance(floor, table, Transformd{.translation = {0.0, 0.0, -2.0}});
  EXPECT_NEAR(below.separation.signed_distance, -1.5, 1e-14);
  EXPECT_EQ(below.separation.verdict.outcome, Outcome::overlap);
}

TEST(Compound, DistanceWithAnEndStopsThere) {
  const Compound mesh = compound_of_triangles(bowl(8));
  const ConvexBody ball = parse_shape("sphere:0.1").body;
  const Pose far = Transformd{.translation = {0.0, 0.0, 5.0}};
  const CompoundSeparation ended = distance(mesh, ball, far, {.max_distance = 1.0});
  EXPECT_EQ(ended.separation.verdict.outcome, Outcome::disjoint);
  EXPECT_GE(ended.separation.lower, 1.0);
  EXPECT_EQ(ended.n_pairs, 0u);
  EXPECT_GT(distance(mesh, ball, far).separation.lower, 4.0);
}

// A part whose box is near and that is far itself said nothing of the parts whose boxes are farther than the end.
TEST(Compound, DistanceWithAnEndBoundsPartsThatWereNotAsked) {
  const double eighth = std::acos(-1.0) / 8.0;
  const Compound two(
      {{parse_shape("capsule:20,0.01").body, pose_of({std::cos(eighth), 0.0, std::sin(eighth), 0.0}, {})},
       {parse_shape("sphere:0.1").body, Transformd{.translation = {9.5, 0.0, -5.2}}}});
  const ConvexBody ball = parse_shape("sphere:0.5").body;
  const Pose at = Transformd{.translation = {7.0, 0.0, -7.0}};
  const double truth = std::hypot(2.5, 1.8) - 0.6;
  EXPECT_NEAR(distance(two, ball, at).separation.signed_distance, truth, 1e-9);
  for (const double end : {0.0, 1.0, 2.0, 2.4, 2.5, 3.0, 9.0, 20.0}) {
    const Separation found = distance(two, ball, at, {.max_distance = end}).separation;
    EXPECT_LE(found.lower, truth) << end;
    EXPECT_GE(found.upper, truth) << end;
    EXPECT_EQ(found.has_witnesses, end > truth) << end;
  }
}

TEST(Compound, OnAFloorBoundsThatAreWideAreSaidToBe) {
  const ConvexBody ball = parse_shape("sphere:1").body;
  const Compound two({{ball, Transformd{.translation = {1.5, 1.5, 0.0}}},
                      {ball, Transformd{.translation = {1e12, -1e12 + 3.0005, 0.0}}}});
  const Separation found = signed_distance(HalfSpace({1.0, 1.0, 0.0}, 0.0), two, Pose()).separation;
  EXPECT_GT(found.upper - found.lower, 1e-6);
  EXPECT_TRUE(found.is_rough);
}

// Fewer digits than there are is what is promised anyway.
TEST(Compound, OfOnePartIsAsRoughAsThePart) {
  const ConvexBody a = parse_shape("ellipsoid:1,2,3").body, b = parse_shape("ellipsoid:0.5,1,1.5").body;
  const Compound one({{a, Pose()}});
  const Pose at = Transformd{.translation = {3.0, 2.0, 4.0}};
  for (const double gap : {0.0, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3}) {
    const Separation found = distance(one, b, at, {.relative_gap = gap}).separation;
    EXPECT_EQ(found.is_rough, distance(a, b, at, {.relative_gap = gap}).is_rough) << gap;
    EXPECT_FALSE(found.is_rough) << gap;
  }
}

TEST(Compound, ManyPosesAreAnsweredAsOneByOne) {
  std::mt19937_64 random(316);
  const Compound mesh = compound_of_triangles(bowl(8));
  const ConvexBody b = parse_shape("capsule:0.3,0.1").body;
  std::vector<Pose> poses;
  for (int k = 0; k < 300; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = random_direction(random);
    poses.emplace_back(pose);
  }
  std::vector<CompoundVerdict> verdicts(poses.size());
  std::vector<CompoundSeparation> distances(poses.size());
  for (const int n_threads : {1, 2}) {
    overlap(mesh, b, poses, verdicts, n_threads);
    distance(mesh, b, poses, distances, {}, n_threads);
    int n_overlaps = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const CompoundVerdict one = overlap(mesh, b, poses[k]);
      EXPECT_EQ(verdicts[k].verdict, one.verdict);
      EXPECT_EQ(verdicts[k].part_a, one.part_a);
      n_overlaps += one.verdict.outcome == Outcome::overlap ? 1 : 0;
      const CompoundSeparation apart = distance(mesh, b, poses[k]);
      EXPECT_EQ(distances[k].separation.signed_distance, apart.separation.signed_distance);
      EXPECT_EQ(distances[k].part_a, apart.part_a);
    }
    EXPECT_GT(n_overlaps, 60);
    EXPECT_LT(n_overlaps, 240);
  }
  EXPECT_THROW(overlap(mesh, b, poses, std::span(verdicts).first(3)), UsageError);
  EXPECT_THROW(overlap(mesh, b, poses, verdicts, 0), UsageError);
}

TEST(Compound, WhatIsNoneIsRefused) {
  EXPECT_THROW(Compound({}), InputError);
  EXPECT_THROW(compound_of_triangles({}), InputError);
  EXPECT_THROW(TriangleBody({Vec3d{}, Vec3d{HUGE_VAL, 0.0, 0.0}, Vec3d{}}), InputError);
  const ConvexBody box = parse_shape("box:1,1,1").body;
  EXPECT_THROW(Compound({{box, Transformd{.translation = {1e101, 0.0, 0.0}}}}), InputError);
  const Compound one({{box, Pose()}});
  EXPECT_THROW(linear_cast(one, box, Pose(), {}), InputError);
  EXPECT_THROW(cast_ray(one, {std::nan(""), 0.0, 0.0}, {1.0, 0.0, 0.0}), InputError);
  EXPECT_THROW(distance(one, box, Pose(), {.max_distance = -1.0}), UsageError);
  Transformd stretched;
  stretched.row_x.x = 1.0 + 4.9e-7;
  EXPECT_THROW(overlap(Compound({{box, stretched}}), box, stretched), InputError);
}

// What breaks the promises of a support mapping.
struct NoNumber {
  Vec3d support(const Vec3d& /*dir*/) const { return {std::nan(""), 0.0, 0.0}; }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 1.0; }
  double inradius() const { return 0.0; }
};

TEST(Compound, ABodyThatIsNoneIsNotSaidToBeApart) {
  const Compound mesh = compound_of_triangles(bowl(2));
  const ConvexBody none = NoNumber{};
  EXPECT_EQ(overlap(mesh, none, Pose()).verdict.outcome, Outcome::undecided);
  EXPECT_EQ(distance(mesh, none, Pose()).separation.verdict.outcome, Outcome::undecided);
  EXPECT_EQ(linear_cast(mesh, none, Pose(), {0.0, 0.0, 1.0}).contact.verdict.outcome, Outcome::undecided);
  EXPECT_EQ(overlap(HalfSpace({0.0, 0.0, 1.0}, 0.0), none, Pose()).outcome, Outcome::undecided);
  EXPECT_THROW(Compound({{none, Pose()}}), InputError);
}

TEST(TriangleBody, IsItsThreeVertices) {
  std::mt19937_64 random(317);
  const Triangle corners = {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}};
  const TriangleBody triangle(corners);
  const TestPolytope same = test_hull({corners.begin(), corners.end()}, triangle.centre(), 0.0);
  for (int k = 0; k < 200; ++k) {
    const Vec3d dir = random_direction(random), got = triangle.support(dir), expected = same.body.support(dir);
    EXPECT_EQ(got.x, expected.x);
    EXPECT_EQ(got.y, expected.y);
    EXPECT_EQ(got.z, expected.z);
  }
  EXPECT_TRUE(ConvexBody(triangle).is_rounded_polytope());
  // Points of no extent will do.
  EXPECT_EQ(TriangleBody({Vec3d{}, Vec3d{}, Vec3d{}}).circumradius(), 0.0);
}

}  // namespace
}  // namespace vex
