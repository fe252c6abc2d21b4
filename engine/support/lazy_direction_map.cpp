#include "engine/support/lazy_direction_map.h"

#include <new>

namespace vex {

const DirectionMap& LazyDirectionMap::made_now(std::span<const double> x, std::span<const double> y,
                                               std::span<const double> z) {
  if (const DirectionMap* const map = made()) return *map;
  const std::lock_guard lock(making_);
  if (map_ == nullptr) {
    map_ = std::make_unique<const DirectionMap>(x, y, z);
    ready_.store(map_.get(), std::memory_order_release);
  }
  return *map_;
}

const DirectionMap* LazyDirectionMap::make(std::span<const double> x, std::span<const double> y,
                                           std::span<const double> z) {
  try {
    return &made_now(x, y, z);
  } catch (const std::bad_alloc&) {
    return nullptr;  // the scan needs no memory, and goes on answering
  }
}

}  // namespace vex
