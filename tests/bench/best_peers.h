// The peers as their own examples and documentation would have them, rather than behind the engine's support mappings:
// what apps/peers asks of them costs them calls through the engine, and tolerances that they do not come with.
#pragma once

#include <string>
#include <vector>

#include "engine/query/overlap_backend.h"

namespace vex {

/// A backend that is shown its poses first, outside of what is timed, and keeps them in its library's own form.
class PreparedBackend : public OverlapBackend {
 public:
  /// `decide` takes parts of this span, by address.
  virtual void prepare(std::span<const Pose> a_from_b) = 0;
};

struct BestPeer {
  BackendKind kind;
  std::string setting;  // in words
};

/// libccd on bodies of its user's own: boxes, ellipsoids, capsules and hulls as plain structures, their support
/// mappings as plain functions. `ccd_scan_mpr` scans a hull's vertices whatever their number.
std::vector<BestPeer> best_ccd_peers();
BestPeer ccd_scan_mpr();

/// FCL on its own shapes, its transforms made before; of two bodies of the same kind.
std::vector<BestPeer> best_fcl_peers();

/// Those of this build.
std::vector<BestPeer> best_peers();

/// Empty where the build has none.
std::string fcl_version();

}  // namespace vex
