// The order in which the leaves of a tree of boxes stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/aabb.h"

namespace vex {

/// What sorting needs of a box: its middle, on the scale of the boxes that it is sorted with, and its number.
struct BoxKey {
  float middle[3];
  std::uint32_t box;
};

/// Numbers of the boxes in an order in which each range of width^k of them, counted from the first, is compact. Halved
/// again and again as a k-d tree is (J. L. Bentley, Commun. ACM 18, 509 (1975)), along the axis along which the middles
/// differ most. Sizes are not looked at: to halve by them as by a fourth coordinate was found to make trees of boxes of
/// sizes 1:1000 worse. The same order for any number of threads. `memory` is kept from one call to the next.
void order_boxes(std::span<const Aabb> boxes, std::size_t width, int n_threads, std::vector<BoxKey>& memory,
                 std::vector<std::uint32_t>& order);

}  // namespace vex
