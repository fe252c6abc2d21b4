// What a run will need, said before it begins.
#pragma once

#include <string>

#include "apps/vex_mesh/options.h"

namespace vex {

/// In a line; empty where the run is over in a moment.
std::string announcement(const Outlook& outlook, const Options& options);

}  // namespace vex
