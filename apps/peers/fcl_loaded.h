// FCL as programs have it: not loaded before it is asked.
#pragma once

#include "engine/query/overlap_backend.h"

namespace vex {

/// `fcl_backend` of the module fcl, which the first question to it loads. Throws InputError then if that fails.
BackendKind loaded_fcl_backend();

}  // namespace vex
