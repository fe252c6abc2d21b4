// A file that a program writes: checked before the work, written whole or not at all.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vex {

/// Which file a path leads to, through symbolic links, whatever its name: hard links of one file are one file. A file
/// that is not there yet is a name in a folder.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;   // of the file; of its folder where it does not exist
  std::string name;  // empty where it exists
  mode_t mode = 0;   // 0 where it does not exist

  bool operator==(const FileIdentity& other) const {
    return device == other.device && inode == other.inode && name == other.name;
  }
  bool is_regular() const;
  /// A terminal, /dev/null: several may write there.
  bool is_character_device() const;
};

/// Of a path, "-" being the standard stream of this number. Nothing where neither the file nor its folder exists.
std::optional<FileIdentity> identity_of(const std::string& path, int stream);

class OutputFile {
 public:
  /// `path`: "-" is standard output. `inputs`: the paths of files that the program reads, "-" being standard input.
  /// Throws UsageError where the path leads to one of `inputs`, or to the file behind standard input; where it ends in
  /// a mesh extension, looks like an option, or names a folder or a write-protected file, or where its folder does not
  /// exist or cannot be written, so that no long run ends in vain. Standard output is not looked at: command_files.h.
  /// `mesh_extension`: the one that it may have, ".glb", because a mesh is what it is to hold.
  OutputFile(std::string path, std::span<const std::string> inputs, std::string_view mesh_extension = {});

  bool is_standard_output() const { return path_ == "-"; }
  const std::string& path() const { return path_; }
  /// What it stands for, through links.
  const std::filesystem::path& target() const { return target_; }
  /// Before it is written.
  const std::optional<FileIdentity>& identity() const { return identity_; }

  /// Standard output, a device or a pipe: writing may wait for whoever reads.
  bool may_wait_for_a_reader() const;

  /// Replaces the file as `replace_file` does; into a device or a pipe it is written (patient_write.h): false where an
  /// interrupt came before all of it was. Throws std::runtime_error where the disk refuses. Not of standard output,
  /// which Results writes (results.h).
  bool write(std::string_view text) const;

 private:
  std::string path_;
  std::filesystem::path target_;  // which is replaced, so that a link stays a link
  std::optional<FileIdentity> identity_;
};

/// The input that is this file; nothing where none is. Only regular files count: what goes into another end of a pipe
/// or a terminal destroys nothing.
std::optional<std::string> input_that_is(const FileIdentity& output, std::span<const std::string> inputs);

}  // namespace vex
