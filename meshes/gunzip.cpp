#include "meshes/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/machine_memory.h"

namespace vex {
namespace {

class Inflater {
 public:
  Inflater() {
    constexpr int kLargestWindow = 15, kGzip = 16;
    if (::inflateInit2(&stream, kLargestWindow + kGzip) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { ::inflateEnd(&stream); }

  z_stream stream{};
};

/// zlib counts what it may take and give in 32 bits. What it takes at once becomes no more than some 1000 times as
/// much, within a fraction of a second.
uInt taken_at_once(std::size_t size) { return static_cast<uInt>(std::min<std::size_t>(size, kMiB)); }
uInt given_at_once(std::size_t size) { return static_cast<uInt>(std::min<std::size_t>(size, std::size_t{1} << 30U)); }

/// What the last member says of its own size: a hint only.
std::uint64_t size_at_the_end(std::string_view packed) {
  std::uint64_t size = 0;
  for (std::size_t k = 0; k < 4 && packed.size() >= 18; ++k) {
    size |= std::uint64_t{static_cast<unsigned char>(packed[packed.size() - 4 + k])} << (8 * k);
  }
  return size;
}

}  // namespace

FileBytes gunzip(std::string_view packed, const std::string& name) {
  const std::string advice = " - fetch it or pack it again";
  const std::uint64_t most = std::min<std::uint64_t>(kMostInflation * packed.size() + kMiB, most_file_bytes());
  Inflater inflater;
  z_stream& stream = inflater.stream;
  FileBytes bytes;
  bytes.resize(static_cast<std::size_t>(std::min(most, std::max(size_at_the_end(packed), 2 * packed.size()) + 1)));
  std::size_t taken = 0;
  std::size_t given = 0;
  bool is_at_end = false;  // of a member
  do {
    if (is_at_end) {
      ::inflateReset(&stream);
      is_at_end = false;
    }
    if (given == bytes.size()) {
      if (given >= most) {
        throw InputError(name + " unpacks to too much (more than " + std::to_string(most / kMiB) + " MiB from " +
                         std::to_string(packed.size()) + " bytes; at most " + std::to_string(kMostInflation) +
                         " times its size and half of the memory are unpacked) - unpack it yourself");
      }
      bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(most, 2 * bytes.size())));
    }
    end_if_interrupted();
    const uInt n_in = taken_at_once(packed.size() - taken);
    const uInt n_out = given_at_once(bytes.size() - given);
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data() + taken));  // zlib only reads it
    stream.avail_in = n_in;
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + given);
    stream.avail_out = n_out;
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    taken += n_in - stream.avail_in;
    given += n_out - stream.avail_out;
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    is_at_end = result == Z_STREAM_END;
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) {
      throw InputError(name + " is no whole gzip file (byte " + std::to_string(taken) + ": " +
                       (stream.msg != nullptr ? stream.msg : "no gzip data") + ")" + advice);
    }
    if (!is_at_end && taken == packed.size() && given < bytes.size()) {
      throw InputError(name + " ends too early (after " + std::to_string(packed.size()) + " bytes of gzip data)" +
                       advice);
    }
  } while (!is_at_end || taken < packed.size());
  if (given == 0) throw InputError(name + " is empty (0 bytes when it is unpacked) - name a file that holds a mesh");
  bytes.resize(given);
  return bytes;
}

}  // namespace vex
