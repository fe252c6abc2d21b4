// Archives for the tests' files.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vex::tests {

/// A 3MF archive: `model` is its XML, `more` are further files of it.
std::string threemf_of(const std::string& model, const std::vector<std::pair<std::string, std::string>>& more = {},
                       bool deflated = true);

}  // namespace vex::tests
