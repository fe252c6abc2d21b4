#include "meshes/formats/soup_faces.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "meshes/machine_memory.h"
#include "tests/unit/meshes/refusal.h"

namespace vex::tests {
namespace {

constexpr std::uint64_t kMemory = 1024 * kMiB;

/// How many of what `require` is told of are let into the memory.
std::uint64_t most_of(const auto& require) {
  std::uint64_t n = 0;
  try {
    for (;; n += 1000) require(n);
  } catch (const InputError&) {
  }
  return n;
}

TEST(SoupRoom, LetsPointsInUntilTheyAndTheFileFillThreeQuartersOfTheMemory) {
  SoupRoom room(256 * kMiB, "a.xyz", 0, 0, kMemory);
  const std::uint64_t n = most_of([&](std::uint64_t n_points) { room.require(n_points, 0); });
  EXPECT_LE(256 * kMiB + 2 * 24 * n, 768 * kMiB);
  EXPECT_GE(256 * kMiB + 3 * 24 * n, 768 * kMiB);  // and does not refuse long before
}

TEST(SoupRoom, CountsCornersAndWhatIsKeptBeside) {
  SoupRoom corners(0, "a.obj", 0, 0, kMemory), with_numbers(0, "a.msh", 16, 8, kMemory);
  const std::uint64_t n = most_of([&](std::uint64_t n_corners) { corners.require(0, n_corners); });
  const std::uint64_t n_numbered = most_of([&](std::uint64_t n_corners) { with_numbers.require(0, n_corners); });
  EXPECT_LE(2 * 8 * n, 768 * kMiB);
  EXPECT_LE(2 * 16 * n_numbered, 768 * kMiB);
  EXPECT_LT(n_numbered, n);
}

TEST(SoupRoom, SaysWhoseFileItIsAndWhatToDo) {
  SoupRoom room(10 * kMiB, "a.off", 0, 0, 16 * kMiB);
  const std::string message = refusal_of([&] { room.require(1'000'000, 3); });
  EXPECT_TRUE(contains(message, "too large for this machine (a.off: 1000000 vertices and 3 corners"));
  EXPECT_TRUE(contains(message, "with 16 MiB of memory) - simplify it"));
}

TEST(SoupRoom, HasNoMoreThan32BitsCanName) {
  SoupRoom room(0, "a.ply", 0, 0, std::uint64_t{1} << 50U);
  room.require(kMostSoupPoints, kMostSoupPoints);
  EXPECT_TRUE(contains(refusal_of([&] { room.require(2 * kMostSoupPoints, 0); }), "more than 2^30"));
}

}  // namespace
}  // namespace vex::tests
