// A file that one process alone writes, again and again, for as long as it lives.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "apps/common/descriptor.h"
#include "apps/common/output_file.h"
#include "apps/common/replace_file.h"

namespace vex {

/// Holds a lock (flock) on the file, which whoever asks for it in the same way respects; it goes with the process,
/// however that ends. The file is there from the beginning, empty perhaps; each replacement is locked before it takes
/// the name.
class LockedFile {
 public:
  /// Makes the file where there is none, and removes what earlier processes left beside it (remove_leftovers). Throws
  /// UsageError where another process holds it, or where it cannot be opened; `option` is the one that names it.
  LockedFile(const OutputFile& file, const std::string& option);
  /// Removes the file where it made it, and nothing was written.
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  /// Whether nothing stood in it.
  bool was_empty() const { return was_empty_; }
  /// Whether this file system has locks. Without one nothing keeps another process away.
  bool has_lock() const { return has_lock_; }

  /// As `replace_file`. Throws std::system_error, EBUSY where the file is another one by now.
  void replace(std::string_view text);

 private:
  void open_and_lock(const std::string& option);
  FileNumber number() const;

  std::string path_;  // as it was named
  std::filesystem::path target_;
  Descriptor file_{-1};
  bool has_lock_ = true, was_made_ = false, was_empty_ = true, was_written_ = false;
};

}  // namespace vex
