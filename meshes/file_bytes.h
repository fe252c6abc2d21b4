// The bytes of a file, all of them: of one that stood still while it was read.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "meshes/open_file.h"

namespace vex {

/// Bytes in memory, which grow without being written twice.
class FileBytes {
 public:
  FileBytes() = default;
  FileBytes(FileBytes&& other) noexcept : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)) {}
  FileBytes& operator=(FileBytes&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  std::string_view view() const { return {data_.get(), size_}; }
  char* data() { return data_.get(); }
  std::size_t size() const { return size_; }
  /// Bytes beyond the former size are not set. Throws std::bad_alloc.
  void resize(std::size_t size);

 private:
  struct Free {
    void operator()(char* data) const { std::free(data); }
  };
  std::unique_ptr<char, Free> data_;
  std::size_t size_ = 0;
};

/// What tells that a file was written between two looks at it.
struct FileStamp {
  ::dev_t device = 0;
  ::ino_t number = 0;
  std::int64_t size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  // of its last change

  bool operator==(const FileStamp&) const = default;
};
/// Nothing where no file is open.
std::optional<FileStamp> file_stamp(const OpenFile& file);

/// Of files, standard input and what is unpacked from them: more than this, half of the memory, is refused.
std::uint64_t most_file_bytes();

/// The size in bytes of `path`, a regular file that can be opened and is not empty. Throws InputError otherwise; never
/// waits, whatever is there (a pipe, a device).
std::uintmax_t checked_file_size(const std::filesystem::path& path);

/// The whole of such a file. Throws InputError, also where the file's size or time changes meanwhile, and where more
/// than a megabyte and half of it were never written (holes).
FileBytes read_file_bytes(const std::filesystem::path& path);
/// Of one that is open; `path` is what messages call it.
FileBytes read_file_bytes(const OpenFile& file, const std::filesystem::path& path);

/// Standard input to its end, whatever it is connected to. Throws InputError where there is nothing.
FileBytes read_standard_input();

}  // namespace vex
