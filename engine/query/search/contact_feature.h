// What of a polytope is across a direction: a face, an edge or a vertex; and the frame in which faces across a contact
// are seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/search/planar_polygon.h"

namespace vex {

// How well a face's corners are known. `of_points`: how far they may be off a line or a plane that they are meant to be
// in, for the roundings of what is computed of them and for those of their coordinates in the bodies' frames. What is
// no farther apart than `of_edges` is no edge, but one corner.
struct ContactResolution {
  double of_points, of_edges;

  ContactResolution(double computed, double given)
      : of_points(std::fmax(computed, given)), of_edges(std::fmax(0x1p20 * computed, 4.0 * given)) {}
  /// Where points, and the normal, are known no better than to `searched`.
  ContactResolution known_to(double searched) const {
    ContactResolution coarser = *this;
    coarser.of_points = std::fmax(of_points, searched);
    coarser.of_edges = std::fmax(of_edges, 64.0 * searched);
    return coarser;
  }
};

/// A point of a body with the number of the feature that it is.
struct NumberedPoint {
  Vec3d at;
  std::uint32_t number;
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

}  // namespace vex
