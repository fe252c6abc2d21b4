#include "meshes/formats/zip_archive.h"

#include <zlib.h>

#include <algorithm>

namespace vex {
namespace {

/// A little-endian number of `n_bytes` at `at`; the caller has seen that it lies within.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t n_bytes) {
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < n_bytes; ++k) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  }
  return value;
}

constexpr std::uint64_t kIn64Bits = 0xFFFFFFFF;  // stands for a number that the extra field has

/// Puts in the numbers that the 64-bit extra field has in place of kIn64Bits.
bool read_extra(std::string_view extra, ZipEntry* entry) {
  while (extra.size() >= 4) {
    const std::size_t size = number_at(extra, 2, 2);
    if (extra.size() - 4 < size) return false;
    if (number_at(extra, 0, 2) == 1) {
      std::size_t at = 4;
      for (std::uint64_t* field : {&entry->size, &entry->packed_size, &entry->header_at}) {
        if (*field != kIn64Bits) continue;
        if (at + 8 > 4 + size) return false;
        *field = number_at(extra, at, 8);
        at += 8;
      }
      return true;
    }
    extra.remove_prefix(4 + size);
  }
  return true;
}

struct Directory {
  std::uint64_t at = 0, n_entries = 0;
};

std::optional<Directory> find_directory(std::string_view archive) {
  constexpr std::size_t kEndSize = 22, kLongestComment = 0xFFFF;
  if (archive.size() < kEndSize) return std::nullopt;
  const std::size_t last = archive.size() - kEndSize;
  const std::size_t end = archive.rfind("PK\x05\x06", last);
  if (end == std::string_view::npos || last - end > kLongestComment) return std::nullopt;
  Directory directory{number_at(archive, end + 16, 4), number_at(archive, end + 10, 2)};
  if (directory.at == kIn64Bits || directory.n_entries == 0xFFFF) {
    constexpr std::size_t kLocatorSize = 20, kEnd64Size = 56;
    if (end < kLocatorSize || archive.substr(end - kLocatorSize, 4) != "PK\x06\x07") return std::nullopt;
    const std::uint64_t end64 = number_at(archive, end - kLocatorSize + 8, 8);
    if (end64 > archive.size() || archive.size() - end64 < kEnd64Size) return std::nullopt;
    if (archive.substr(end64, 4) != "PK\x06\x06") return std::nullopt;
    directory = {number_at(archive, end64 + 48, 8), number_at(archive, end64 + 32, 8)};
  }
  return directory;
}

}  // namespace

std::optional<std::vector<ZipEntry>> zip_entries(std::string_view archive) {
  constexpr std::size_t kFixedSize = 46;
  const std::optional<Directory> directory = find_directory(archive);
  if (!directory) return std::nullopt;
  std::vector<ZipEntry> entries;
  std::uint64_t at = directory->at;
  for (std::uint64_t i = 0; i < directory->n_entries; ++i) {
    if (at > archive.size() || archive.size() - at < kFixedSize || archive.substr(at, 4) != "PK\x01\x02") {
      return std::nullopt;
    }
    const std::size_t n_name = number_at(archive, at + 28, 2), n_extra = number_at(archive, at + 30, 2);
    if (archive.size() - at - kFixedSize < n_name + n_extra) return std::nullopt;
    ZipEntry entry{std::string(archive.substr(at + kFixedSize, n_name)),
                   at + kFixedSize,
                   static_cast<unsigned>(number_at(archive, at + 10, 2)),
                   number_at(archive, at + 20, 4),
                   number_at(archive, at + 24, 4),
                   number_at(archive, at + 42, 4)};
    if (!read_extra(archive.substr(at + kFixedSize + n_name, n_extra), &entry)) return std::nullopt;
    entries.push_back(std::move(entry));
    at += kFixedSize + n_name + n_extra + number_at(archive, at + 32, 2);
  }
  return entries;
}

std::optional<std::string> zip_contents(std::string_view archive, const ZipEntry& entry, std::size_t most) {
  constexpr std::size_t kFixedSize = 30;
  if (entry.header_at > archive.size() || archive.size() - entry.header_at < kFixedSize) return std::nullopt;
  std::string_view rest = archive.substr(entry.header_at);
  if (!rest.starts_with("PK\x03\x04")) return std::nullopt;
  const std::size_t n_before = kFixedSize + number_at(rest, 26, 2) + number_at(rest, 28, 2);
  if (rest.size() < n_before || rest.size() - n_before < entry.packed_size) return std::nullopt;
  rest = rest.substr(n_before, entry.packed_size);
  if (entry.method == 0) return std::string(rest.substr(0, most));
  if (entry.method != 8) return std::nullopt;

  z_stream stream{};
  constexpr int kRawDeflate = -15;
  if (::inflateInit2(&stream, kRawDeflate) != Z_OK) return std::nullopt;
  std::string contents;
  constexpr std::size_t kStep = std::size_t{1} << 20U;
  int result = Z_OK;
  while (result == Z_OK && contents.size() < most) {
    const std::size_t before = contents.size();
    contents.resize(std::min(most, before + kStep));
    const auto n_in = static_cast<uInt>(std::min<std::size_t>(rest.size(), std::size_t{1} << 30U));
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(rest.data()));  // zlib only reads it
    stream.avail_in = n_in;
    stream.next_out = reinterpret_cast<Bytef*>(contents.data() + before);
    stream.avail_out = static_cast<uInt>(contents.size() - before);
    result = ::inflate(&stream, Z_NO_FLUSH);
    rest.remove_prefix(n_in - stream.avail_in);
    contents.resize(contents.size() - stream.avail_out);
  }
  ::inflateEnd(&stream);
  if (result != Z_STREAM_END && contents.size() < most) return std::nullopt;
  return contents;
}

}  // namespace vex
