// The bodies of this folder, as the program that wrote them makes them (README.md says how).
#pragma once

#include <map>
#include <string>

namespace vex {

/// File name -> contents, byte for byte.
std::map<std::string, std::string> sample_body_files();

}  // namespace vex
