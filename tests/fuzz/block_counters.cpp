// What tells libFuzzer which blocks ran, of what g++ compiled with -fsanitize-coverage=trace-pc. libFuzzer's own
// function of this name refuses ("no longer supported"), so the linker puts this one in its place (--wrap).
//
// Blocks share 2^16 counters by a hash of their addresses. Of n blocks about n^2 / 2^17 pairs share one: for the ten
// thousand of the readers a hundredth of what is new is not seen to be, which costs a campaign inputs and no verdict.
#include <cstddef>
#include <cstdint>

extern "C" void __sanitizer_cov_8bit_counters_init(std::uint8_t* begin, std::uint8_t* end);

namespace {

constexpr int kLogCounters = 16;
std::uint8_t counters[std::size_t{1} << kLogCounters];

[[maybe_unused]] const bool are_known = [] {
  __sanitizer_cov_8bit_counters_init(counters, counters + sizeof counters);
  return true;
}();

}  // namespace

extern "C" void __wrap___sanitizer_cov_trace_pc() {
  const auto block = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  ++counters[(block * 0x9e3779b97f4a7c15U) >> (64 - kLogCounters)];
}
