// Convex polygons in a plane that may be segments or points: hulls, and what two of them have in common.
#pragma once

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

/// The corners of the hull of one or more points, counter-clockwise; of points that are on a line to within
/// `resolution`, a length, the two ends, and one where these are as near to each other. Corners are as far off the line
/// of their neighbours.
std::vector<PlanarPoint> planar_hull(std::vector<PlanarPoint> points, double resolution);

/// The part of `subject` that is in `clip`, side by side (I. Sutherland, G. Hodgman, 1974); what is within `resolution`
/// of it is in it. Hulls both; `clip` has three corners or more.
std::vector<PlanarPoint> clipped(const std::vector<PlanarPoint>& subject, const std::vector<PlanarPoint>& clip,
                                 double resolution);

/// From a convex polygon of three corners or more, counter-clockwise, to a point; 0 inside.
double distance_to(const std::vector<PlanarPoint>& polygon, const PlanarPoint& point);

}  // namespace vex
