#include "tests/docs/outline.h"

#include <cmath>

namespace vex {
namespace {

/// A circle on the unit sphere: its plane is normal to `unit_axis`, at this height above the origin.
struct Circle {
  Vec3d unit_axis;
  double height;

  double radius() const { return std::sqrt(1.0 - height * height); }
  Vec3d middle() const { return height * unit_axis; }
  /// The point of the circle towards `dir`.
  Vec3d towards(const Vec3d& dir) const {
    return middle() + radius() * normalised(dir - dot(dir, unit_axis) * unit_axis);
  }
  /// Half-way along an arc that is shorter than half of the circle.
  Vec3d between(const Vec3d& a, const Vec3d& b) const { return towards((a - middle()) + (b - middle())); }
};

/// Walks the body's surface along arcs of normals.
class Walk {
 public:
  Walk(const ConvexBody& body, double step) : body_(body), step_(step) {}

  /// The arc from a to b, without its end. Halved until the points are close; an arc that jumps along a straight line
  /// is halved until it is so short that the ends of the line are met.
  void along(const Circle& circle, const Vec3d& a, const Vec3d& b) { add(circle, a, b, body_.support(b), 0); }

  std::vector<Vec3d> points;

 private:
  static constexpr int kMinDepth = 5, kMaxDepth = 20;

  void add(const Circle& circle, const Vec3d& a, const Vec3d& b, const Vec3d& at_b, int depth) {
    const Vec3d at_a = body_.support(a);
    if (depth >= kMaxDepth || (depth >= kMinDepth && norm(at_b - at_a) < step_)) {
      points.push_back(at_a);
      return;
    }
    const Vec3d middle = circle.between(a, b);
    add(circle, a, middle, body_.support(middle), depth + 1);
    add(circle, middle, b, at_b, depth + 1);
  }

  const ConvexBody& body_;
  double step_;
};

/// All of the circle, from the point towards `start`.
std::vector<Vec3d> around(const ConvexBody& body, const Circle& circle, const Vec3d& start, double step) {
  const Vec3d east = circle.towards(start), north = circle.towards(cross(circle.unit_axis, start));
  const Vec3d west = circle.towards(-start), south = circle.towards(-cross(circle.unit_axis, start));
  Walk walk(body, step);
  walk.along(circle, east, north);
  walk.along(circle, north, west);
  walk.along(circle, west, south);
  walk.along(circle, south, east);
  return walk.points;
}

}  // namespace

Vec3d normalised(const Vec3d& a) { return (1.0 / norm(a)) * a; }

std::vector<Vec3d> silhouette(const ConvexBody& body, const Vec3d& unit_view, double step) {
  // From a direction that is special for no body.
  return around(body, {unit_view, 0.0}, {0.3, 0.5, 0.7}, step);
}

std::vector<Vec3d> lit_region(const ConvexBody& body, const Vec3d& unit_view, const Vec3d& unit_light,
                              double brightness, double step) {
  const Circle equal{unit_light, brightness}, rim{unit_view, 0.0};
  const double cosine = dot(unit_light, unit_view), sine = std::sqrt(1.0 - cosine * cosine);
  if (brightness <= -sine) return silhouette(body, unit_view, step);
  if (brightness >= sine) return around(body, equal, unit_view, step);
  // The circles meet where n . light = brightness and n . view = 0.
  const Vec3d nearest = (brightness / sine) * rim.towards(unit_light);
  const Vec3d across = std::sqrt(1.0 - dot(nearest, nearest)) * normalised(cross(unit_view, unit_light));
  const Vec3d first = nearest + across, second = nearest - across;
  Walk walk(body, step);
  walk.along(equal, first, equal.towards(unit_view));
  walk.along(equal, equal.towards(unit_view), second);
  walk.along(rim, second, rim.towards(unit_light));
  walk.along(rim, rim.towards(unit_light), first);
  return walk.points;
}

}  // namespace vex
