// Bytes in other bytes, as mesh files have them: gzip, zip, base64.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vex {

/// One member of a gzip file.
std::string gzipped(const std::string& bytes);

/// A zip archive of (name, contents), deflated or as they are: what a .3mf file is packed in.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& files, bool deflated = false);

std::string base64(const std::string& bytes);

}  // namespace vex
