#include "engine/numeric/instruction_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "engine/query/packets/packet_overlap.h"
#include "engine/sampling/poses/pose_columns.h"

namespace vex {
namespace {

constexpr InstructionSet kEvery[] = {InstructionSet::scalar, InstructionSet::sse2, InstructionSet::avx2,
                                     InstructionSet::avx512};

TEST(InstructionSet, ThisMachinesComeInOrderAndScalarFirst) {
  const std::vector<InstructionSet> sets(instruction_sets().begin(), instruction_sets().end());
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::scalar);
  EXPECT_EQ(sets.back(), best_instruction_set());
  EXPECT_TRUE(std::is_sorted(sets.begin(), sets.end()));
  EXPECT_EQ(std::adjacent_find(sets.begin(), sets.end()), sets.end());
}

TEST(InstructionSet, HasItsOwnName) {
  std::set<std::string_view> names;
  for (const InstructionSet set : kEvery) EXPECT_TRUE(names.insert(name_of(set)).second) << name_of(set);
}

TEST(InstructionSet, HasBothKernelsOfItsOwnOrNone) {
  std::set<PacketKernel> packets;
  std::set<DrawPoses> poses;
  for (const InstructionSet set : kEvery) {
    const PacketKernel packet = packet_kernel(set);
    const DrawPoses draw = pose_kernel(set);
    EXPECT_EQ(packet == nullptr, draw == nullptr) << name_of(set);
    if (packet == nullptr) continue;
    EXPECT_TRUE(packets.insert(packet).second) << name_of(set);
    EXPECT_TRUE(poses.insert(draw).second) << name_of(set);
  }
  EXPECT_EQ(packet_kernel(InstructionSet::scalar), nullptr);
  for (const InstructionSet set : instruction_sets()) {
    EXPECT_EQ(packet_kernel(set) == nullptr, set == InstructionSet::scalar) << name_of(set);
  }
}

}  // namespace
}  // namespace vex
