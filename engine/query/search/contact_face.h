// A body's face across a contact, seen along the normal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/query/feature_id.h"
#include "engine/query/search/contact_feature.h"
#include "engine/query/search/contact_patches.h"
#include "engine/query/search/planar_polygon.h"

namespace vex {

// What of a body is across a contact, seen along the normal: corners with heights along an outward normal, and the
// outline about them. It keeps its memory from one contact to the next.
class ContactFace {
 public:
  /// Of the vertices of a core, those near its plane across the normal. Any vector of vertices but an empty one.
  void take_vertices(const std::vector<Vec3d>& vertices, const ContactFrame& frame, double outward,
                     double feature_angle, const ContactResolution& resolution, PlanarMemory& memory) {
    clear(resolution);
    const ContactFeature feature(vertices, outward * frame.normal, feature_angle, resolution.of_edges);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      // Nor where that is no number: there always is a corner.
      if (!(feature.distance_of(vertices[k]) > resolution_)) add(vertices[k], k, frame, outward);
    }
    planar_hull(places_, resolution_, memory, outline_);
    if (!feature.is_face() || outline_.size() < 3) {
      find_outline_corners();
      return;
    }
    // The faces beside it that are within the angle of it.
    of_feature_ = outline_;
    const double slope = std::sin(feature_angle);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Vec3d& v = vertices[k];
      const double below = feature.distance_of(v);
      const PlanarPoint place{dot(frame.across_x, v), dot(frame.across_y, v)};
      // From a corner it is no nearer than from the polygon, and found at once.
      const PlanarPoint from_corner = place - of_feature_.front();
      if (!(below > resolution_ && below <= slope * std::hypot(from_corner.x, from_corner.y))) continue;
      if (below <= slope * distance_to(of_feature_, place)) add(v, k, frame, outward);
    }
    planar_hull(places_, resolution_, memory, outline_);
    find_outline_corners();
  }

  /// Of points that are known to be the face's corners, or in it; one or more.
  void take_corners(const std::vector<NumberedPoint>& corners, const ContactFrame& frame, double outward,
                    const ContactResolution& resolution, PlanarMemory& memory) {
    clear(resolution);
    for (const NumberedPoint& corner : corners) add(corner.at, corner.number, frame, outward);
    planar_hull(places_, resolution_, memory, outline_);
    find_outline_corners();
  }

  const std::vector<PlanarPoint>& outline() const { return outline_; }

  // The feature of the body that is at a place of the outline, or within `near` of the length of the side there: a
  // vertex, an edge, or the face.
  FeatureId feature_at(const PlanarPoint& place, double near) const {
    const std::size_t n = outline_.size();
    if (n == 1) return feature_of_vertex(outline_corners_[0].number);
    const std::size_t side = n == 2 ? 0 : side_beyond(middle_, place);
    const ContactCorner &from = outline_corners_[side], &to = outline_corners_[(side + 1) % n];
    const PlanarPoint along = to.at - from.at;
    const double length = std::sqrt(dot(along, along)), most = std::fmax(near * length, 4.0 * resolution_);
    const auto distance_from = [&](const ContactCorner& corner) {
      const PlanarPoint off = place - corner.at;
      return std::sqrt(dot(off, off));
    };
    const double off_from = distance_from(from), off_to = distance_from(to);
    if (std::fmin(off_from, off_to) <= most) return feature_of_vertex((off_from <= off_to ? from : to).number);
    if (n == 2 || turn(along, place - from.at) <= most * length) return feature_of_edge(from.number, to.number);
    return feature_of_face(least_number_);
  }

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
    patches_.look_near(place);
    Triangle best = highest_known_at(place);
    // Corner by corner upwards, as portals go. First by those near the place, which are nearly enough. Above a corner
    // or an edge there is nothing to gain, and to rounding its triangles would take turns for ever.
    constexpr int kMostWithoutGain = 8;
    bool are_near_ones_below = false;
    double height = best.plane_at(place);
    for (int n_without_gain = 0; n_without_gain < kMostWithoutGain;) {
      const Corner* above = nullptr;
      if (!are_near_ones_below) above = patches_.farthest_near(best.plane(), resolution_);
      are_near_ones_below = above == nullptr;
      if (are_near_ones_below) above = patches_.farthest_above(best.plane(), resolution_);
      if (above == nullptr) break;
      Triangle next;
      for (std::size_t k = 0; k < 3; ++k) {
        next.take_if_better({best.corners[k], best.corners[(k + 1) % 3], *above}, place);
      }
      best = next;
      const double next_height = best.plane_at(place);
      n_without_gain = next_height > height ? 0 : n_without_gain + 1;
      height = std::fmax(height, next_height);
    }
    last_ = best;
    has_last_ = true;
    return height;
  }

 private:
  using Corner = ContactCorner;

  void clear(const ContactResolution& resolution) {
    resolution_ = resolution.of_points;
    corners_.clear();
    outline_corners_.clear();
    places_.clear();
    has_last_ = false;
    is_flat_ = false;
  }
  void add(const Vec3d& v, std::size_t number, const ContactFrame& frame, double outward) {
    corners_.push_back({{dot(frame.across_x, v), dot(frame.across_y, v)},
                        outward * dot(frame.normal, v),
                        static_cast<std::uint32_t>(number)});
    places_.push_back(corners_.back().at);
  }

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
    std::vector<Corner>& sorted = sorted_;
    sorted = corners_;
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
    if (!is_flat_) patches_.take(corners_);
    PlanarPoint sum;
    least_number_ = outline_corners_.front().number;
    for (const Corner& corner : outline_corners_) {
      sum = sum + corner.at;
      least_number_ = std::min(least_number_, corner.number);
    }
    middle_ = (1.0 / static_cast<double>(outline_corners_.size())) * sum;
  }
  Triangle of_fan(std::size_t k) const {
    return {{outline_corners_[0], outline_corners_[k], outline_corners_[k + 1]}, 0.0};
  }

  // What is known to begin with: the outline's triangles, and what a walk from the last place's comes to, for
  // neighbours share one or are a few apart: over the side that the place is beyond, to the corner near it that leaves
  // all others below, as hulls are wrapped.
  Triangle highest_known_at(const PlanarPoint& place) const {
    constexpr int kMostSteps = 12;
    constexpr double kBeside = 0x1p-30;  // places on a side of the outline are beside it by rounding
    const Triangle best = triangle_at(place);
    if (!has_last_) return best;
    Triangle next = last_;
    for (int step = 0; step < kMostSteps; ++step) {
      const std::array<double, 3> inside = next.weights(place);
      const std::size_t behind = static_cast<std::size_t>(std::ranges::min_element(inside) - inside.begin());
      next.inside = inside[behind];
      if (next.inside > -kBeside) return next.plane_at(place) > best.plane_at(place) ? next : best;
      const Corner &from = next.corners[(behind + 1) % 3], &to = next.corners[(behind + 2) % 3];
      const PlanarPoint along = to.at - from.at;
      const double side = turn(along, next.corners[behind].at - from.at) > 0.0 ? 1.0 : -1.0;
      const PlanarPoint beyond = (side / std::sqrt(dot(along, along))) * PlanarPoint{along.y, -along.x};
      const Corner* const corner = patches_.least_below(next.plane(), from.at, beyond, resolution_);
      if (corner == nullptr) return best;
      next.corners = {from, to, *corner};
    }
    return best;
  }

  // The side of the outline through which a ray from a place within it through another one goes out.
  std::size_t side_beyond(const PlanarPoint& from, const PlanarPoint& through) const {
    const PlanarPoint first = outline_[0] - from, dir = through - from;
    const bool is_beyond_half = turn(first, dir) < 0.0;
    const auto is_before = [&](const PlanarPoint& corner) {
      const PlanarPoint off = corner - from;
      const bool is_in_half = turn(first, off) >= 0.0;
      // Of one that is about opposite, rounding leaves open on which side it is; but it is about `first`, or opposite
      // that.
      const bool is_right = dot(off, dir) < 0.0 ? (dot(first, off) > 0.0) != is_beyond_half : turn(off, dir) >= 0.0;
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

  std::vector<Corner> corners_, outline_corners_, sorted_;
  bool is_flat_ = false;
  std::vector<PlanarPoint> outline_, places_, of_feature_;
  PlanarPoint middle_;
  std::uint32_t least_number_ = 0;
  double resolution_ = 0.0;
  ContactPatches patches_;
  Triangle last_;
  bool has_last_ = false;
};

}  // namespace vex
