// Named random streams: a trial's random numbers are a function of (seed, stream, trial index) and of nothing else.
//
// Philox4x32-10 (Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11), through Random123.
// No state, so nothing depends on which thread, rank or lane draws, or in what order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace vex {

/// Raised whenever a change makes the same (seed, trial) draw another pose.
inline constexpr int kStreamVersion = 2;

enum class Stream : std::uint32_t {
  pose = 0,
  scrambling = 1,           // of quasi-random points (sobol.h); index is that of the scrambling, block the coordinate
  pilot = 2,                // of choices that must not depend on what a run draws
  scene = 3,                // of the bodies of a random scene (apps/vex_scene); index is the body
  percolation = 4,          // of bodies placed one after another (placements.h)
  virial_trees = 5,         // of the trees that bodies of a cluster make (cluster_drawer.h); index is the cluster
  virial_orientations = 6,  // of bodies of clusters, where each is turned by a law (cluster_drawer.h)
};

/// A block of 128 bits: a function of (seed, stream, index, block).
using RandomWords = std::array<std::uint32_t, 4>;
RandomWords random_words(std::uint64_t seed, Stream stream, std::uint64_t index, std::uint32_t block);

/// Fills `coordinates` with the point of the open unit cube that belongs to (seed, stream, index).
///
/// Coordinate 2k and 2k+1 come from the four words of block k: the upper 52 of 64 bits, and a half, times 2^-52. So no
/// coordinate is 0 or 1, each is exact, and u and 1 - u are equally likely.
void draw_unit_cube(std::uint64_t seed, Stream stream, std::uint64_t index, std::span<double> coordinates);

}  // namespace vex
