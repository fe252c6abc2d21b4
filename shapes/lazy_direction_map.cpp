#include "shapes/lazy_direction_map.h"

#include <new>

namespace vex {

const DirectionMap* LazyDirectionMap::make(std::span<const double> x, std::span<const double> y,
                                           std::span<const double> z) {
  try {
    map_ = std::make_unique<const DirectionMap>(x, y, z);
  } catch (const std::bad_alloc&) {
    return nullptr;  // the scan needs no memory, and goes on answering
  }
  ready_.store(map_.get(), std::memory_order_release);
  return map_.get();
}

}  // namespace vex
