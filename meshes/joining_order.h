// In which order points join a growing hull, so that its time is near-linear.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// The points, each once. In rounds that double in size, each along a space-filling curve: a vertex is near the one
/// before it, and what each round meets was made by a random sample of all (Amenta, Choi, Rote, "Incremental
/// constructions con BRIO", 2003). It is the same for the same points and the same `which`: whoever knows that can lay
/// out points so that one of these orders takes long, or a few of them.
std::vector<std::uint32_t> joining_order(std::span<const Vec3d> points, std::uint64_t which = 0);

}  // namespace vex
