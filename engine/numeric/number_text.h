// Numbers in messages.
#pragma once

#include <string>

namespace vex {

/// The shortest text that reads back as the same double.
std::string shortest_number(double value);

}  // namespace vex
