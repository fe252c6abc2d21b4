#include "engine/scene/pose_batches.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/numeric/errors.h"
#include "engine/query/packets/cast_guess.h"
#include "engine/query/packets/nearest_guess.h"
#include "engine/query/packets/packet_pair.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
void expect_same(const Vec3d& a, const Vec3d& b) {
  EXPECT_EQ(bits(a.x), bits(b.x));
  EXPECT_EQ(bits(a.y), bits(b.y));
  EXPECT_EQ(bits(a.z), bits(b.z));
}
void expect_same(const Separation& a, const Separation& b) {
  EXPECT_EQ(a.verdict.outcome, b.verdict.outcome);
  EXPECT_EQ(a.verdict.reason, b.verdict.reason);
  EXPECT_EQ(bits(a.signed_distance), bits(b.signed_distance));
  EXPECT_EQ(bits(a.lower), bits(b.lower));
  EXPECT_EQ(bits(a.upper), bits(b.upper));
  EXPECT_EQ(a.is_rough, b.is_rough);
  EXPECT_EQ(a.has_witnesses, b.has_witnesses);
  expect_same(a.normal, b.normal);
  expect_same(a.point_a, b.point_a);
  expect_same(a.point_b, b.point_b);
  expect_same(a.point_b_in_b, b.point_b_in_b);
}

void expect_same(const FirstContact& a, const FirstContact& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(bits(a.time), bits(b.time));
  EXPECT_EQ(bits(a.lower), bits(b.lower));
  EXPECT_EQ(bits(a.upper), bits(b.upper));
  expect_same(a.normal, b.normal);
  expect_same(a.point_a, b.point_a);
  expect_same(a.point_b, b.point_b);
  expect_same(a.point_b_in_b, b.point_b_in_b);
}

// Of every second pose to a place of the bodies' size about A, of the others anywhere.
Vec3d about_towards(const Pose& pose, std::size_t k, double size, std::mt19937_64& random) {
  const Vec3d aside = size * random_direction(random);
  return k % 2 == 0 ? 0.5 * aside - pose.a_from_b().translation : aside;
}

// Half of them at contact, to the last places.
std::vector<Pose> poses_of(const ConvexBody& a, const ConvexBody& b, std::mt19937_64& random, int n) {
  std::vector<Pose> poses;
  for (int k = 0; k < n; ++k) {
    Transformd pose = random_rotation(random);
    const Vec3d dir = random_direction(random);
    double at = (a.reach() + b.reach()) * (0.5 + 0.5 * random_in_unit_interval(random));
    if (k % 8 == 0) {
      at = contact_along(a, b, pose, dir);
      for (int step = 0; step < k / 8 % 3; ++step) at = std::nextafter(at, k % 16 == 0 ? HUGE_VAL : 0.0);
    }
    pose.translation = at * dir;
    poses.emplace_back(pose);
  }
  return poses;
}

// The last one, of a body that rolls a ball, asks other points of its core.
const std::vector<NamedPair>& few_pairs() {
  static const std::vector<NamedPair> pairs = {{"box:1,1,1", "box:0.2,1,3"},
                                               {"cylinder:1,0.5", "cone:1,0.5"},
                                               {"ellipsoid:1,2,3", "ellipsoid:2,1,1"},
                                               {"snub-cube:0.5", "tetrahedron:1"},
                                               {"truncated-icosahedron:1", "rounded:0.1,tetrahedron:1"}};
  return pairs;
}

// Two answers to the same question, each with its own bounds.
void expect_agreement(const Separation& found, const Separation& single, double circumradii, double promised_gap) {
  EXPECT_EQ(found.verdict.outcome, single.verdict.outcome);
  EXPECT_EQ(found.verdict.reason, single.verdict.reason);
  EXPECT_EQ(found.has_witnesses, single.has_witnesses);
  EXPECT_FALSE(found.is_rough && !single.is_rough);
  EXPECT_LE(found.lower, single.upper);
  EXPECT_GE(found.upper, single.lower);
  if (!found.has_witnesses || found.is_rough) return;
  const double promised = promised_gap * (std::fabs(found.signed_distance) + circumradii);
  EXPECT_LE(found.upper - found.lower, promised);
  EXPECT_LE(found.lower, found.signed_distance);
  EXPECT_LE(found.signed_distance, found.upper);
  const Vec3d off = (found.point_b - found.point_a) - found.signed_distance * found.normal;
  EXPECT_LE(norm(off), 2.0 * promised);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
}

// Of the points only how far they are from each other: where they are may be any place of two faces that meet.
void expect_agreement(const FirstContact& found, const FirstContact& single, const Vec3d& motion, double promised) {
  EXPECT_EQ(found.verdict.outcome, single.verdict.outcome);
  EXPECT_EQ(found.verdict.reason, single.verdict.reason);
  if (found.verdict.outcome != Outcome::overlap) return;
  EXPECT_LE(found.lower, single.upper);
  EXPECT_GE(found.upper, single.lower);
  EXPECT_LE(found.lower, found.time);
  EXPECT_LE(found.time, found.upper);
  const double width = found.upper - found.lower;
  EXPECT_LE(width, 4.0 * (single.upper - single.lower) + promised / norm(motion));
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
  if (found.time == 0.0) return;
  EXPECT_LE(norm(found.point_b - found.point_a), 2.0 * promised + 2.0 * width * norm(motion));
}

TEST(PoseBatches, AnswerAsOneByOne) {
  std::mt19937_64 random(331);
  int n_overlaps = 0, n = 0;
  std::vector<NamedPair> pairs = {{"box:1,1,1", "box:0.2,1,3"},       {"capsule:1,0.25", "box:1,1,1"},
                                  {"cylinder:1,0.5", "cone:1,0.5"},   {"ellipsoid:1,2,3", "sphere:0.6"},
                                  {"snub-cube:0.5", "tetrahedron:1"}, {"lens:0.9,0.7", "box:1,1,1"},
                                  {"capsule:1,0.2", "capsule:2,0.1"}, {"rounded:0.1,box:1,1,1", "plate:2,1"}};
  for (const NamedPair& pair : pairs) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const double size = a.circumradius() + b.circumradius();
    const double gap = a.is_rounded_polytope() && b.is_rounded_polytope() ? 1e-12 : 1e-9;
    const std::vector<Pose> poses = poses_of(a, b, random, 300);
    std::vector<Separation> apart(poses.size()), deep(poses.size()), either(poses.size()), apart_by_two(poses.size());
    std::vector<FirstContact> casts(poses.size()), casts_by_two(poses.size());
    std::vector<Vec3d> motions;
    for (std::size_t k = 0; k < poses.size(); ++k) motions.push_back(about_towards(poses[k], k, size, random));
    distance(a, b, poses, apart_by_two, {}, 2);
    linear_cast(a, b, poses, motions, casts_by_two, 3.0, 2);
    for (const int n_threads : {1, 2}) {
      distance(a, b, poses, apart, {}, n_threads);
      penetration_depth(a, b, poses, deep, {}, n_threads);
      signed_distance(a, b, poses, either, {.relative_gap = 1e-3}, n_threads);
      linear_cast(a, b, poses, motions, casts, 3.0, n_threads);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        expect_same(apart[k], apart_by_two[k]);
        expect_same(casts[k], casts_by_two[k]);
      }
    }
    for (std::size_t k = 0; k < poses.size(); ++k) {
      expect_agreement(apart[k], distance(a, b, poses[k]), size, gap);
      expect_same(deep[k], penetration_depth(a, b, poses[k]));
      expect_agreement(either[k], signed_distance(a, b, poses[k], {.relative_gap = 1e-3}), size, 1e-3);
      expect_agreement(casts[k], linear_cast(a, b, poses[k], motions[k], 3.0), motions[k], gap * size);
      n_overlaps += apart[k].verdict.outcome == Outcome::overlap ? 1 : 0;
      ++n;
    }
  }
  EXPECT_GT(n_overlaps, n * 3 / 10);
  EXPECT_LT(n_overlaps, n * 7 / 10);
}

// What packets guess leaves a search little to do.
TEST(PoseBatches, TakeFewSupportCalls) {
  std::mt19937_64 random(332);
  for (const NamedPair& pair : std::span(few_pairs()).first(4)) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const std::vector<Pose> poses = poses_of(a, b, random, 1000);
    std::vector<Separation> apart(poses.size());
    distance(a, b, poses, apart);
    int n_apart = 0, n_calls = 0, n_calls_of_one = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if (apart[k].verdict.by != DecidedBy::gjk || apart[k].verdict.outcome != Outcome::disjoint) continue;
      ++n_apart;
      n_calls += apart[k].n_support_calls;
      n_calls_of_one += distance(a, b, poses[k]).n_support_calls;
    }
    EXPECT_GT(n_apart, 100);
    EXPECT_LT(n_calls, 4.6 * n_apart);
    EXPECT_LT(n_calls, n_calls_of_one);
  }
}

TEST(PoseBatches, OfCastsTakeFewSupportCalls) {
  std::mt19937_64 random(334);
  for (const NamedPair& pair : std::span(few_pairs()).first(4)) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const double size = a.circumradius() + b.circumradius();
    std::vector<Pose> poses;
    std::vector<Vec3d> motions;
    for (std::size_t k = 0; k < 1000; ++k) {
      Transformd pose = random_rotation(random);
      pose.translation = 3.0 * size * unit_along(random_direction(random));
      poses.emplace_back(pose);
      motions.push_back(about_towards(poses.back(), k, size, random));
    }
    std::vector<FirstContact> casts(poses.size());
    linear_cast(a, b, poses, motions, casts);
    int n_hits = 0, n_calls = 0, n_calls_of_one = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      n_hits += casts[k].verdict.outcome == Outcome::overlap ? 1 : 0;
      n_calls += casts[k].n_support_calls;
      n_calls_of_one += linear_cast(a, b, poses[k], motions[k]).n_support_calls;
    }
    EXPECT_GT(n_hits, 200);
    EXPECT_LT(n_calls, 5 * 1000);
    EXPECT_LT(2 * n_calls, n_calls_of_one);
  }
}

// What the arithmetic of lanes, or of doubles, has no room for is left to the query of one pose.
TEST(PoseBatches, OfCastsTakeMotionsOfAnyLengthAndPosesFarAway) {
  const ConvexBody a = parse_shape("box:1,1,1").body, b = parse_shape("ellipsoid:1,2,3").body;
  std::vector<Pose> poses;
  std::vector<Vec3d> motions;
  for (const double distance : {5.0, 1e10, 1e300}) {
    for (const double length : {1e-310, 1.0, 1e308}) {
      for (const double sign : {-1.0, 1.0}) {
        Transformd pose;
        pose.translation = {distance, 0.1 * distance, 0.0};
        poses.emplace_back(pose);
        motions.push_back({sign * length, 0.1 * sign * length, 0.0});
      }
    }
  }
  std::vector<FirstContact> casts(poses.size());
  linear_cast(a, b, poses, motions, casts);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    expect_agreement(casts[k], linear_cast(a, b, poses[k], motions[k]), motions[k],
                     1e-9 * (3.5 + norm_1(poses[k].a_from_b().translation)));
  }
  std::vector<Vec3d> wrong = motions;
  wrong.back() = Vec3d{};
  EXPECT_THROW(linear_cast(a, b, poses, wrong, casts), InputError);
  wrong.back() = {std::nan(""), 0.0, 1.0};
  EXPECT_THROW(linear_cast(a, b, poses, wrong, casts), InputError);
  EXPECT_THROW(linear_cast(a, b, poses, motions, casts, -1.0), UsageError);
}

// The last digits of distances hang on them.
TEST(NearestGuesses, AreTheSameOfEverySet) {
  std::mt19937_64 random(333);
  for (const NamedPair& pair : few_pairs()) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const std::unique_ptr<PacketPair> packets = PacketPair::make(a, b);
    ASSERT_NE(packets, nullptr);
    const std::vector<Pose> poses = poses_of(a, b, random, 30);
    std::vector<double> columns(kPoseColumns * NearestGuesses::kStride);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      set_pose(columns.data(), NearestGuesses::kStride, k, poses[k].a_from_b());
    }
    const PoseTable table{columns.data(), NearestGuesses::kStride, poses.size()};
    const NearestGoal goal{0x1p-32, a.circumradius() + b.circumradius(), packets->are_polytopes(), HUGE_VAL};
    const auto expected = std::make_unique<NearestGuesses>(), found = std::make_unique<NearestGuesses>();
    baseline::guess_nearest(packets->forms(), goal, table, *expected);
    for (const InstructionSet set : instruction_sets()) {
      nearest_guesser(set)(packets->forms(), goal, table, *found);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const NearestGuess guess = expected->of(k), other = found->of(k);
        ASSERT_EQ(guess.n, other.n) << name_of(set);
        ASSERT_GE(guess.n, 1U);
        for (std::size_t c = 0; c < guess.n; ++c) {
          expect_same(guess.corners[c].of_a, other.corners[c].of_a);
          expect_same(guess.corners[c].of_b, other.corners[c].of_b);
        }
      }
    }
  }
}

TEST(CastGuesses, AreTheSameOfEverySet) {
  std::mt19937_64 random(335);
  for (const NamedPair& pair : few_pairs()) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const double size = a.circumradius() + b.circumradius();
    const std::unique_ptr<PacketPair> packets = PacketPair::make(a, b);
    ASSERT_NE(packets, nullptr);
    const std::vector<Pose> poses = poses_of(a, b, random, 30);
    constexpr std::size_t kStride = CastGuesses::kStride;
    std::vector<double> columns(kPoseColumns * kStride), motions(3 * kStride);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      set_pose(columns.data(), kStride, k, poses[k].a_from_b());
      const Vec3d motion = about_towards(poses[k], k, size, random);
      motions[k] = motion.x;
      motions[kStride + k] = motion.y;
      motions[2 * kStride + k] = motion.z;
    }
    const PoseTable table{columns.data(), kStride, poses.size()};
    const auto expected = std::make_unique<CastGuesses>(), found = std::make_unique<CastGuesses>();
    baseline::guess_casts(packets->forms(), 0x1p-46 * size, table, motions.data(), *expected);
    int n_portals = 0;
    for (const InstructionSet set : instruction_sets()) {
      cast_guesser(set)(packets->forms(), 0x1p-46 * size, table, motions.data(), *found);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const CastGuess guess = expected->of(k), other = found->of(k);
        ASSERT_EQ(guess.n, other.n) << name_of(set);
        for (std::size_t c = 0; c < guess.n; ++c) expect_same(guess.dirs[c], other.dirs[c]);
        n_portals += guess.n == CastGuess::kMost ? 1 : 0;
      }
    }
    EXPECT_GT(n_portals, 5);
  }
}

TEST(PoseBatches, OfRaysAnswerAsOneByOne) {
  std::mt19937_64 random(336);
  for (const char* name : {"box:1,1,1", "capsule:1,0.25", "cone:1,0.5", "ellipsoid:1,2,3", "superball:2,1", "disc:1",
                           "truncated-icosahedron:1"}) {
    SCOPED_TRACE(name);
    const ConvexBody body = parse_shape(name).body;
    std::vector<Vec3d> origins, dirs;
    for (std::size_t k = 0; k < 500; ++k) {
      const double from = k % 16 == 0 ? 0.1 : 1.0 + 5.0 * random_in_unit_interval(random);
      origins.push_back(from * body.reach() * unit_along(random_direction(random)));
      dirs.push_back(1.5 * body.reach() * random_direction(random) - origins.back());
    }
    std::vector<FirstContact> found(origins.size()), by_two(origins.size());
    cast_ray(body, origins, dirs, found);
    cast_ray(body, origins, dirs, by_two, HUGE_VAL, 2);
    int n_hits = 0;
    for (std::size_t k = 0; k < origins.size(); ++k) {
      expect_same(found[k], by_two[k]);
      const FirstContact single = cast_ray(body, origins[k], dirs[k]);
      expect_agreement(found[k], single, dirs[k], 1e-9 * body.reach());
      n_hits += single.verdict.outcome == Outcome::overlap ? 1 : 0;
    }
    EXPECT_GT(n_hits, 50);
    EXPECT_LT(n_hits, 450);
  }
}

TEST(PoseBatches, RefuseWhatTheQueriesRefuse) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  const std::vector<Pose> poses(3);
  std::vector<Separation> out(3), few(2);
  EXPECT_THROW(distance(box, box, poses, few), UsageError);
  EXPECT_THROW(signed_distance(box, box, poses, out, {}, 0), UsageError);
  EXPECT_THROW(distance(box, box, poses, out, {.max_distance = -1.0}), UsageError);
  EXPECT_THROW(penetration_depth(box, box, poses, out, {.relative_gap = -1.0}), UsageError);
  std::vector<FirstContact> casts(3);
  const std::vector<Vec3d> motions(2, Vec3d{1.0, 0.0, 0.0});
  EXPECT_THROW(linear_cast(box, box, poses, motions, casts), UsageError);
  EXPECT_THROW(cast_ray(box, motions, motions, casts), UsageError);
  EXPECT_THROW(cast_ray(box, motions, std::vector<Vec3d>(2), std::span(casts).first(2)), InputError);
  const std::vector<Vec3d> no_numbers(2, Vec3d{std::nan(""), 0.0, 0.0});
  EXPECT_THROW(cast_ray(box, no_numbers, motions, std::span(casts).first(2), HUGE_VAL, 2), InputError);
}

}  // namespace
}  // namespace vex
