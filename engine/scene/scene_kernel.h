// The parts of a scene's search that are compiled for several instruction sets: which bodies' circumscribed balls meet,
// where the one body is in the other's frame, and what bounds settle before a search.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/packets/quick_verdict.h"

namespace vex {

/// Poses of bodies as rows of four doubles, three a body: a row of R, then the coordinate of t.
inline constexpr std::size_t kRowsABody = 3, kNumbersABody = 4 * kRowsABody;

/// Pairs of bodies by their places in such a table, first in the lower half of a word, and the number of the shift that
/// the second is moved by.
struct NearPairs {
  static constexpr std::size_t kMost = 1024, kRoom = 2 * kMost + 64;

  std::uint64_t places[kRoom], shift[kRoom];
  std::size_t n = 0;
  std::uint64_t n_seen = 0;
};

/// Bodies that stand side by side in the columns, moved by a shift.
struct NearRange {
  std::uint64_t first, end;
  std::uint64_t shift;  // its number
  Vec3d by;
  bool is_own;  // the asking bodies' own cell: each looks only behind itself
};

/// The bodies first ... end - 1 against ranges. Centres and radii in columns, with room for a packet behind them.
struct NearQuery {
  const double *x, *y, *z, *radius;
  std::uint64_t first, end;
  const NearRange* ranges;
  std::size_t n_ranges;
  const Vec3d* extents;  // or null: as BallQuery's
};

/// Balls of bodies of one cell in columns of floats, about `origin` and in a unit of the grid. Their radii allow for
/// what rounding to floats does to them and to a ball that is asked about (E26); the x of an empty lane is NaN. For
/// BallQuery::extents the radii are what rounding alone adds.
struct alignas(64) BallBlock {
  static constexpr std::size_t kLanes = 8;

  float x[kLanes], y[kLanes], z[kLanes], radius[kLanes];
  std::uint32_t body[kLanes];
  double origin[4];  // the last one is 0
};

/// The block of this number moved by the shift of this number.
struct BallBlockAt {
  std::uint32_t block, shift;
};

/// One ball against blocks; `place` is the first of each pair.
struct BallQuery {
  const BallBlock* blocks;  // of all numbers
  const double* shifts;     // rows of four doubles, the last one 0; one a number
  const BallBlockAt* at;
  std::size_t n;
  std::uint64_t place;
  Vec3d centre;
  double units;          // a length of 1 is so many units
  float radius;          // in units, as the extents
  const float* extents;  // or null. What centres may be apart along each axis, but for the radii, in place of balls
};

/// Circumscribed cylinders about the bodies' centres, along a coordinate axis of each body's frame (E26).
struct CylinderPair {
  int axis_a = 0, axis_b = 0;
  double half_a = 0, radius_a = 0, half_b = 0, radius_b = 0;  // half lengths
  bool are_long = false;                                      // both are longer than thick
  bool is_flat_a = false, is_flat_b = false;

  bool says_anything() const { return are_long || is_flat_a || is_flat_b; }
};

/// Of pairs of one kind: a body of one shape, another of a second.
struct PlaceQuery {
  const double *poses, *shifts;  // rows of four doubles; of shifts one a number
  const std::uint64_t *a, *b, *shift;
  std::size_t n;  // at most PacketOverlap::kMostTrials
  Vec3d centre_a, centre_b;
  const CylinderPair* cylinders;  // or none
  const QuickVerdict* quick;      // or none
};

/// Of these pairs the ones left open, with their poses, and those proven to overlap.
struct PlacedPairs {
  static constexpr std::size_t kStride = PacketOverlap::kStride;

  alignas(64) double poses[kPoseColumns][kStride];
  std::uint64_t row[kStride], overlapping[kStride];  // numbers of pairs
  std::size_t n_open, n_overlapping;
  std::size_t n_after_cylinders;  // how many the cylinders left
};

struct SceneKernel {
  /// Appends the pairs whose balls, or boxes, may meet; so many must find room behind out.n: (end - first) times the
  /// ranges' sum.
  void (*find_near)(const NearQuery& query, NearPairs& out);
  /// Appends the pairs with bodies whose balls, or boxes, may meet it; 8 n must find room behind out.n.
  void (*find_in_blocks)(const BallQuery& query, NearPairs& out);
  void (*place)(const PlaceQuery& query, PlacedPairs& out);
};

/// There is one on every machine; of `scalar` too.
SceneKernel scene_kernel(InstructionSet set);

#define VEX_SCENE_KERNEL(name)                                 \
  namespace name {                                             \
  void find_near(const NearQuery& query, NearPairs& out);      \
  void find_in_blocks(const BallQuery& query, NearPairs& out); \
  void place_pairs(const PlaceQuery& query, PlacedPairs& out); \
  }
VEX_SCENE_KERNEL(baseline)
VEX_SCENE_KERNEL(sse2)
VEX_SCENE_KERNEL(avx2)
VEX_SCENE_KERNEL(avx512)
#undef VEX_SCENE_KERNEL

}  // namespace vex
