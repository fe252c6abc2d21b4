#include "archives.h"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>

namespace vex::tests {
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

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, bool deflated) {
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

std::string gzip_of(const std::string& bytes) { return deflated_by(bytes, 15 + 16); }

std::string threemf_of(const std::string& model, const std::vector<std::pair<std::string, std::string>>& more,
                       bool deflated) {
  const std::string relations =
      "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  std::vector<std::pair<std::string, std::string>> files{
      {"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}};
  files.insert(files.end(), more.begin(), more.end());
  return zip_of(files, deflated);
}

}  // namespace vex::tests
