// A direction map that is made when it begins to pay, or when it is asked for.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>

#include "engine/support/direction_map.h"

namespace vex {

/// Shared by the copies of a body and by all threads that ask them. The map costs as much as one to two times
/// kCallsThatPay scans; so whoever asks a body a few times, or never, does not wait for it, and whoever asks for long
/// waits three times as long as was needed at most. While one thread makes it, the others scan. No answer depends on
/// when it is there: it gives what the scan gives, bit for bit. What answers otherwise than by a scan (the kernels,
/// whose values may differ in the last bits from those of single queries) must not begin to when others have asked
/// often enough, which is a matter of time and threads: it asks for the map before its first answer.
class LazyDirectionMap {
 public:
  /// From docs/performance.md, "Large hulls": 1 to 4 us a vertex to make it, 1 ns to scan it.
  static constexpr std::size_t kCallsThatPay = 1500;

  /// Counts a call; the map of these vertices, or null while there is none.
  const DirectionMap* for_call(std::span<const double> x, std::span<const double> y, std::span<const double> z) {
    const DirectionMap* const map = ready_.load(std::memory_order_acquire);
    if (map != nullptr) return map;
    return n_calls_.fetch_add(1, std::memory_order_relaxed) == kCallsThatPay ? make(x, y, z) : nullptr;
  }

  /// The map, or null while there is none.
  const DirectionMap* made() const { return ready_.load(std::memory_order_acquire); }

  /// The map, which the caller waits for. Throws std::bad_alloc where memory does not suffice.
  const DirectionMap& made_now(std::span<const double> x, std::span<const double> y, std::span<const double> z);

 private:
  const DirectionMap* make(std::span<const double> x, std::span<const double> y, std::span<const double> z);

  std::atomic<std::size_t> n_calls_ = 0;
  std::atomic<const DirectionMap*> ready_ = nullptr;
  std::mutex making_;
  std::unique_ptr<const DirectionMap> map_;  // set once, before ready_ and under making_
};

}  // namespace vex
