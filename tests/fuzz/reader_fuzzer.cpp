// libFuzzer's way into what is fuzzed: readers of meshes, of what else programs read, and queries. VEX_FUZZ_FORMAT in
// the environment names the format; inputs are files of it. tests/fuzz/run compiles and runs it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "program_fuzz.h"
#include "query_fuzz.h"
#include "reader_fuzz.h"
#include "run_state_fuzz.h"

namespace {

vex::tests::FuzzFormat named_format() {
  const char* const name = std::getenv("VEX_FUZZ_FORMAT");
  std::vector<vex::tests::FuzzFormat> formats = vex::tests::fuzz_formats();
  for (const auto& more :
       {vex::tests::program_formats(), vex::tests::run_state_formats(), vex::tests::query_formats()}) {
    formats.insert(formats.end(), more.begin(), more.end());
  }
  const auto found =
      std::ranges::find(formats, std::string(name != nullptr ? name : ""), &vex::tests::FuzzFormat::name);
  if (found == formats.end()) {
    std::fprintf(stderr, "VEX_FUZZ_FORMAT names no format - one of:");
    for (const vex::tests::FuzzFormat& format : formats) std::fprintf(stderr, " %s", format.name.c_str());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  if (name == std::string("query")) {
    std::atexit([] {
      const vex::tests::MostAsked most = vex::tests::most_asked();
      std::fprintf(stderr, "most points asked for: %llu, by %s\n", static_cast<unsigned long long>(most.n_points),
                   most.query);
    });
  }
  return *found;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vex::tests::FuzzFormat kFormat = named_format();
  vex::tests::read_as(kFormat, {reinterpret_cast<const char*>(data), size});
  return 0;
}
