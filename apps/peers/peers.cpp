#include "apps/peers/peers.h"

#include <utility>

#ifdef VEX_WITH_CCD
#include "apps/peers/ccd_backend.h"
#endif
#ifdef VEX_WITH_FCL
#include "apps/peers/fcl_loaded.h"
#endif

namespace vex {

std::vector<BackendKind> peer_backends() {
  return {
#ifdef VEX_WITH_CCD
      ccd_gjk_backend(),
      ccd_mpr_backend(),
#endif
#ifdef VEX_WITH_FCL
      loaded_fcl_backend(),
#endif
  };
}

std::vector<BackendKind> all_backends() {
  std::vector<BackendKind> kinds;
  kinds.push_back(gjk_backend());
  for (BackendKind& kind : peer_backends()) kinds.push_back(std::move(kind));
  return kinds;
}

}  // namespace vex
