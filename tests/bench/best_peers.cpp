#include "tests/bench/best_peers.h"

#include <utility>

namespace vex {

std::vector<BestPeer> best_peers() {
  std::vector<BestPeer> all;
#ifdef VEX_WITH_CCD
  for (BestPeer& peer : best_ccd_peers()) all.push_back(std::move(peer));
#endif
#ifdef VEX_WITH_FCL
  for (BestPeer& peer : best_fcl_peers()) all.push_back(std::move(peer));
#endif
  return all;
}

#ifndef VEX_WITH_FCL
std::string fcl_version() { return ""; }
#endif

}  // namespace vex
