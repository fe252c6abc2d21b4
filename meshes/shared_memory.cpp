#include "meshes/shared_memory.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string>

namespace vex {
namespace {

/// A line that a mapping begins with, of either list: "begin-end rwxs offset device inode name".
bool is_shared(const std::string& line, SharedMapping* mapping) {
  unsigned long long begin = 0, end = 0;
  char rights[5] = {};
  if (std::sscanf(line.c_str(), "%llx-%llx %4[rwxsp-]", &begin, &end, rights) != 3) return false;
  *mapping = {begin, end};
  return rights[3] == 's';
}

}  // namespace

int shared_mappings(std::vector<SharedMapping>* found) {
  found->clear();
  errno = 0;
  std::ifstream maps("/proc/self/maps");
  SharedMapping mapping{};
  std::string line;
  bool has_any_line = false;
  while (std::getline(maps, line)) {
    has_any_line = true;
    if (is_shared(line, &mapping)) found->push_back(mapping);
  }
  if (!has_any_line) return errno != 0 ? errno : ENOENT;
  if (found->empty()) return 0;
  // A file that was opened for reading alone, as the system's tables of characters, can be changed by nobody: its
  // mapping lacks the flag "mw", may write. The longer list takes longer, and mostly there is no need of it.
  std::ifstream with_flags("/proc/self/smaps");
  std::vector<SharedMapping> writable;
  bool is_in_shared = false, has_flags = false;
  while (std::getline(with_flags, line)) {
    SharedMapping next{};
    if (line.starts_with("VmFlags:")) {
      has_flags = true;
      if (is_in_shared && (line + " ").find(" mw ") != std::string::npos) writable.push_back(mapping);
      is_in_shared = false;
    } else if (is_shared(line, &next)) {
      mapping = next;
      is_in_shared = true;
    }
  }
  if (has_flags) *found = std::move(writable);
  return 0;
}

int give_up_shared_memory() {
  std::vector<SharedMapping> mappings;
  int error = shared_mappings(&mappings);
  for (const SharedMapping& mapping : mappings) {
    // Not munmap(): libraries of message passing hook it, and look into what is unmapped here.
    if (::syscall(SYS_munmap, mapping.begin, mapping.end - mapping.begin) != 0 && error == 0) error = errno;
  }
  return error;
}

}  // namespace vex
