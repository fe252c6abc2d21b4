// Overlap of many poses of one pair by packets: the filter, a register full of trials at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "engine/numeric/instruction_set.h"
#include "engine/numeric/transform.h"
#include "engine/query/packets/core_form.h"
#include "engine/query/packets/pair_formula.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Poses that stand in columns, kPoseColumns of `stride` values each: R by rows, then t. After the n of them there is
/// room for a packet.
inline constexpr std::size_t kPoseColumns = 12;
struct PoseTable {
  const double* columns;
  std::size_t stride, n;

  Transformd pose(std::size_t k) const {
    const auto at = [&](std::size_t column) { return columns[column * stride + k]; };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}, {at(9), at(10), at(11)}};
  }
};

/// PoseTable::pose(row) is this pose then.
inline void set_pose(double* columns, std::size_t stride, std::size_t row, const Transformd& pose) {
  double* at = columns + row;
  for (const Vec3d* part : {&pose.row_x, &pose.row_y, &pose.row_z, &pose.translation}) {
    for (const double value : {part->x, part->y, part->z}) {
      *at = value;
      at += stride;
    }
  }
}

/// A packet's answer to a trial.
enum class PacketAnswer : std::uint8_t { open, disjoint, overlap };

/// |t|_1 in units of `own_reach`, up to which one bound of errors serves all poses of a pair: what is farther is apart.
inline constexpr double kFarthestPacket = 1.75;

/// Where the reach is beyond these a pose is left open: sixth powers of lengths, and their products with each other's,
/// stay far from both ends (E18).
inline constexpr double kLeastPacketReach = 0x1p-60, kLargestPacketReach = 0x1p60;

/// What a kernel needs of a pair; the forms must outlive it.
struct PacketPairForms {
  const CoreForm *a, *b;
  Vec3d centre_a, centre_b, start_offset;
  double ball_radius;
  double own_reach, own_error;  // E1's W and E but for what the translation adds
  double start_clearance;       // A - B has a ball of this radius about the search's first point, whatever the pose
  PairFormula formula;
};

struct PacketClearances;

/// One instance serves one thread.
class PacketOverlap {
 public:
  static constexpr std::size_t kMostTrials = 256;
  static constexpr std::size_t kStride = kMostTrials + 16;  // of a table of so many

  virtual ~PacketOverlap();  // not inline: kernels would each have it
  /// Of up to kMostTrials poses. What is answered disjoint or overlap is proven (E1, E18, E33), and so are the
  /// clearances, where they are asked for: formulas tell none, so that a pose at contact may be left open then.
  virtual void decide(const PoseTable& poses, PacketAnswer* answers, PacketClearances* clearances = nullptr) = 0;
};

/// How far the bodies may move before each answer can end, in A's frame; of open trials nothing (E18).
struct PacketClearances {
  /// Where `length` is above 0: of disjoint bodies a direction from A towards B, of any length, along which their
  /// supports are at least `length` apart; of overlapping ones a point of A - B, from about the difference of their
  /// centres beyond the origin.
  double where[3][PacketOverlap::kStride];
  /// Of overlapping ones: three more points of A - B, by coordinates; the line from about the difference of their
  /// centres through the origin meets the triangle between them.
  double corners[9][PacketOverlap::kStride];
  /// Of overlapping bodies A - B has a ball of this radius about the origin. Not below 0.
  double length[PacketOverlap::kStride];
};

/// The caller owns what it makes.
using PacketKernel = PacketOverlap* (*)(const PacketPairForms& forms);

/// Null where there is none: of `scalar`.
PacketKernel packet_kernel(InstructionSet set);

/// None without a kernel, or for a pair that it does not take: cores of another form, or lengths whose products could
/// over- or underflow.
std::unique_ptr<PacketOverlap> make_packet_overlap(PacketKernel kernel, const ConvexBody& a, const ConvexBody& b);

// Each is compiled for its own set (packet_kernel.cpp).
namespace sse2 {
PacketOverlap* new_packet_overlap(const PacketPairForms& forms);
}
namespace avx2 {
PacketOverlap* new_packet_overlap(const PacketPairForms& forms);
}
namespace avx512 {
PacketOverlap* new_packet_overlap(const PacketPairForms& forms);
}

}  // namespace vex
