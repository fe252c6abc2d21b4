// The module fcl.
#include "apps/peers/fcl_backend.h"

extern "C" void vex_fcl_backend(vex::BackendKind* kind) { *kind = vex::fcl_backend(); }
