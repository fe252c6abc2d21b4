// Which broad phase is less work, told from a sample of the bodies (internal).
#pragma once

#include "engine/scene/scene.h"
#include "engine/scene/scene_bodies.h"

namespace vex {

/// Counts, of some bodies, the others that a grid and a tree would look at, and weighs them with what each costs. It
/// depends on the bodies alone, never on the clock.
BroadPhase cheaper_broad_phase(const SceneBodies& bodies, double reach, double margin);

}  // namespace vex
