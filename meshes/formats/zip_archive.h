// What a zip archive lists, and the beginning of a file of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vex {

struct ZipEntry {
  std::string name;
  std::size_t name_at = 0;  // where the list has the name, in the archive's bytes
  unsigned method = 0;      // 0: stored, 8: deflated
  std::uint64_t packed_size = 0, size = 0;
  std::uint64_t header_at = 0;
};

/// The files that the list at the end of `archive` names; nothing where there is no such list, or one that is damaged.
std::optional<std::vector<ZipEntry>> zip_entries(std::string_view archive);

/// The first `most` bytes of a file, or all of it; nothing where it is damaged, or packed by another method.
std::optional<std::string> zip_contents(std::string_view archive, const ZipEntry& entry, std::size_t most);

}  // namespace vex
