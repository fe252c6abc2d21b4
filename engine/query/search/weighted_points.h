// Up to four points with weights: of a simplex, or of a combination of its corners.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include "engine/numeric/double_double.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// What is not there is neither written nor copied: four points are 400 bytes, of which most searches use one or two,
/// and to set them to 0 and copy them takes as long as a support call of a box.
template <class L, class Point>
class WeightedPoints {
  static_assert(std::is_trivially_destructible_v<L> && std::is_trivially_destructible_v<Point>);

 public:
  WeightedPoints() {}
  WeightedPoints(const WeightedPoints& other) { *this = other; }
  WeightedPoints& operator=(const WeightedPoints& other) {
    size_ = other.size_;
    for (std::size_t k = 0; k < size_; ++k) std::construct_at(items_ + k, other.items_[k]);
    return *this;
  }

  std::size_t size() const { return size_; }
  const Point& point(std::size_t k) const { return items_[k].point; }
  const L& weight(std::size_t k) const { return items_[k].weight; }

  void clear() { size_ = 0; }
  void add(const L& weight, const Point& point) { std::construct_at(items_ + size_++, Item{point, weight}); }
  /// The first ones are those that stand at `old`, none of which is before its new place, with these weights.
  void keep(std::size_t k, std::size_t old, const L& weight) {
    if (old != k) items_[k].point = items_[old].point;
    items_[k].weight = weight;
  }
  void cut(std::size_t n) { size_ = n; }

 private:
  struct Item {
    Point point;
    L weight;
  };
  std::size_t size_ = 0;
  union {
    Item items_[4];
  };
};

inline double rounded(double x) { return x; }
inline double rounded(const DoubleDouble& x) { return x.high; }

/// Of what goes with the points: in the bodies' frames, where what is turned and moved is so once.
template <class L, class Point>
Vec3d weighted_sum(const WeightedPoints<L, Point>& points, Vec3d Point::*member) {
  Vec3d sum;
  for (std::size_t k = 0; k < points.size(); ++k) {
    sum = sum + rounded(points.weight(k)) * (points.point(k).*member);
  }
  return sum;
}

}  // namespace vex
