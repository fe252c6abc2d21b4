// Convex polygons in a plane that may be segments or points: hulls, and what two of them have in common.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace vex {

struct PlanarPoint {
  double x = 0.0, y = 0.0;
};

inline PlanarPoint operator+(const PlanarPoint& a, const PlanarPoint& b) { return {a.x + b.x, a.y + b.y}; }
inline PlanarPoint operator-(const PlanarPoint& a, const PlanarPoint& b) { return {a.x - b.x, a.y - b.y}; }
inline PlanarPoint operator*(double s, const PlanarPoint& a) { return {s * a.x, s * a.y}; }
inline double dot(const PlanarPoint& a, const PlanarPoint& b) { return a.x * b.x + a.y * b.y; }
/// Twice the area of the triangle of a, b and the origin, positive where they turn counter-clockwise.
inline double turn(const PlanarPoint& a, const PlanarPoint& b) { return a.x * b.y - a.y * b.x; }

/// A side of a polygon that clips: how far a place is to the left of it.
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

/// A polygon of many corners, some after the other in a box: sides of which a box is to the left are not asked for its
/// corners, so that a polygon clips another in a time that grows with little more than the number of their corners. It
/// keeps its memory.
class BoxedPolygon {
 public:
  static constexpr std::size_t kMany = 64;

  void take(const std::vector<PlanarPoint>& corners);
  std::size_t size() const { return size_; }
  void corners(std::vector<PlanarPoint>& all) const;
  void clip(const ClippingSide& side);

 private:
  static constexpr std::size_t kOfBox = 24;

  struct Box {
    std::vector<PlanarPoint> corners;
    PlanarPoint least, most;

    void bound();
    bool is_left_of(const ClippingSide& side) const;
  };

  std::vector<Box> boxes_;
  std::size_t n_boxes_ = 0, size_ = 0;
  std::vector<PlanarPoint> kept_;
};

/// What hulls and clips work in. They keep its memory, so that a caller who keeps it has nothing allocated.
struct PlanarMemory {
  std::vector<PlanarPoint> sorted, merged;
  std::vector<ClippingSide> sides;
  BoxedPolygon boxed;
};

/// The corners of the hull of one or more points, counter-clockwise; of points that are on a line to within
/// `resolution`, a length, the two ends, and one where these are as near to each other. Corners are as far off the line
/// of their neighbours.
void planar_hull(const std::vector<PlanarPoint>& points, double resolution, PlanarMemory& memory,
                 std::vector<PlanarPoint>& hull);

/// The part of `subject` that is in `clip`, side by side (I. Sutherland, G. Hodgman, 1974); what is within `resolution`
/// of it is in it. Hulls both; `clip` has three corners or more.
void clipped(const std::vector<PlanarPoint>& subject, const std::vector<PlanarPoint>& clip, double resolution,
             PlanarMemory& memory, std::vector<PlanarPoint>& part);

/// From a convex polygon of three corners or more, counter-clockwise, to a point; 0 inside.
double distance_to(const std::vector<PlanarPoint>& polygon, const PlanarPoint& point);

}  // namespace vex
