// libFuzzer's way into the readers. VEX_FUZZ_FORMAT in the environment names the format; inputs are files of it.
// tests/fuzz/run compiles and runs it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "reader_fuzz.h"

namespace {

vex::tests::FuzzFormat named_format() {
  const char* const name = std::getenv("VEX_FUZZ_FORMAT");
  const std::vector<vex::tests::FuzzFormat> formats = vex::tests::fuzz_formats();
  const auto found =
      std::ranges::find(formats, std::string(name != nullptr ? name : ""), &vex::tests::FuzzFormat::name);
  if (found == formats.end()) {
    std::fprintf(stderr, "VEX_FUZZ_FORMAT names no format - one of:");
    for (const vex::tests::FuzzFormat& format : formats) std::fprintf(stderr, " %s", format.name.c_str());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  return *found;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vex::tests::FuzzFormat kFormat = named_format();
  vex::tests::read_as(kFormat, {reinterpret_cast<const char*>(data), size});
  return 0;
}
