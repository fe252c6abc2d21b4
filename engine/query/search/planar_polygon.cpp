#include "engine/query/search/planar_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vex {
namespace {

// Of coordinates whose squares are numbers.
double length(const PlanarPoint& a) { return std::sqrt(dot(a, a)); }

// How far `at` is to the left of the line from one point to another.
double left_of(const PlanarPoint& from, const PlanarPoint& to, const PlanarPoint& at) {
  const PlanarPoint along = to - from;
  return turn(along, at - from) / length(along);
}

// The chain from the first to the last of sorted points that has them all to its left.
void add_chain(const std::vector<PlanarPoint>& sorted, double resolution, std::vector<PlanarPoint>& hull) {
  const std::size_t begin = hull.size();
  for (const PlanarPoint& point : sorted) {
    while (hull.size() >= begin + 2 && !(left_of(hull[hull.size() - 2], point, hull.back()) < -resolution)) {
      hull.pop_back();
    }
    if (hull.size() > begin && length(point - hull.back()) <= resolution) {
      if (hull.size() > begin + 1) hull.back() = point;
      continue;
    }
    hull.push_back(point);
  }
}

// As std::stable_sort, but in memory that is there; and as there any answers of `is_before` will do, as of rounded
// differences that do not agree with each other.
template <class IsBefore>
void sort_in(std::vector<PlanarPoint>& points, std::vector<PlanarPoint>& merged, const IsBefore& is_before) {
  constexpr std::size_t kInserted = 8;
  const std::size_t n = points.size();
  for (std::size_t from = 0; from < n; from += kInserted) {
    for (std::size_t k = from + 1; k < std::min(from + kInserted, n); ++k) {
      const PlanarPoint point = points[k];
      std::size_t at = k;
      for (; at > from && is_before(point, points[at - 1]); --at) points[at] = points[at - 1];
      points[at] = point;
    }
  }
  merged.resize(n);
  for (std::size_t run = kInserted; run < n; run *= 2) {
    for (std::size_t from = 0; from < n; from += 2 * run) {
      const auto at = [&](std::size_t k) { return points.begin() + static_cast<std::ptrdiff_t>(std::min(k, n)); };
      std::merge(at(from), at(from + run), at(from + run), at(from + 2 * run),
                 merged.begin() + static_cast<std::ptrdiff_t>(from), is_before);
    }
    points.swap(merged);
  }
}

}  // namespace

void planar_hull(const std::vector<PlanarPoint>& points, double resolution, PlanarMemory& memory,
                 std::vector<PlanarPoint>& hull) {
  // Along the longest extent, so that the ends of the chains are far from each other.
  PlanarPoint from = points.front(), to = points.front();
  for (int round = 0; round < 2; ++round) {
    for (const PlanarPoint& p : points) {
      if (dot(p - from, p - from) > dot(to - from, to - from)) to = p;
    }
    std::swap(from, to);
  }
  hull.clear();
  const double extent = length(to - from);
  if (!(extent > resolution)) {
    hull.push_back(from);
    return;
  }
  const PlanarPoint along = (1.0 / extent) * (to - from);
  memory.sorted = points;
  sort_in(memory.sorted, memory.merged, [&](const PlanarPoint& a, const PlanarPoint& b) {
    const double by = dot(along, a - b);
    return by != 0.0 ? by < 0.0 : turn(along, a - b) < 0.0;
  });
  add_chain(memory.sorted, resolution, hull);
  hull.pop_back();
  std::ranges::reverse(memory.sorted);
  add_chain(memory.sorted, resolution, hull);
  hull.pop_back();
  if (hull.size() >= 2) return;
  hull.clear();
  hull.push_back(from);
  hull.push_back(to);
}

namespace {

void clip_all(std::vector<PlanarPoint>& part, const ClippingSide& side, std::vector<PlanarPoint>& kept) {
  if (std::ranges::all_of(part, [&](const PlanarPoint& at) { return side.is_left(side.left(at)); })) return;
  kept.clear();
  const auto keep = [&kept](const PlanarPoint& place) { kept.push_back(place); };
  // A segment has one side, a point none.
  const std::size_t n_sides = part.size() > 2 ? part.size() : part.size() - 1;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const double at = side.left(part[k]);
    if (side.is_left(at)) keep(part[k]);
    if (k >= n_sides) continue;
    const PlanarPoint& next = part[(k + 1) % part.size()];
    side.cross(part[k], at, next, side.left(next), keep);
  }
  part.swap(kept);
}

}  // namespace

void BoxedPolygon::take(const std::vector<PlanarPoint>& corners) {
  size_ = corners.size();
  n_boxes_ = (size_ + kOfBox - 1) / kOfBox;
  if (boxes_.size() < n_boxes_) boxes_.resize(n_boxes_);
  for (std::size_t k = 0; k < n_boxes_; ++k) {
    const auto at = [&](std::size_t i) { return corners.begin() + static_cast<std::ptrdiff_t>(i); };
    boxes_[k].corners.assign(at(k * kOfBox), at(std::min((k + 1) * kOfBox, size_)));
    boxes_[k].bound();
  }
}

void BoxedPolygon::corners(std::vector<PlanarPoint>& all) const {
  all.clear();
  for (std::size_t k = 0; k < n_boxes_; ++k) {
    all.insert(all.end(), boxes_[k].corners.begin(), boxes_[k].corners.end());
  }
}

void BoxedPolygon::clip(const ClippingSide& side) {
  const std::size_t n = n_boxes_;
  const PlanarPoint first = boxes_.front().corners.front();
  bool is_any_empty = false;
  for (std::size_t k = 0; k < n; ++k) {
    Box& box = boxes_[k];
    const PlanarPoint last_next = k + 1 < n ? boxes_[k + 1].corners.front() : first;
    if (box.is_left_of(side) && side.is_left(side.left(last_next))) continue;
    kept_.clear();
    const auto keep = [this](const PlanarPoint& place) { kept_.push_back(place); };
    for (std::size_t i = 0; i < box.corners.size(); ++i) {
      const double at = side.left(box.corners[i]);
      if (side.is_left(at)) keep(box.corners[i]);
      const PlanarPoint& next = i + 1 < box.corners.size() ? box.corners[i + 1] : last_next;
      side.cross(box.corners[i], at, next, side.left(next), keep);
    }
    size_ = size_ - box.corners.size() + kept_.size();
    is_any_empty = is_any_empty || kept_.empty();
    box.corners.swap(kept_);
    box.bound();
  }
  if (!is_any_empty) return;
  // Empty ones go behind the others, with their memory.
  n_boxes_ = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (boxes_[k].corners.empty()) continue;
    if (k != n_boxes_) std::swap(boxes_[k], boxes_[n_boxes_]);
    ++n_boxes_;
  }
}

void BoxedPolygon::Box::bound() {
  least = {HUGE_VAL, HUGE_VAL};
  most = {-HUGE_VAL, -HUGE_VAL};
  for (const PlanarPoint& p : corners) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
}

// All of it, whatever is rounded; where that is not clear its corners are asked.
bool BoxedPolygon::Box::is_left_of(const ClippingSide& side) const {
  const PlanarPoint& along = side.along;
  const PlanarPoint rightmost{along.y > 0.0 ? most.x : least.x, along.x > 0.0 ? least.y : most.y};
  const PlanarPoint off = rightmost - side.from;
  const double rounding = 0x1p-48 * (std::fabs(along.x * off.y) + std::fabs(along.y * off.x));
  return turn(along, off) - rounding >= -side.resolution * side.long_as;
}

void clipped(const std::vector<PlanarPoint>& subject, const std::vector<PlanarPoint>& clip, double resolution,
             PlanarMemory& memory, std::vector<PlanarPoint>& part) {
  memory.sides.clear();
  for (std::size_t k = 0; k < clip.size(); ++k) {
    const PlanarPoint along = clip[(k + 1) % clip.size()] - clip[k];
    memory.sides.push_back({clip[k], along, length(along), resolution});
  }
  part = subject;
  auto side = memory.sides.begin();
  if (part.size() >= BoxedPolygon::kMany) {
    memory.boxed.take(part);
    for (; side != memory.sides.end() && memory.boxed.size() >= BoxedPolygon::kMany; ++side) memory.boxed.clip(*side);
    memory.boxed.corners(part);
  }
  for (; side != memory.sides.end() && !part.empty(); ++side) clip_all(part, *side, memory.merged);
}

double distance_to(const std::vector<PlanarPoint>& polygon, const PlanarPoint& point) {
  double nearest_sq = HUGE_VAL;
  bool is_inside = true;
  for (std::size_t side = 0; side < polygon.size(); ++side) {
    const PlanarPoint &from = polygon[side], along = polygon[(side + 1) % polygon.size()] - from;
    const double share = std::clamp(dot(along, point - from) / dot(along, along), 0.0, 1.0);
    const PlanarPoint off = (point - from) - share * along;
    nearest_sq = std::min(nearest_sq, dot(off, off));
    is_inside = is_inside && turn(along, point - from) >= 0.0;
  }
  return is_inside ? 0.0 : std::sqrt(nearest_sq);
}

}  // namespace vex
