// The kernels draw the library's poses bit for bit, what they prove is true, and what they leave open the library
// decides: so the hits are the library's, on this processor by the kernels as C++ and on a device of OpenCL, if there
// is one (pocl makes one of any processor).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/query/overlap.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"
#include "tests/opencl/device.h"
#include "tests/opencl/pair_of_bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

struct TwoBodies {
  const char *a, *b;
};
constexpr TwoBodies kPairs[] = {{"box:1,1,1", "box:1,1,1"},
                                {"box:0.2,1,3", "ellipsoid:1,2,3"},
                                {"ellipsoid:4,1,1", "ellipsoid:4,1,1"},
                                {"capsule:1,0.25", "capsule:1,0.25"},
                                {"plate:1,1", "rounded:0.2,plate:1,0.8"},
                                {"tetrahedron:1.3", "sphere:0.6"},
                                {"pyramid:6,0.6,1.1", "pyramid:6,0.6,1.1"},  // its centre is not the origin
                                {"sphere:0.4", "truncated-icosahedron:0.4"},
                                {"truncated-icosahedron:0.4", "truncated-icosahedron:0.4"},  // 60 vertices
                                {"icosahedron:1e-12", "box:1e-12,2e-12,3e-12"},
                                {"dodecahedron:3e14", "box:1e15,2e15,1e15"}};

std::string text_of(const TwoBodies& pair) { return std::string(pair.a) + " and " + pair.b; }

class OnDevice : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    device_ = std::string(GetParam()) == "opencl" ? opencl_device() : cpp_device(2);
    if (device_ == nullptr) GTEST_SKIP() << "no device of OpenCL has doubles here";
  }

  // Makes the pair the device's.
  void take(const TwoBodies& pair) {
    a_ = parse_shape(pair.a).body;
    b_ = parse_shape(pair.b).body;
    settings_.domain = best_domain(a_, b_);
    const std::optional<VexPair> of_kernels = pair_of_bodies(a_, b_, settings_.domain);
    ASSERT_TRUE(of_kernels) << text_of(pair);
    device_->set_pair(*of_kernels);
  }

  // What the device says of the poses is left open or what `overlap` says.
  void expect_no_wrong_answer(const std::vector<Transformd>& poses, int* n_answered) {
    const std::size_t n = poses.size();
    std::vector<double> columns(kPoseColumns * n);
    for (std::size_t k = 0; k < n; ++k) set_pose(columns.data(), n, k, poses[k]);
    const std::vector<int> answers = device_->answers(columns, static_cast<std::uint32_t>(n));
    for (std::size_t k = 0; k < n; ++k) {
      if (answers[k] == VEX_OPEN) continue;
      ++*n_answered;
      const Outcome outcome = overlap(a_, b_, Pose(poses[k])).outcome;
      if (outcome == Outcome::undecided) continue;
      EXPECT_EQ(answers[k], outcome == Outcome::overlap ? VEX_OVERLAP : VEX_DISJOINT) << k;
    }
  }

  std::unique_ptr<Device> device_;
  ConvexBody a_ = parse_shape("sphere:1").body, b_ = a_;
  MonteCarloSettings settings_;
};

TEST_P(OnDevice, PosesAreTheLibrarysBitForBit) {
  for (const TwoBodies& pair : kPairs) {
    take(pair);
    for (const Domain& domain : {ball_domain(a_, b_), box_domain(a_, b_)}) {
      device_->set_pair(*pair_of_bodies(a_, b_, domain));
      settings_.domain = domain;
      for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{0xfedcba9876543210u}}) {
        settings_.seed = seed;
        for (const std::uint64_t first : {std::uint64_t{0}, (std::uint64_t{7} << 32) - 500}) {
          constexpr std::uint32_t kPoses = 1000;
          const std::vector<double> columns = device_->poses(seed, first, kPoses);
          for (std::uint32_t k = 0; k < kPoses; ++k) {
            double expected[kPoseColumns];
            set_pose(expected, 1, 0, trial_pose(a_, b_, settings_, first + k));
            for (std::size_t c = 0; c < kPoseColumns; ++c)
              ASSERT_EQ(bits_of(columns[c * kPoses + k]), bits_of(expected[c])) << text_of(pair) << ", " << first + k;
          }
        }
      }
    }
  }
}

TEST_P(OnDevice, HitsAreTheLibrarys) {
  constexpr std::uint64_t kTrials = 60'000;
  for (const TwoBodies& pair : kPairs) {
    take(pair);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      settings_.seed = seed;
      settings_.stop.trials = kTrials;
      const Tally tally = run_monte_carlo(a_, b_, settings_).tally;
      const ProvenTrials found = device_->run(seed, 0, kTrials);
      std::uint64_t n_hits = found.n_hits, n_undecided = 0;
      for (const std::uint64_t trial : found.open) {
        const Outcome outcome = overlap(a_, b_, Pose(trial_pose(a_, b_, settings_, trial))).outcome;
        n_hits += outcome == Outcome::overlap ? 1u : 0u;
        n_undecided += outcome == Outcome::undecided ? 1u : 0u;
      }
      EXPECT_EQ(n_hits, tally.n_hits) << text_of(pair);
      EXPECT_EQ(n_undecided, tally.n_undecided) << text_of(pair);
      EXPECT_LT(found.open.size(), kTrials / 1000) << text_of(pair);
      EXPECT_EQ(found.n_hits + found.n_misses + found.open.size(), kTrials);
    }
  }
}

// Along a random line the last place at which the bodies meet, and places about it.
TEST_P(OnDevice, NoAnswerIsWrongAboutContact) {
  std::mt19937_64 random(5);
  for (const TwoBodies& pair : kPairs) {
    take(pair);
    const double reach = a_.reach() + b_.reach();
    std::vector<Transformd> poses;
    for (int line = 0; line < 12; ++line) {
      Transformd pose = random_rotation(random);
      if (line % 3 == 1) pose = Transformd{};
      if (line % 3 == 2) pose = {{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {}};
      const Vec3d dir = line % 4 == 3 ? Vec3d{1.0, 0.0, 0.0} : random_direction(random);
      const auto at = [&](double way) {
        Transformd moved = pose;
        moved.translation = (way / norm(dir)) * dir;
        return moved;
      };
      double meets = 0.0, is_apart = 1.01 * reach;
      for (double middle = 0.5 * is_apart; middle > meets && middle < is_apart; middle = 0.5 * (meets + is_apart))
        (overlap(a_, b_, Pose(at(middle))).outcome == Outcome::overlap ? meets : is_apart) = middle;
      for (int k = 2; k < 56; ++k) {
        for (const double sign : {-1.0, 1.0}) poses.push_back(at(meets + sign * std::ldexp(reach, -k)));
      }
      poses.push_back(at(meets));
      // R is taken as it is, also where it stretches.
      for (Vec3d* row : {&pose.row_x, &pose.row_y, &pose.row_z}) *row = (1.0 + 0x1p-22) * *row;
      for (int k = 2; k < 56; ++k) poses.push_back(at(meets + std::ldexp(reach, -k)));
    }
    int n_answered = 0;
    expect_no_wrong_answer(poses, &n_answered);
    EXPECT_GT(n_answered, static_cast<int>(poses.size()) / 2) << text_of(pair);
  }
}

TEST_P(OnDevice, WhatTouchesIsOpenOrRight) {
  take({"box:1,1,1", "box:1,1,1"});
  std::vector<Transformd> poses;
  for (const Vec3d& t : {Vec3d{1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{1, 1, 1}, Vec3d{1, 0.25, -0.5}, Vec3d{-1, 1, 0.125}}) {
    for (const double scale : {1.0, 1.0 + 0x1p-52, 1.0 - 0x1p-53, 1.0 + 0x1p-45, 1.0 - 0x1p-45}) {
      poses.push_back({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scale * t});
      poses.push_back({{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, scale * t});
    }
  }
  int n_answered = 0;
  expect_no_wrong_answer(poses, &n_answered);
  EXPECT_GT(n_answered, 0);
  EXPECT_LT(n_answered, static_cast<int>(poses.size()));
}

TEST_P(OnDevice, FarAndTinyPlacesAreOpenOrRightAndWhatIsNotFiniteIsOpen) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const TwoBodies& pair : kPairs) {
    take(pair);
    std::vector<Transformd> poses, none;
    for (const double far : {0.0, 5e-324, 1e-300, 1e-200, 1e-150, 1e-61, 1e-20, 1e20, 1e60, 1e150, 1e290}) {
      for (const Vec3d& dir : {Vec3d{1, 0, 0}, Vec3d{0, 1, 1}, Vec3d{-1, 1e-9, 0.3}})
        poses.push_back({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, far * dir});
    }
    int n_answered = 0;
    expect_no_wrong_answer(poses, &n_answered);
    EXPECT_GT(n_answered, 0);
    for (const double value : {kInfinity, -kInfinity, kNaN}) {
      none.push_back({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {value, 0, 0}});
      none.push_back({{1, 0, 0}, {0, value, 0}, {0, 0, 1}, {5, 0, 0}});
      none.push_back({{value, value, value}, {value, value, value}, {value, value, value}, {value, value, value}});
    }
    std::vector<double> columns(kPoseColumns * none.size());
    for (std::size_t k = 0; k < none.size(); ++k) set_pose(columns.data(), none.size(), k, none[k]);
    for (const int answer : device_->answers(columns, static_cast<std::uint32_t>(none.size())))
      EXPECT_EQ(answer, VEX_OPEN) << text_of(pair);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, OnDevice, testing::Values("cpp", "opencl"),
                         [](const auto& device) { return std::string(device.param); });

}  // namespace
}  // namespace vex
