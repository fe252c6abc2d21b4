// What of a polytope is across a contact: its face there, seen along the normal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/search/contact_patches.h"
#include "engine/query/search/planar_polygon.h"

namespace vex {

// How well a face's corners are known. `of_points`: how far they may be off a line or a plane that they are meant to be
// in, for the roundings of what is computed of them and for those of their coordinates in the bodies' frames. What is
// no farther apart than `of_edges` is no edge, but one corner.
struct ContactResolution {
  double of_points, of_edges;

  ContactResolution(double computed, double given)
      : of_points(std::fmax(computed, given)), of_edges(std::fmax(0x1p20 * computed, 4.0 * given)) {}
};

// A right-handed frame with the normal as its third axis: a place is where a point is across the normal.
struct ContactFrame {
  Vec3d across_x, across_y, normal;

  explicit ContactFrame(const Vec3d& unit_normal) : normal(unit_normal) {
    const Vec3d side = cross(least_axis(normal), normal);
    across_x = (1.0 / norm(side)) * side;
    across_y = cross(normal, across_x);
  }
  Vec3d point(const PlanarPoint& place, double height) const {
    return (place.x * across_x + place.y * across_y) + height * normal;
  }
};

// What of a polytope is within the feature angle of the plane across a direction: a face, an edge or a vertex. From the
// farthest vertex to the edge there that leans least, and about that to the one of its two faces that does.
class ContactFeature {
 public:
  ContactFeature(const std::vector<Vec3d>& vertices, const Vec3d& normal, double feature_angle, double least_extent) {
    const auto height = [&](const Vec3d& v) { return dot(normal, v); };
    top_ = *std::ranges::max_element(vertices, {}, height);
    double best = -HUGE_VAL;
    for (const Vec3d& v : vertices) {
      const Vec3d along = v - top_;
      const double drop = dot(normal, along), extent = norm(along - drop * normal);
      if (extent > least_extent && drop / extent > best) {
        best = drop / extent;
        along_ = (1.0 / norm(along)) * along;
      }
    }
    if (!(best >= -std::tan(feature_angle) - 0x1p-20)) return;
    kind_ = Kind::edge;
    const Vec3d upright = normal - dot(normal, along_) * along_;
    const Vec3d up = (1.0 / norm(upright)) * upright, side = cross(up, along_);
    double leaning = 2.0 * std::sin(0.5 * feature_angle) + 0x1p-20;
    for (const double sign : {-1.0, 1.0}) {
      double slope = -HUGE_VAL;
      for (const Vec3d& v : vertices) {
        const double beside = sign * dot(side, v - top_);
        if (beside > least_extent) slope = std::fmax(slope, dot(up, v - top_) / beside);
      }
      if (slope == -HUGE_VAL) continue;
      const Vec3d across = up - (sign * slope) * side;
      const Vec3d face_normal = (1.0 / norm(across)) * across;
      if (norm(face_normal - normal) > leaning) continue;
      leaning = norm(face_normal - normal);
      kind_ = Kind::face;
      normal_ = face_normal;
    }
  }

  bool is_face() const { return kind_ == Kind::face; }
  /// Of a vertex: from the face's plane, the edge's line, or the farthest vertex.
  double distance_of(const Vec3d& v) const {
    const Vec3d from_top = v - top_;
    if (kind_ == Kind::face) return std::fabs(dot(normal_, from_top));
    if (kind_ == Kind::edge) return norm(from_top - dot(along_, from_top) * along_);
    return norm(from_top);
  }

 private:
  enum class Kind { vertex, edge, face } kind_ = Kind::vertex;
  Vec3d top_, along_, normal_;
};

// The vertices of a core that are near its plane across the normal, seen along this; heights along an outward one.
class ContactFace {
 public:
  ContactFace(const std::vector<Vec3d>& vertices, const ContactFrame& frame, double outward, double feature_angle,
              const ContactResolution& resolution)
      : resolution_(resolution.of_points) {
    std::vector<PlanarPoint> places;
    const auto add = [&](const Vec3d& v) {
      corners_.push_back({{dot(frame.across_x, v), dot(frame.across_y, v)}, outward * dot(frame.normal, v)});
      places.push_back(corners_.back().at);
    };
    const ContactFeature feature(vertices, outward * frame.normal, feature_angle, resolution.of_edges);
    for (const Vec3d& v : vertices) {
      if (!(feature.distance_of(v) > resolution_)) add(v);  // nor where that is no number: there always is a corner
    }
    outline_ = planar_hull(places, resolution_);
    if (!feature.is_face() || outline_.size() < 3) {
      find_outline_corners();
      return;
    }
    // The faces beside it that are within the angle of it.
    const std::vector<PlanarPoint> of_feature = outline_;
    const double slope = std::sin(feature_angle);
    for (const Vec3d& v : vertices) {
      const double below = feature.distance_of(v);
      const PlanarPoint place{dot(frame.across_x, v), dot(frame.across_y, v)};
      // From a corner it is no nearer than from the polygon, and found at once.
      const PlanarPoint from_corner = place - of_feature.front();
      if (!(below > resolution_ && below <= slope * std::hypot(from_corner.x, from_corner.y))) continue;
      if (below <= slope * distance_to(of_feature, place)) add(v);
    }
    outline_ = planar_hull(places, resolution_);
    find_outline_corners();
  }

  const std::vector<PlanarPoint>& outline() const { return outline_; }

  // The greatest height of the corners' hull at a place of the outline, or beside it by rounding.
  double height_at(const PlanarPoint& place) {
    if (outline_.size() == 1) return outline_corners_[0].height;
    if (outline_.size() == 2) {
      const PlanarPoint &from = outline_[0], along = outline_[1] - from;
      const double share = std::clamp(dot(along, place - from) / dot(along, along), 0.0, 1.0);
      return (1.0 - share) * outline_corners_[0].height + share * outline_corners_[1].height;
    }
    if (is_flat_) return triangle_at(place).plane_at(place);
    // Above a corner of the outline there is nothing else.
    const std::size_t side = side_of_fan(place);
    for (const std::size_t k : {std::size_t{0}, side, side + 1}) {
      if (outline_[k].x == place.x && outline_[k].y == place.y) return outline_corners_[k].height;
    }
    Triangle best = highest_known_at(place);
    // Corner by corner upwards, as portals go; each step is higher. First by those near the place, which are nearly
    // enough.
    patches_.look_near(place);
    bool are_near_ones_below = false;
    for (std::size_t step = 0; step < 2 * corners_.size(); ++step) {
      const Corner* const above = are_near_ones_below ? patches_.farthest_above(best.plane(), resolution_)
                                                      : patches_.farthest_near(best.plane(), resolution_);
      if (above == nullptr && are_near_ones_below) break;
      if (above == nullptr) {
        are_near_ones_below = true;
        continue;
      }
      Triangle next;
      for (std::size_t k = 0; k < 3; ++k) {
        next.take_if_better({best.corners[k], best.corners[(k + 1) % 3], *above}, place);
      }
      best = next;
    }
    last_ = best;
    has_last_ = true;
    return best.plane_at(place);
  }

 private:
  using Corner = ContactCorner;
  struct Triangle {
    std::array<Corner, 3> corners{};
    double inside = -HUGE_VAL;

    static double area(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) { return turn(b - a, c - a); }
    std::array<double, 3> weights(const PlanarPoint& place) const {
      const double whole = area(corners[0].at, corners[1].at, corners[2].at);
      const double first = area(place, corners[1].at, corners[2].at) / whole;
      const double second = area(corners[0].at, place, corners[2].at) / whole;
      return {first, second, 1.0 - first - second};
    }
    // The one that the place is farthest inside of.
    void take_if_better(const std::array<Corner, 3>& others, const PlanarPoint& place) {
      Triangle other{others, 0.0};
      if (!(std::fabs(area(others[0].at, others[1].at, others[2].at)) > 0.0)) return;
      const std::array<double, 3> found = other.weights(place);
      other.inside = *std::ranges::min_element(found);
      if (other.inside > inside) *this = other;
    }
    double plane_at(const PlanarPoint& place) const {
      const std::array<double, 3> found = weights(place);
      return (found[0] * corners[0].height + found[1] * corners[1].height) + found[2] * corners[2].height;
    }
    ContactPlane plane() const {
      const Corner& c = corners[0];
      const PlanarPoint p = corners[1].at - c.at, q = corners[2].at - c.at;
      const double whole = turn(p, q);
      const double rise_p = (corners[1].height - c.height) / whole, rise_q = (corners[2].height - c.height) / whole;
      return {c, {q.y * rise_p - p.y * rise_q, p.x * rise_q - q.x * rise_p}};
    }
  };

  // Each place of the outline is a corner's; of corners one above the other, as a prism's seen along its edge, the
  // highest counts.
  void find_outline_corners() {
    std::vector<Corner> sorted = corners_;
    const auto at_x = [](const Corner& corner) { return corner.at.x; };
    std::ranges::sort(sorted, {}, at_x);
    for (const PlanarPoint& place : outline_) {
      const Corner* highest = nullptr;
      for (auto corner = std::ranges::lower_bound(sorted, place.x - resolution_, {}, at_x);
           corner != sorted.end() && corner->at.x <= place.x + resolution_; ++corner) {
        const bool is_here = std::hypot(corner->at.x - place.x, corner->at.y - place.y) <= resolution_;
        if (is_here && (highest == nullptr || corner->height > highest->height)) highest = &*corner;
      }
      outline_corners_.push_back(*highest);
    }
    // Of the largest triangle of a fan: whether all corners are in its plane.
    Triangle largest;
    double most = 0.0;
    for (std::size_t k = 1; k + 1 < outline_corners_.size(); ++k) {
      const Triangle triangle = of_fan(k);
      const double area =
          std::fabs(Triangle::area(triangle.corners[0].at, triangle.corners[1].at, triangle.corners[2].at));
      if (area > most) {
        most = area;
        largest = triangle;
      }
    }
    is_flat_ = most > 0.0 && std::ranges::all_of(corners_, [&](const Corner& corner) {
                 return std::fabs(corner.height - largest.plane_at(corner.at)) <= resolution_;
               });
    if (!is_flat_) patches_ = ContactPatches(corners_);
  }
  Triangle of_fan(std::size_t k) const {
    return {{outline_corners_[0], outline_corners_[k], outline_corners_[k + 1]}, 0.0};
  }

  // What is known to begin with: the outline's triangles, the last place's, for neighbours may share it, and those of
  // its corners with a side of the outline.
  Triangle highest_known_at(const PlanarPoint& place) const {
    Triangle best = triangle_at(place);
    if (!has_last_) return best;
    double highest = best.plane_at(place);
    const auto consider = [&](const std::array<Corner, 3>& corners) {
      Triangle other;
      other.take_if_better(corners, place);
      if (!(other.inside > 0.0) || !(other.plane_at(place) > highest)) return;
      highest = other.plane_at(place);
      best = other;
    };
    consider(last_.corners);
    for (const Corner& corner : last_.corners) {
      const std::size_t side = side_beyond(corner.at, place);
      consider({corner, outline_corners_[side], outline_corners_[(side + 1) % outline_corners_.size()]});
    }
    return best;
  }

  // The side of the outline through which a ray from a place within it through another one goes out.
  std::size_t side_beyond(const PlanarPoint& from, const PlanarPoint& through) const {
    const PlanarPoint first = outline_[0] - from, dir = through - from;
    const bool is_beyond_half = turn(first, dir) < 0.0;
    const auto is_before = [&](const PlanarPoint& corner) {
      const bool is_in_half = turn(first, corner - from) >= 0.0, is_right = turn(corner - from, dir) >= 0.0;
      return is_beyond_half ? is_in_half || is_right : is_in_half && is_right;
    };
    std::size_t side = 0, end = outline_.size();
    while (end - side > 1) {
      const std::size_t middle = side + (end - side) / 2;
      (is_before(outline_[middle]) ? side : end) = middle;
    }
    return side;
  }

  // Of the fan about the first corner: the last one whose first side has the place to its left, or one beside it.
  std::size_t side_of_fan(const PlanarPoint& place) const {
    std::size_t first = 1, end = outline_.size() - 1;
    while (end - first > 1) {
      const std::size_t middle = first + (end - first) / 2;
      (turn(outline_[middle] - outline_[0], place - outline_[0]) >= 0.0 ? first : end) = middle;
    }
    return first;
  }
  Triangle triangle_at(const PlanarPoint& place) const {
    const std::size_t first = side_of_fan(place);
    Triangle best;
    const auto consider = [&](std::size_t k) { best.take_if_better(of_fan(k).corners, place); };
    for (std::size_t k = std::max<std::size_t>(first, 2) - 1; k <= first + 1 && k + 1 < outline_.size(); ++k)
      consider(k);
    for (std::size_t k = 1; best.inside == -HUGE_VAL && k + 1 < outline_.size(); ++k) consider(k);  // all slivers
    return best;
  }

  std::vector<Corner> corners_, outline_corners_;
  bool is_flat_ = false;
  std::vector<PlanarPoint> outline_;
  double resolution_ = 0.0;
  ContactPatches patches_;
  Triangle last_;
  bool has_last_ = false;
};

}  // namespace vex
