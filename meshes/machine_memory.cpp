#include "meshes/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace vex {
namespace {

/// Where the control groups of this process, and those around them, state how much memory they may take: of version 2,
/// and of version 1. A batch job or a service has a group of its own within the machine's.
std::vector<std::string> files_of_limits() {
  std::vector<std::string> files{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // hierarchy:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool is_second_version = controllers.empty();
    if (!is_second_version && controllers != "memory") continue;
    for (std::string path = line.substr(second + 1); path.size() > 1; path.resize(path.rfind('/'))) {
      files.push_back(is_second_version ? "/sys/fs/cgroup" + path + "/memory.max"
                                        : "/sys/fs/cgroup/memory" + path + "/memory.limit_in_bytes");
      if (path.find('/') == std::string::npos) break;
    }
  }
  return files;
}

}  // namespace

std::uint64_t machine_memory() {
  const auto pages = static_cast<std::uint64_t>(std::max(1L, ::sysconf(_SC_PHYS_PAGES)));
  const auto page_size = static_cast<std::uint64_t>(std::max(1L, ::sysconf(_SC_PAGESIZE)));
  std::uint64_t bytes = pages * page_size;
  for (const std::string& path : files_of_limits()) {
    std::ifstream file(path);
    std::uint64_t limit = 0;
    if (file >> limit && limit > 0) {  // "max", where there is no limit, is not a number
      bytes = std::min(bytes, limit);
    }
  }
  return bytes;
}

std::uint64_t own_address_space() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(std::max(1L, ::sysconf(_SC_PAGESIZE)));
}

}  // namespace vex
