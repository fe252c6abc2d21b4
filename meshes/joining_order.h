// In which order points join a growing hull, so that its time is near-linear.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// The points, each once. In rounds that double in size, each along a space-filling curve: a vertex is near the one
/// before it, and what each round meets was made by a random sample of all (Amenta, Choi, Rote, "Incremental
/// constructions con BRIO", 2003).
std::vector<std::uint32_t> joining_order(std::span<const Vec3d> points);

}  // namespace vex
