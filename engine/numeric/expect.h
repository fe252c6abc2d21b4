// Pre- and postconditions, checked in every build but the optimised ones (where NDEBUG is set).
//
// What a user can cause is never one of these: it is an exception of the family in errors.h.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace vex::detail {
[[noreturn]] inline void condition_failed(const char* kind, const char* text, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: %s failed: %s\n", file, line, kind, text);
  std::abort();
}
}  // namespace vex::detail

#ifdef NDEBUG
#define VEX_EXPECT(condition) static_cast<void>(sizeof(!(condition)))
#define VEX_ENSURE(condition) static_cast<void>(sizeof(!(condition)))
#else
#define VEX_CHECK_CONDITION(kind, condition) \
  ((condition) ? static_cast<void>(0) : ::vex::detail::condition_failed(kind, #condition, __FILE__, __LINE__))
#define VEX_EXPECT(condition) VEX_CHECK_CONDITION("precondition", condition)
#define VEX_ENSURE(condition) VEX_CHECK_CONDITION("postcondition", condition)
#endif
