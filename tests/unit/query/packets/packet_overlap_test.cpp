#include "engine/query/packets/packet_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/numeric/quaternion.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/packets/core_form.h"
#include "engine/query/separation.h"
#include "shapes/any_shape.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr std::size_t kStride = PacketOverlap::kStride;

struct Table {
  std::vector<double> columns = std::vector<double>(kPoseColumns * kStride, std::nan(""));
  std::size_t n = 0;

  void add(const Transformd& pose) {
    set_pose(columns.data(), kStride, n, pose);
    ++n;
  }
  PoseTable table() const { return {columns.data(), kStride, n}; }
};

std::vector<InstructionSet> kernel_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : instruction_sets()) {
    if (set != InstructionSet::scalar) sets.push_back(set);
  }
  return sets;
}

/// An ellipsoid whose centre is not the origin.
class OffsetEllipsoid {
 public:
  OffsetEllipsoid(const Vec3d& centre, const Vec3d& semi_axes) : centre_(centre), semi_axes_(semi_axes) {}
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3d& a = semi_axes_;
    const Vec3<L> image{L(a.x) * dir.x, L(a.y) * dir.y, L(a.z) * dir.z};
    const L scale = L(1.0) / norm(image);
    return broadcast<L>(centre_) +
           Vec3<L>{L(a.x) * (scale * image.x), L(a.y) * (scale * image.y), L(a.z) * (scale * image.z)};
  }
  double support_error() const { return 16.0 * kUnitRoundoff * (norm_1(centre_) + norm_1(semi_axes_)); }
  ExactForm exact_form() const { return {{}, {{centre_, semi_axes_}}, 0.0}; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return std::max({semi_axes_.x, semi_axes_.y, semi_axes_.z}); }
  double inradius() const { return std::min({semi_axes_.x, semi_axes_.y, semi_axes_.z}); }

 private:
  Vec3d centre_, semi_axes_;
};

/// What tells nothing of its form.
class Nameless : public Ellipsoid {
 public:
  using Ellipsoid::Ellipsoid;
  std::optional<ExactForm> exact_form() const { return std::nullopt; }
};

ConvexBody with_table(const std::vector<Vec3d>& vertices) {
  ConvexBody body = Polytope(vertices, {}, 0.0);
  EXPECT_TRUE(body.direction_table().has_value());
  return body;
}

std::vector<Vec3d> points_on_cube(int n) {
  std::vector<Vec3d> points;
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < n; ++k) {
      const double a = 2.0 * j / (n - 1) - 1.0, b = 2.0 * k / (n - 1) - 1.0;
      for (const double side : {-1.0, 1.0}) {
        for (const Vec3d& p : {Vec3d{side, a, b}, Vec3d{a, side, b}, Vec3d{a, b, side}}) points.push_back(p);
      }
    }
  }
  return points;
}

// Boxes, flat ones and needles; balls and what is rounded; ellipsoids; hulls, off their frames' origins too.
std::vector<ConvexBody> packet_bodies() {
  std::vector<ConvexBody> bodies;
  for (const char* text : {"box:1,1,1",
                           "box:0.2,1,3",
                           "plate:1,1.3",
                           "needle:2",
                           "sphere:0.6",
                           "capsule:1,0.25",
                           "rounded:0.1,box:1,2,0.5",
                           "ellipsoid:1,2,3",
                           "ellipsoid:0.5,0.5,2",
                           "tetrahedron:1.3",
                           "icosahedron:0.7",
                           "rounded:0.2,octahedron:1",
                           "box:1,1,1e-6",
                           "ellipsoid:1,1,1e-3",
                           "cylinder:1,0.5",
                           "cone:1,0.5",
                           "hemisphere:1",
                           "disc:1",
                           "rounded:0.1,disc:1",
                           "frustum:1,0.3,0.6"}) {
    bodies.push_back(parse_shape(text).body);
  }
  bodies.emplace_back(
      Polytope(std::vector<Vec3d>{{5, 5, 5}, {6, 5, 5}, {5, 6.5, 5}, {5.2, 5.1, 6}}, {5.3, 5.4, 5.2}, 0.1));
  bodies.emplace_back(Polytope(std::vector<Vec3d>{{1, 2, 3}, {1, 2, 4}, {1, 3, 3}, {1, 3, 4}}, {1, 2.5, 3.5}, 0.0));
  bodies.emplace_back(OffsetEllipsoid({5, -3, 2}, {1, 0.5, 0.2}));
  bodies.emplace_back(with_table(test_point_hull(100, {3, 2, 1}, 1).vertices));
  bodies.emplace_back(with_table(points_on_cube(6)));
  return bodies;
}

// Along a ray from A's centre, B stands at `share` of the distance from which on the circumscribed balls are apart.
Transformd pose_at(const ConvexBody& a, const ConvexBody& b, double share, std::mt19937_64& random) {
  Transformd pose = random_rotation(random);
  const Vec3d turned_centre = pose(b.centre());
  const Vec3d dir = random_direction(random);
  pose.translation = a.centre() - turned_centre + (share * (a.circumradius() + b.circumradius()) / norm(dir)) * dir;
  return pose;
}

TEST(PacketOverlap, AnswersWhatTheEngineProves) {
  std::mt19937_64 random(5);
  for (const InstructionSet set : kernel_sets()) {
    long n_open = 0, n_overlap = 0, n_disjoint = 0;
    const std::vector<ConvexBody> bodies = packet_bodies();
    for (const ConvexBody& a : bodies) {
      for (const ConvexBody& b : bodies) {
        const std::unique_ptr<PacketOverlap> packets = make_packet_overlap(packet_kernel(set), a, b);
        ASSERT_NE(packets, nullptr);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        // Numbers of trials that fill no packet, too.
        Table table;
        const std::size_t n = 1 + random() % PacketOverlap::kMostTrials;
        for (std::size_t k = 0; k < n; ++k) table.add(pose_at(a, b, share(random), random));
        std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
        packets->decide(table.table(), answers.data());
        for (std::size_t k = 0; k < n; ++k) {
          const Outcome truth = overlap(a, b, table.table().pose(k)).outcome;
          if (answers[k] == PacketAnswer::open) ++n_open;
          if (answers[k] == PacketAnswer::overlap) {
            ++n_overlap;
            ASSERT_EQ(truth, Outcome::overlap);
          }
          if (answers[k] == PacketAnswer::disjoint) {
            ++n_disjoint;
            ASSERT_EQ(truth, Outcome::disjoint);
          }
        }
      }
    }
    // Differences without a volume have no simplex: needles and plates with their like.
    EXPECT_LT(n_open, (n_overlap + n_disjoint) / 20) << name_of(set);
    EXPECT_GT(n_overlap, 1000) << name_of(set);
    EXPECT_GT(n_disjoint, 1000) << name_of(set);
  }
}

// A point of A - B is below its support planes: of directions about the point's own.
void expect_in_difference(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, const Vec3d& point,
                          std::mt19937_64& random) {
  for (int k = 0; k < 20; ++k) {
    const Vec3d near = norm(point) > 0.0 ? (1.0 / norm(point)) * point : Vec3d{};
    const Vec3d dir = near + (0.05 * k) * random_direction(random), unit = (1.0 / norm(dir)) * dir;
    if (!(norm(dir) > 0.0)) continue;
    const double height = dot(unit, a.support(unit) - pose(b.support(-pose.direction_to_b(unit))));
    ASSERT_LE(dot(unit, point), height + 1e-12 * (a.reach() + b.reach() + norm_1(pose.translation)));
  }
}

// Whether the ray from 0 along `dir` meets the triangle, or nearly so.
bool meets(const std::array<Vec3d, 3>& corners, const Vec3d& dir) {
  const auto weight = [&](std::size_t k) { return dot(cross(corners[(k + 1) % 3], corners[(k + 2) % 3]), dir); };
  const double side = dot(cross(corners[0], corners[1]), corners[2]) < 0.0 ? -1.0 : 1.0;
  const double w[] = {side * weight(0), side * weight(1), side * weight(2)};
  const double all = w[0] + w[1] + w[2];
  return all > 0.0 && std::min({w[0], w[1], w[2]}) > -0.01 * all;
}

// What a clearance claims is looked at by support points alone where bodies are apart, and by the depth's proven bound
// where they overlap; and it is worth something.
TEST(PacketOverlap, HasTheClearancesItClaims) {
  std::mt19937_64 random(12);
  for (const InstructionSet set : kernel_sets()) {
    const std::vector<ConvexBody> bodies = packet_bodies();
    long n_apart = 0, n_inside = 0, n_worth_apart = 0, n_worth_inside = 0, n_beyond = 0, n_met = 0;
    for (const ConvexBody& a : bodies) {
      for (const ConvexBody& b : bodies) {
        const std::unique_ptr<PacketOverlap> packets = make_packet_overlap(packet_kernel(set), a, b);
        Table table;
        for (int k = 0; k < 30; ++k) table.add(pose_at(a, b, 0.3 + 0.6 * random_in_unit_interval(random), random));
        std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{}, without{};
        const auto clearances = std::make_unique<PacketClearances>();
        packets->decide(table.table(), answers.data(), clearances.get());
        packets->decide(table.table(), without.data());
        const double size = a.reach() + b.reach();
        for (std::size_t k = 0; k < table.n; ++k) {
          ASSERT_EQ(answers[k], without[k]);
          if (answers[k] == PacketAnswer::open) continue;
          const Transformd pose = table.table().pose(k);
          const double clearance = clearances->length[k];
          ASSERT_GE(clearance, 0.0);
          if (answers[k] == PacketAnswer::overlap) {
            const double depth = -signed_distance(a, b, pose).lower;
            ASSERT_LE(clearance, depth * (1.0 + 1e-9) + 1e-13 * size);
            ++n_inside;
            n_worth_inside += clearance > 0.2 * depth ? 1 : 0;
            const Vec3d point{clearances->where[0][k], clearances->where[1][k], clearances->where[2][k]};
            expect_in_difference(a, b, pose, point, random);
            n_beyond += norm(point) > 0.2 * depth ? 1 : 0;
            std::array<Vec3d, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) {
              const auto& at = clearances->corners;
              corners[c] = {at[3 * c][k], at[3 * c + 1][k], at[3 * c + 2][k]};
              expect_in_difference(a, b, pose, corners[c], random);
            }
            n_met += meets(corners, pose(b.centre()) - a.centre()) ? 1 : 0;
            continue;
          }
          const Vec3d dir{clearances->where[0][k], clearances->where[1][k], clearances->where[2][k]};
          const Vec3d unit = (1.0 / norm(dir)) * dir;
          const double gap = dot(unit, pose(b.support(-pose.direction_to_b(unit))) - a.support(unit));
          ASSERT_LE(clearance, gap + 1e-13 * (size + norm_1(pose.translation)));
          ++n_apart;
          n_worth_apart += clearance > 0.2 * signed_distance(a, b, pose).upper ? 1 : 0;
        }
      }
    }
    EXPECT_GT(n_apart, 1000) << name_of(set);
    EXPECT_GT(n_inside, 1000) << name_of(set);
    EXPECT_GT(n_worth_apart, n_apart / 2) << name_of(set);
    EXPECT_GT(n_worth_inside, n_inside / 2) << name_of(set);
    EXPECT_GT(n_beyond, n_inside / 2) << name_of(set);
    EXPECT_GT(n_met, n_inside * 9 / 10) << name_of(set);
  }
}

TEST(PacketOverlap, NearContactAnswersOnlyWhatIsTrue) {
  // The share of the distance at which the pair touches, by halving with the proven verdict; then a little to either
  // side, down to where double precision cannot tell.
  std::mt19937_64 random(6);
  for (const InstructionSet set : kernel_sets()) {
    long n_answered = 0, n_open = 0;
    const std::vector<ConvexBody> bodies = packet_bodies();
    for (const ConvexBody& a : bodies) {
      for (const ConvexBody& b : bodies) {
        Transformd pose = random_rotation(random);
        const Vec3d dir = random_direction(random), from = a.centre() - pose(b.centre());
        const double radii = (a.circumradius() + b.circumradius()) / norm(dir);
        const auto at = [&](double share) {
          Transformd moved = pose;
          moved.translation = from + (share * radii) * dir;
          return moved;
        };
        double inside = 0.0, outside = 1.1;
        if (overlap(a, b, at(inside)).outcome != Outcome::overlap) continue;
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (inside + outside);
          (overlap(a, b, at(middle)).outcome == Outcome::overlap ? inside : outside) = middle;
        }
        Table table;
        for (int digits = 3; digits <= 17; ++digits) {
          for (const double side : {-1.0, 1.0}) table.add(at(inside + side * std::pow(10.0, -digits)));
        }
        std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
        make_packet_overlap(packet_kernel(set), a, b)->decide(table.table(), answers.data());
        for (std::size_t k = 0; k < table.n; ++k) {
          if (answers[k] == PacketAnswer::open) {
            ++n_open;
            continue;
          }
          ++n_answered;
          const Outcome truth = overlap(a, b, table.table().pose(k)).outcome;
          ASSERT_EQ(answers[k] == PacketAnswer::overlap ? Outcome::overlap : Outcome::disjoint, truth) << k;
        }
      }
    }
    EXPECT_GT(n_answered, 3000) << name_of(set) << ": polytopes to 1e-11, curved ones as far as a few points show it";
    EXPECT_GT(n_open, 500) << name_of(set) << ": the nearest cannot be proven in double precision";
  }
}

TEST(PacketOverlap, LeavesOpenWhatIsOutOfRange) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  for (const InstructionSet set : kernel_sets()) {
    const std::unique_ptr<PacketOverlap> packets = make_packet_overlap(packet_kernel(set), box, box);
    Table table;
    const double nan = std::nan("");
    for (const Vec3d& t : {Vec3d{1e19, 0, 0}, Vec3d{0, -1e300, 0}, Vec3d{0, 0, HUGE_VAL}, Vec3d{nan, 0, 0}}) {
      Transformd pose;
      pose.translation = t;
      table.add(pose);
    }
    table.add({});
    std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
    packets->decide(table.table(), answers.data());
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(answers[k], PacketAnswer::open) << k;
    EXPECT_EQ(answers[4], PacketAnswer::overlap);
    // Sizes whose sixth powers are out of reach.
    for (const char* text : {"box:1e-30,1,1", "box:1e-30,1e-30,1e-30", "box:1e30,1,1"}) {
      const ConvexBody body = parse_shape(text).body;
      EXPECT_EQ(make_packet_overlap(packet_kernel(set), body, body) != nullptr, std::string(text) == "box:1e-30,1,1")
          << text;
    }
  }
  EXPECT_EQ(make_packet_overlap(packet_kernel(InstructionSet::scalar), box, box), nullptr);
}

TEST(PacketOverlap, HasNoKernelForOtherCores) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  const ConvexBody nameless = Nameless(1.0, 2.0, 3.0);
  const PacketKernel kernel = packet_kernel(best_instruction_set());
  EXPECT_EQ(make_packet_overlap(kernel, nameless, box), nullptr);
  EXPECT_EQ(make_packet_overlap(kernel, box, nameless), nullptr);
}

// Whether packets answer must not hang on what was asked of the body before: runs would not be the same.
TEST(PacketOverlap, AnswersFromTheFirstCallOnAsTheTableIsMade) {
  for (const InstructionSet set : kernel_sets()) {
    const ConvexBody hull = test_point_hull(200, {3, 2, 1}, 1).body, box = parse_shape("box:1,1,1").body;
    const std::unique_ptr<PacketOverlap> packets = make_packet_overlap(packet_kernel(set), hull, box);
    ASSERT_NE(packets, nullptr);
    Table table;
    table.add({});
    std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
    packets->decide(table.table(), answers.data());
    EXPECT_EQ(answers[0], PacketAnswer::overlap);
  }
}

// Of n trials, by every set: what is answered is right, and all but one in a hundred are answered.
void expect_right_and_answered(const std::string& name, const ConvexBody& a, const ConvexBody& b, int n) {
  SCOPED_TRACE(name);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Transformd> poses;
  std::vector<Outcome> truths;
  for (int k = 0; k < n; ++k) {
    poses.push_back(pose_at(a, b, share(random), random));
    truths.push_back(overlap(a, b, poses.back()).outcome);
  }
  for (const InstructionSet set : kernel_sets()) {
    const std::unique_ptr<PacketOverlap> packets = make_packet_overlap(packet_kernel(set), a, b);
    ASSERT_NE(packets, nullptr);
    int n_open = 0, n_overlap = 0;
    for (std::size_t first = 0; first < poses.size(); first += PacketOverlap::kMostTrials) {
      Table table;
      for (std::size_t k = first; k < std::min(poses.size(), first + PacketOverlap::kMostTrials); ++k) {
        table.add(poses[k]);
      }
      std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
      packets->decide(table.table(), answers.data());
      for (std::size_t k = 0; k < table.n; ++k) {
        n_open += answers[k] == PacketAnswer::open ? 1 : 0;
        n_overlap += answers[k] == PacketAnswer::overlap ? 1 : 0;
        if (answers[k] == PacketAnswer::open) continue;
        ASSERT_EQ(answers[k] == PacketAnswer::overlap ? Outcome::overlap : Outcome::disjoint, truths[first + k]) << k;
      }
    }
    EXPECT_LE(n_open, n / 100) << name_of(set);
    EXPECT_GT(n_overlap, n / 50) << name_of(set);
    EXPECT_LT(n_overlap, n - n / 50) << name_of(set);
  }
}

TEST(PacketOverlap, TakesHullsByTheirTables) {
  const ConvexBody box = parse_shape("box:1,2,3").body, cone = parse_shape("cone:3,1").body;
  for (const int n : {33, 100, 1000, 10000}) {
    for (const Vec3d& stretch : {Vec3d{3, 2, 1}, Vec3d{100, 1, 1}}) {
      const ConvexBody hull = with_table(test_point_hull(n, stretch, 1).vertices);
      const std::string name = std::to_string(n) + " points, " + std::to_string(stretch.x);
      expect_right_and_answered(name, hull, hull, 2000);
      expect_right_and_answered(name + " and a box", hull, box, 500);
      expect_right_and_answered(name + " and a cone", cone, hull, 500);
    }
  }
  for (const int n : {3, 10, 30}) {
    const ConvexBody cube = with_table(points_on_cube(n));
    expect_right_and_answered("cube of " + std::to_string(n), cube, cube, 2000);
  }
}

TEST(PacketOverlap, TakesPieces) {
  const ConvexBody ellipsoid = parse_shape("ellipsoid:1,0.3,0.6").body;
  for (const char* text : {"cylinder:1,0.5", "cylinder:3,0.01", "cylinder:0.01,2", "cone:1,0.5", "cone:0.1,2",
                           "hemisphere:1", "frustum:1,0.3,0.6", "rounded:0.1,disc:1", "rounded:0.2,cone:1,1"}) {
    const ConvexBody body = parse_shape(text).body;
    expect_right_and_answered(text, body, body, 2000);
    expect_right_and_answered(std::string(text) + " and an ellipsoid", ellipsoid, body, 500);
  }
  const ConvexBody away = OffsetEllipsoid({5, -3, 2}, {1, 0.5, 0.2});
  expect_right_and_answered("away from the origin", away, away, 2000);
}

TEST(PacketOverlap, AlignedPosesAnswerOnlyWhatIsTrue) {
  // Quarter turns and shifts along axes: directions along a disc's axis, and normals of facets with many vertices.
  const std::array<Transformd, 3> turns = {Transformd{}, Transformd{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {}},
                                           Transformd{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}}};
  long n_answered = 0;
  const std::vector<ConvexBody> bodies = packet_bodies();
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      Table table;
      for (const Transformd& turn : turns) {
        for (const Vec3d& shift : {Vec3d{}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -0.5}, Vec3d{0, 1, 1e-9},
                                   Vec3d{0, 1e-170, 0.75}, Vec3d{2, 0, 1}}) {
          Transformd pose = turn;
          pose.translation = a.centre() - turn(b.centre()) + shift;
          table.add(pose);
        }
      }
      std::vector<Outcome> truths;
      for (std::size_t k = 0; k < table.n; ++k) truths.push_back(overlap(a, b, table.table().pose(k)).outcome);
      for (const InstructionSet set : kernel_sets()) {
        std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
        make_packet_overlap(packet_kernel(set), a, b)->decide(table.table(), answers.data());
        for (std::size_t k = 0; k < table.n; ++k) {
          if (answers[k] == PacketAnswer::open) continue;
          ++n_answered;
          ASSERT_EQ(answers[k] == PacketAnswer::overlap ? Outcome::overlap : Outcome::disjoint, truths[k]) << k;
        }
      }
    }
  }
  EXPECT_GT(n_answered, 3000);
}

// Pairs with a formula, their faces, edges and axes along each other but for a little: where cross products of edges
// are short, and what decides is near 0. Sizes that are unlike, flat and thin ones among them.
TEST(PacketOverlap, DecidesNearlyParallelBodies) {
  std::mt19937_64 random(19);
  for (const std::vector<const char*>& texts :
       {std::vector<const char*>{"box:1,1,1", "box:0.2,1,3", "box:1e-6,1,1", "plate:1,1.3", "needle:2"},
        std::vector<const char*>{"capsule:1,0.25", "capsule:10,0.01", "rounded:0.3,needle:2"},
        std::vector<const char*>{"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,2", "ellipsoid:1,1,1e-3", "ellipsoid:1,1,1"}}) {
    for (const char* text_a : texts) {
      for (const char* text_b : texts) {
        const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
        Table table;
        while (table.n < PacketOverlap::kMostTrials) {
          const double tilt = std::pow(10.0, -20.0 * random_in_unit_interval(random));
          const Vec3d about = tilt * random_direction(random);
          Transformd pose = rotation_from_quaternion(1.0, about.x, about.y, about.z);
          const double share = 0.5 * random_in_unit_interval(random);
          const int axis = static_cast<int>(random() % 3);
          Vec3d& t = pose.translation;
          (axis == 0 ? t.x : axis == 1 ? t.y : t.z) = share * (a.circumradius() + b.circumradius());
          if (random() % 2 == 0) t = t + (tilt * share) * random_direction(random);
          table.add(pose);
        }
        for (const InstructionSet set : kernel_sets()) {
          std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
          make_packet_overlap(packet_kernel(set), a, b)->decide(table.table(), answers.data());
          for (std::size_t k = 0; k < table.n; ++k) {
            if (answers[k] == PacketAnswer::open) continue;
            const Outcome truth = overlap(a, b, table.table().pose(k)).outcome;
            ASSERT_EQ(answers[k] == PacketAnswer::overlap ? Outcome::overlap : Outcome::disjoint, truth)
                << text_a << ' ' << text_b << ' ' << name_of(set) << ' ' << k;
          }
        }
      }
    }
  }
}

// Of one pose, by every set; the engine without packets has the right answer, maybe by another stage.
void expect_same_answer(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  for (const InstructionSet set : instruction_sets()) {
    EXPECT_EQ(gjk_backend(set).make(a, b)->decide(pose).outcome, overlap(a, b, pose).outcome) << name_of(set);
  }
}

TEST(GjkBackend, BelievesNoDirectionThatUnderflowHasLeft) {
  // Without a ball inside, the search starts at -t: here it is denormal, and so was the bound that a height had to
  // exceed.
  expect_same_answer(parse_shape("needle:2").body, parse_shape("plate:1,1.3").body,
                     {{0.66063496653125831, 0.37510486539280857, 0.65027515787925205},
                      {0.56342446273475333, 0.32468540388956157, -0.75969221615936466},
                      {-0.49609909875779623, 0.86826017325437377, 0.003155273678633436},
                      {0, 0, -5.434722104253712e-323}});
  // The square of an ellipsoid's image was: its point was off by tenths.
  const double shortest = 2.3866690339840662e-153, s = 0.03137 * shortest;
  Transformd pose;
  for (const double x : {0.5, 0.25, 0.0625}) {
    pose.translation = {x, 0.96e-9, s};
    expect_same_answer(Ellipsoid(1, 1e-9, shortest), Polytope(std::vector<Vec3d>{{-1, 0, -s}, {1, 0, s}}, {}, 0.0),
                       pose);
  }
}

TEST(PacketOverlap, LeavesOpenWhatIsNoRotation) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  for (const InstructionSet set : kernel_sets()) {
    Table table;
    for (const double wrong : {HUGE_VAL, -HUGE_VAL, std::nan(""), 9.0}) {
      for (int k = 0; k < 9; ++k) {
        Transformd pose;
        pose.translation = {3, 2, 1};
        Vec3d& row = k < 3 ? pose.row_x : k < 6 ? pose.row_y : pose.row_z;
        (k % 3 == 0 ? row.x : k % 3 == 1 ? row.y : row.z) = wrong;
        table.add(pose);
      }
    }
    std::array<PacketAnswer, PacketOverlap::kMostTrials> answers{};
    make_packet_overlap(packet_kernel(set), box, box)->decide(table.table(), answers.data());
    for (std::size_t k = 0; k < table.n; ++k) EXPECT_EQ(answers[k], PacketAnswer::open) << k;
  }
}

TEST(GjkBackend, AnswersTheSameWithEverySet) {
  std::mt19937_64 random(7);
  for (const char* text :
       {"box:1,2,0.5", "ellipsoid:1,2,3", "icosahedron:1", "cone:1,0.5", "cylinder:1,0.2", "capsule:1,0.2"}) {
    const ConvexBody a = parse_shape(text).body, b = parse_shape("box:1,1,1").body;
    std::vector<Pose> poses;
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int k = 0; k < 1000; ++k) poses.push_back(pose_at(a, b, share(random), random));
    poses[17] = Transformd{.translation = {1e30, 0, 0}};
    for (const InstructionSet set : instruction_sets()) {
      std::vector<Verdict> verdicts(poses.size());
      gjk_backend(set).make(a, b)->decide(poses, verdicts);
      for (std::size_t k = 0; k < poses.size(); ++k) ASSERT_EQ(verdicts[k], overlap(a, b, poses[k])) << text << k;
    }
  }
}

}  // namespace
}  // namespace vex
