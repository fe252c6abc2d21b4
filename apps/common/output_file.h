// A file that a program writes: checked before the work, written whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vex {

class OutputFile {
 public:
  /// `path`: "-" is standard output. Throws UsageError where the path is one of `inputs`, ends in a mesh extension,
  /// looks like an option, or names a folder or a write-protected file, or where its folder does not exist or cannot be
  /// written, so that no long run ends in vain.
  OutputFile(std::string path, std::span<const std::string> inputs);

  bool is_standard_output() const { return path_ == "-"; }

  /// Writes to a file beside it and renames that. Throws std::runtime_error where the disk refuses.
  void write(std::string_view text) const;

 private:
  std::string path_;
  std::filesystem::path target_;  // what the path stands for, through links: replaced, so that a link stays a link
};

}  // namespace vex
