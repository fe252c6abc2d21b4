#include "engine/query/search/planar_polygon.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::vector<PlanarPoint> planar_hull(std::vector<PlanarPoint> points, double resolution) {
  // Along the longest extent, so that the ends of the chains are far from each other.
  PlanarPoint from = points.front(), to = points.front();
  for (int round = 0; round < 2; ++round) {
    for (const PlanarPoint& p : points) {
      if (dot(p - from, p - from) > dot(to - from, to - from)) to = p;
    }
    std::swap(from, to);
  }
  const double extent = length(to - from);
  if (!(extent > resolution)) return {from};
  const PlanarPoint along = (1.0 / extent) * (to - from);
  // By rounded differences, which need not agree with each other: a sort that takes any answers.
  std::ranges::stable_sort(points, [&](const PlanarPoint& a, const PlanarPoint& b) {
    const double by = dot(along, a - b);
    return by != 0.0 ? by < 0.0 : turn(along, a - b) < 0.0;
  });
  std::vector<PlanarPoint> hull;
  add_chain(points, resolution, hull);
  hull.pop_back();
  std::ranges::reverse(points);
  add_chain(points, resolution, hull);
  hull.pop_back();
  if (hull.size() < 2) return {from, to};
  return hull;
}

namespace {

// One side of a polygon that clips: how far a place is to the left of it.
struct ClippingSide {
  PlanarPoint from, along;
  double long_as, resolution;

  double left(const PlanarPoint& at) const { return turn(along, at - from) / long_as; }
  bool is_left(double at) const { return at >= -resolution; }
  // Where the way from one place to the next one passes the line, if it does so beyond doubt.
  template <class Take>
  void cross(const PlanarPoint& place, double at, const PlanarPoint& next, double at_next, const Take& take) const {
    if (is_left(at) != is_left(at_next) && std::fabs(at) > resolution && std::fabs(at_next) > resolution) {
      take(place + (at / (at - at_next)) * (next - place));
    }
  }
};

void clip_all(std::vector<PlanarPoint>& part, const ClippingSide& side) {
  if (std::ranges::all_of(part, [&](const PlanarPoint& at) { return side.is_left(side.left(at)); })) return;
  std::vector<PlanarPoint> kept;
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
  part = std::move(kept);
}

// A polygon of many corners, some after the other in a box: sides of which a box is to the left are not asked for its
// corners, so that a polygon clips another in a time that grows with little more than the number of their corners.
class BoxedPolygon {
 public:
  static constexpr std::size_t kMany = 64;

  explicit BoxedPolygon(const std::vector<PlanarPoint>& corners) : size_(corners.size()) {
    for (std::size_t k = 0; k < corners.size(); k += kOfBox) {
      const std::size_t end = std::min(k + kOfBox, corners.size());
      boxes_.push_back(
          Box({corners.begin() + static_cast<std::ptrdiff_t>(k), corners.begin() + static_cast<std::ptrdiff_t>(end)}));
    }
  }

  std::size_t size() const { return size_; }
  std::vector<PlanarPoint> corners() const {
    std::vector<PlanarPoint> all;
    for (const Box& box : boxes_) all.insert(all.end(), box.corners.begin(), box.corners.end());
    return all;
  }

  void clip(const ClippingSide& side) {
    const std::size_t n = boxes_.size();
    const PlanarPoint first = boxes_.front().corners.front();
    bool is_any_empty = false;
    for (std::size_t k = 0; k < n; ++k) {
      Box& box = boxes_[k];
      const PlanarPoint last_next = k + 1 < n ? boxes_[k + 1].corners.front() : first;
      if (box.is_left_of(side) && side.is_left(side.left(last_next))) continue;
      std::vector<PlanarPoint> kept;
      const auto keep = [&kept](const PlanarPoint& place) { kept.push_back(place); };
      for (std::size_t i = 0; i < box.corners.size(); ++i) {
        const double at = side.left(box.corners[i]);
        if (side.is_left(at)) keep(box.corners[i]);
        const PlanarPoint& next = i + 1 < box.corners.size() ? box.corners[i + 1] : last_next;
        side.cross(box.corners[i], at, next, side.left(next), keep);
      }
      size_ = size_ - box.corners.size() + kept.size();
      is_any_empty = is_any_empty || kept.empty();
      box = Box(std::move(kept));
    }
    if (is_any_empty) std::erase_if(boxes_, [](const Box& box) { return box.corners.empty(); });
  }

 private:
  static constexpr std::size_t kOfBox = 24;

  struct Box {
    std::vector<PlanarPoint> corners;
    PlanarPoint least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};

    explicit Box(std::vector<PlanarPoint> of) : corners(std::move(of)) {
      for (const PlanarPoint& p : corners) {
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
      }
    }
    // All of it, whatever is rounded; where that is not clear its corners are asked.
    bool is_left_of(const ClippingSide& side) const {
      const PlanarPoint& along = side.along;
      const PlanarPoint rightmost{along.y > 0.0 ? most.x : least.x, along.x > 0.0 ? least.y : most.y};
      const PlanarPoint off = rightmost - side.from;
      const double rounding = 0x1p-48 * (std::fabs(along.x * off.y) + std::fabs(along.y * off.x));
      return turn(along, off) - rounding >= -side.resolution * side.long_as;
    }
  };

  std::vector<Box> boxes_;
  std::size_t size_;
};

}  // namespace

std::vector<PlanarPoint> clipped(const std::vector<PlanarPoint>& subject, const std::vector<PlanarPoint>& clip,
                                 double resolution) {
  std::vector<ClippingSide> sides;
  for (std::size_t k = 0; k < clip.size(); ++k) {
    const PlanarPoint along = clip[(k + 1) % clip.size()] - clip[k];
    sides.push_back({clip[k], along, length(along), resolution});
  }
  std::vector<PlanarPoint> part = subject;
  auto side = sides.begin();
  if (part.size() >= BoxedPolygon::kMany) {
    BoxedPolygon boxed(part);
    for (; side != sides.end() && boxed.size() >= BoxedPolygon::kMany; ++side) boxed.clip(*side);
    part = boxed.corners();
  }
  for (; side != sides.end() && !part.empty(); ++side) clip_all(part, *side);
  return part;
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
