// libFuzzer's way into the readers of our own: whatever the bytes, a reader ends in an InputError or in a soup that
// keeps what strict_readers.h promises. The first byte picks the format.
//
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -I. \
//     tests/fuzz/strict_reader_fuzz.cpp meshes/formats/*.cpp -o strict_reader_fuzz
//   ./strict_reader_fuzz -max_len=4096 -timeout=10 -rss_limit_mb=2048 corpus/
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/numeric/errors.h"
#include "meshes/formats/strict_readers.h"

namespace vex {
namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

void check_soup(const PolygonSoup& soup, std::size_t n_bytes) {
  std::uint64_t n_corners = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    demand(size >= 3, "a face has three corners at least");
    n_corners += size;
  }
  demand(n_corners == soup.corners.size(), "the faces' sizes sum up to the corners");
  for (const std::uint32_t corner : soup.corners) demand(corner < soup.points.size(), "corners are points");
  double largest = 0.0;
  for (const Vec3d& p : soup.points) {
    demand(is_finite(p), "coordinates are finite");
    largest = std::fmax(largest, std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z))));
  }
  demand(!soup.points.empty() || soup.corners.empty(), "there are points");
  const std::size_t held = 24 * soup.points.size() + 4 * soup.corners.size() + 4 * soup.face_sizes.size();
  demand(held <= 64 * n_bytes + 4096, "the soup is at most a multiple of the file");
  const std::size_t taken = 24 * soup.points.capacity() + 4 * soup.corners.capacity() + 4 * soup.face_sizes.capacity();
  demand(taken <= 128 * n_bytes + 4096, "so is the memory taken");
  demand(std::isfinite(soup.digits.last_place) && soup.digits.last_place >= 0.0, "the last place is a length");
  demand(soup.digits.kind != CoordinateDigits::Kind::decimals || soup.digits.n_digits >= 1, "decimals have digits");
  demand(soup.points.empty() || soup.digits.last_place > 0.0, "points have a last place");
}

void check_message(const std::string& message, const std::string& name) {
  demand(message.find(name) != std::string::npos, "the message names the file");
  const std::size_t advice = message.find(" - ");
  demand(advice != std::string::npos && advice == message.rfind(" - "), "the message ends in one advice");
  demand(message.size() < 600, "the message is short");
  for (const char c : message) demand(c >= ' ' && c <= '~', "the message can be printed");
}

void read_one(std::string_view data) {
  const std::span<const StrictFormat> formats = strict_formats();
  static const char* const kOnly = std::getenv("VEX_FUZZ_EXTENSION");
  const StrictFormat* const only = kOnly != nullptr ? strict_format(kOnly) : nullptr;
  const StrictFormat& format = only != nullptr ? *only : formats[static_cast<unsigned char>(data[0]) % formats.size()];
  // A copy of its own, so that the address sanitizer sees a byte read beyond the end.
  const std::size_t n_bytes = data.size() - 1;
  const std::unique_ptr<char[]> bytes(new char[n_bytes]);
  std::memcpy(bytes.get(), data.data() + 1, n_bytes);
  const std::string name = "fuzz.bin";
  try {
    check_soup(format.read({bytes.get(), n_bytes}, name), n_bytes);
  } catch (const InputError& error) {
    check_message(error.what(), name);
  }
}

}  // namespace
}  // namespace vex

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) vex::read_one({reinterpret_cast<const char*>(data), size});
  return 0;
}
