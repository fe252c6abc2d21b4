// Archives for the tests' files.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vex::tests {

/// A zip archive of (name, contents), deflated or as they are.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, bool deflated = true);

/// One member of a gzip file.
std::string gzip_of(const std::string& bytes);

/// A 3MF archive: `model` is its XML, `more` are further files of it.
std::string threemf_of(const std::string& model, const std::vector<std::pair<std::string, std::string>>& more = {},
                       bool deflated = true);

}  // namespace vex::tests
