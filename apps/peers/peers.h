// The peer libraries that this build has (VEX_WITH_CCD, VEX_WITH_FCL).
#pragma once

#include <string_view>
#include <vector>

#include "engine/query/overlap_backend.h"

namespace vex {

/// One of the names that users may type, built or left out.
struct PeerName {
  std::string_view name;
  std::string_view build_option;  // what it is left out by
};
inline constexpr PeerName kPeerNames[] = {
    {"ccd-gjk", "VEX_WITH_CCD"}, {"ccd-mpr", "VEX_WITH_CCD"}, {"fcl", "VEX_WITH_FCL"}};

/// Those of this build, in the order of `kPeerNames`.
std::vector<BackendKind> peer_backends();

/// The engine's own, and after it those.
std::vector<BackendKind> all_backends();

}  // namespace vex
