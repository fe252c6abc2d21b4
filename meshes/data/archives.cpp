#include "meshes/data/archives.h"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace vex {
namespace {

const Bytef* input_of(const std::string& bytes) { return reinterpret_cast<const Bytef*>(bytes.data()); }

/// `window`: as zlib's deflateInit2 has it; negative without a heading, above 15 with gzip's.
std::string deflated_by(const std::string& bytes, int window) {
  z_stream stream{};
  if (::deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("zlib does not start");
  }
  std::string packed(::deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = const_cast<Bytef*>(input_of(bytes));  // zlib only reads it
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = ::deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib does not end");
  return packed;
}

void put(std::uint64_t value, int n_bytes, std::string* bytes) {
  for (int k = 0; k < n_bytes; ++k) bytes->push_back(static_cast<char>(static_cast<unsigned char>(value >> (8 * k))));
}

}  // namespace

std::string gzipped(const std::string& bytes) { return deflated_by(bytes, 15 + 16); }

std::string zipped(const std::vector<std::pair<std::string, std::string>>& files, bool deflated) {
  std::string bytes;
  std::string directory;
  for (const auto& [name, contents] : files) {
    const std::string packed = deflated ? deflated_by(contents, -15) : contents;
    std::string common;  // of the file's own heading and of the list's entry
    put(20, 2, &common), put(0, 2, &common), put(deflated ? 8 : 0, 2, &common), put(0x210000, 4, &common);
    put(::crc32(0, input_of(contents), static_cast<uInt>(contents.size())), 4, &common);
    put(packed.size(), 4, &common), put(contents.size(), 4, &common), put(name.size(), 2, &common);
    put(0, 2, &common);
    put(0x02014B50, 4, &directory), put(20, 2, &directory);
    directory += common + std::string(10, '\0');
    put(bytes.size(), 4, &directory);
    directory += name;
    put(0x04034B50, 4, &bytes);
    bytes += common + name + packed;
  }
  const std::size_t directory_at = bytes.size();
  bytes += directory;
  put(0x06054B50, 4, &bytes), put(0, 4, &bytes), put(files.size(), 2, &bytes), put(files.size(), 2, &bytes);
  put(directory.size(), 4, &bytes), put(directory_at, 4, &bytes), put(0, 2, &bytes);
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    result += kDigits[group >> 18U & 63U];
    result += kDigits[group >> 12U & 63U];
    result += i + 1 < bytes.size() ? kDigits[group >> 6U & 63U] : '=';
    result += i + 2 < bytes.size() ? kDigits[group & 63U] : '=';
  }
  return result;
}

}  // namespace vex
