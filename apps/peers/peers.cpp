#include "apps/peers/peers.h"

#ifdef VEX_WITH_CCD
#include "apps/peers/ccd_backend.h"
#endif
#ifdef VEX_WITH_FCL
#include "apps/peers/fcl_backend.h"
#endif

namespace vex {

std::vector<BackendKind> peer_backends() {
  return {
#ifdef VEX_WITH_CCD
      ccd_gjk_backend(),
      ccd_mpr_backend(),
#endif
#ifdef VEX_WITH_FCL
      fcl_backend(),
#endif
  };
}

}  // namespace vex
