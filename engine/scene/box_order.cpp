#include "engine/scene/box_order.h"

#include <algorithm>
#include <limits>

#include "engine/numeric/interruption.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

struct Bounds {
  double lower[3], upper[3];

  static Bounds none() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  }
  void add(const double (&low)[3], const double (&up)[3]) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = low[k] < lower[k] ? low[k] : lower[k];
      upper[k] = up[k] > upper[k] ? up[k] : upper[k];
    }
  }
};

void middle_of(const Aabb& box, double (&middle)[3]) {
  middle[0] = 0.5 * box.lower.x + 0.5 * box.upper.x;
  middle[1] = 0.5 * box.lower.y + 0.5 * box.upper.y;
  middle[2] = 0.5 * box.lower.z + 0.5 * box.upper.z;
}

// In a range the keys below p, or not above p, are moved to its front; where they end. No branch depends on a key: half
// of the predictions of one would fail.
template <bool kOrEqual>
BoxKey* partition(BoxKey* first, BoxKey* last, int axis, float p) {
  BoxKey* end = first;
  for (BoxKey* key = first; key != last; ++key) {
    const BoxKey here = *key;
    *key = *end;
    *end = here;
    const float x = here.middle[axis];
    end += (kOrEqual ? x <= p : x < p) ? 1 : 0;
  }
  return end;
}

// std::nth_element, by pivots on both sides of the element that is sought, taken from a sample (R. W. Floyd and
// R. L. Rivest, Commun. ACM 18, 165 (1975)).
void select(BoxKey* first, BoxKey* nth, BoxKey* last, int axis) {
  constexpr std::ptrdiff_t kSample = 64, kAside = 6;  // of the rank of a random sample's median 4 is the std deviation
  while (last - first > 2 * kSample) {
    const std::ptrdiff_t n = last - first;
    float sample[kSample];
    for (std::ptrdiff_t k = 0; k < kSample; ++k) sample[k] = first[n * k / kSample].middle[axis];
    std::sort(sample, sample + kSample);
    const std::ptrdiff_t rank = (nth - first) * kSample / n;
    const float low = sample[std::max<std::ptrdiff_t>(rank - kAside, 0)];
    const float up = sample[std::min<std::ptrdiff_t>(rank + kAside, kSample - 1)];
    BoxKey* const begin = partition<false>(first, last, axis, low);
    if (nth < begin) {
      last = begin;
    } else {
      first = begin;
      BoxKey* const end = partition<true>(first, last, axis, up);
      (nth < end ? last : first) = end;
      if (nth < end && low == up) return;  // all that are left are equal
    }
    if (last - first > n - n / 4) break;  // an unlucky sample
  }
  std::nth_element(first, nth, last,
                   [axis](const BoxKey& a, const BoxKey& b) { return a.middle[axis] < b.middle[axis]; });
}

// Boxes in a row that are to be a node, or some children of one: `capacity`, a power of the width, is how many boxes
// the node may have.
struct Range {
  std::size_t first, last, capacity;
};

class Ordering {
 public:
  Ordering(std::span<const Aabb> boxes, std::size_t width, BoxKey* keys) : boxes_(boxes), width_(width), keys_(keys) {}

  // Sets the middles of a range on the scale of the range. False where all are in one place.
  bool set_middles(const Range& range, int n_threads) const {
    constexpr std::size_t kLeast = 1 << 14;
    const std::size_t n = range.last - range.first;
    std::vector<Bounds> parts(n / kLeast + 1, Bounds::none());
    share_range(n_threads, n, kLeast, [&](std::size_t from, std::size_t to) {
      Bounds bounds = Bounds::none();
      double middle[3];
      for (std::size_t k = from; k < to; ++k) {
        middle_of(boxes_[keys_[range.first + k].box], middle);
        bounds.add(middle, middle);
      }
      parts[from / kLeast] = bounds;
    });
    Bounds all = Bounds::none();
    for (const Bounds& part : parts) all.add(part.lower, part.upper);
    double widest = 0.0;
    for (int axis = 0; axis < 3; ++axis) widest = std::max(widest, all.upper[axis] - all.lower[axis]);
    if (!(widest > 0.0)) return false;
    share_range(n_threads, n, kLeast, [&](std::size_t from, std::size_t to) {
      double middle[3];
      for (std::size_t k = from; k < to; ++k) {
        BoxKey& key = keys_[range.first + k];
        middle_of(boxes_[key.box], middle);
        for (int axis = 0; axis < 3; ++axis) {
          key.middle[axis] = static_cast<float>((middle[axis] - all.lower[axis]) / widest);
        }
      }
    });
    return true;
  }

  // Splits a range in two; false where it is one block, or all of its boxes are in one place.
  bool split(Range& range, Range& right) const {
    const std::size_t n = range.last - range.first;
    if (n <= width_) return false;
    while (n <= range.capacity / width_) range.capacity /= width_;
    const std::size_t child = range.capacity / width_;
    const std::size_t n_left = (n + child - 1) / child / 2 * child;
    float widest = 0.0f;
    int axis = widest_axis(range, widest);
    // Floats resolve 2^-24 of the range that they were set for: before they no longer resolve this one, they are set
    // anew.
    if (widest < 0x1p-10f) {
      if (!set_middles(range, 1)) return false;
      axis = widest_axis(range, widest);
    }
    BoxKey* const keys = keys_ + range.first;
    select(keys, keys + n_left, keys + n, axis);
    right = {range.first + n_left, range.last, range.capacity};
    range.last = range.first + n_left;
    return true;
  }

  void sort(Range range) const {
    constexpr std::size_t kLong = 1 << 14;
    Range right{};
    while (split(range, right)) {
      if (right.last - right.first > kLong) end_if_interrupted();
      sort(right);
    }
  }

 private:
  int widest_axis(const Range& range, float& widest) const {
    const BoxKey* const keys = keys_ + range.first;
    float x[2] = {keys->middle[0], keys->middle[0]}, y[2] = {keys->middle[1], keys->middle[1]},
          z[2] = {keys->middle[2], keys->middle[2]};
    const auto widen = [](float(&range_of)[2], float value) {
      range_of[0] = value < range_of[0] ? value : range_of[0];
      range_of[1] = value > range_of[1] ? value : range_of[1];
    };
    for (std::size_t k = 1; k < range.last - range.first; ++k) {
      widen(x, keys[k].middle[0]);
      widen(y, keys[k].middle[1]);
      widen(z, keys[k].middle[2]);
    }
    const float wide[3] = {x[1] - x[0], y[1] - y[0], z[1] - z[0]};
    const int axis = wide[0] >= wide[1] ? (wide[0] >= wide[2] ? 0 : 2) : (wide[1] >= wide[2] ? 1 : 2);
    widest = wide[axis];
    return axis;
  }

  std::span<const Aabb> boxes_;
  std::size_t width_;
  BoxKey* keys_;
};

}  // namespace

void order_boxes(std::span<const Aabb> boxes, std::size_t width, int n_threads, std::vector<BoxKey>& memory,
                 std::vector<std::uint32_t>& order) {
  const std::size_t n = boxes.size();
  memory.resize(n);
  order.resize(n);
  for (std::size_t k = 0; k < n; ++k) memory[k].box = static_cast<std::uint32_t>(k);
  const Ordering ordering(boxes, width, memory.data());
  std::size_t capacity = width;
  while (capacity < n) capacity *= width;
  std::vector<Range> ranges = {{0, n, capacity}};
  if (n > width && ordering.set_middles(ranges[0], n_threads)) {
    // Level by level, until there are ranges enough for all threads.
    while (n_threads > 1 && ranges.size() < 8 * static_cast<std::size_t>(n_threads) && ranges.size() < n / 4096) {
      std::vector<Range> halves(2 * ranges.size());
      share_parts(n_threads, ranges.size(), [&](std::size_t k) {
        halves[2 * k] = ranges[k];
        if (!ordering.split(halves[2 * k], halves[2 * k + 1])) halves[2 * k + 1] = {0, 0, width};
      });
      ranges = halves;
    }
    share_parts(n_threads, ranges.size(), [&](std::size_t k) { ordering.sort(ranges[k]); });
  }
  for (std::size_t k = 0; k < n; ++k) order[k] = memory[k].box;
}

}  // namespace vex
