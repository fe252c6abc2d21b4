// Who answers how far apart or how deep in each other two bodies are, on stored poses: the engine, libccd, FCL.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/query/separation.h"

namespace vex {

enum class SeparationGoal { distance, depth };

/// Poses of a body with itself, all apart or all in each other, and the engine's proven bounds of each.
struct SeparationPoses {
  SeparationGoal goal;
  ConvexBody body;
  std::vector<Pose> poses;  // made before, as FCL has its own
  std::vector<Separation> proven;
  double size() const { return 2.0 * body.circumradius(); }
};

/// The signed distance of the k-th pose; not a number where the library gives up, throws, or finds the bodies on the
/// other side of contact.
using SeparationAnswer = std::function<double(std::size_t k)>;

struct SeparationContender {
  std::string name, setting;
  bool walks = false;  // asked of poses one after another along a motion
  /// None where it has no such query for such a body. The poses outlive the answer.
  std::function<SeparationAnswer(const SeparationPoses& poses)> make;
};

/// The engine at full precision, to a thousandth, and along a motion cold and from warm starts.
std::vector<SeparationContender> engine_separations();
inline constexpr const char* kEngine = "vex";
inline constexpr const char* kEngineInMotion = "vex in motion";

/// libccd's expanding polytope and portal refinement, depth alone, on the engine's support mappings.
std::vector<SeparationContender> ccd_separations();

/// FCL's distance, and the depth of its collide's contact, on its own shapes.
std::vector<SeparationContender> fcl_separations();

/// Those of this build, the engine's first.
std::vector<SeparationContender> separation_contenders();

/// The poses of trials in the ball domain that are apart, or overlap: the first n of them.
SeparationPoses independent_poses(SeparationGoal goal, const ConvexBody& body, std::uint64_t seed, std::size_t n);

/// The same, as walks of 32 poses: each moves B by a thousandth of the size and turns it by a thousandth of a turn.
SeparationPoses poses_in_motion(SeparationGoal goal, const ConvexBody& body, std::uint64_t seed, std::size_t n);

}  // namespace vex
