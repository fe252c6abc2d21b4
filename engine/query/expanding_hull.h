// The hull of support points of K = A - B, growing where the origin is: the expanding polytope (G. van den Bergen,
// 2001), asked only whether it reaches the origin.
//
// What a portal cannot do, it can: where the origin is on an axis or in a plane of symmetry of K, all support points of
// a portal's search are in one plane with its start, and no tetrahedron of theirs has the origin inside. A hull has
// points on all sides. It costs more, so it comes where the portal has stalled.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "engine/query/portal_refinement.h"

namespace vex {

/// One lane only.
template <class L, class Difference>
class ExpandingHull {
 public:
  enum class End {
    disjoint,  // `separating_dir` separates the bodies
    overlap,   // every face of the hull has the origin behind it by more than the points' error
    stalled,   // the nearest face lies in the surface of K, and is not proven to have the origin behind it
    capped,
    flat,  // K has no volume, to rounding
  };

  using Triangle = std::array<std::size_t, 3>;  // indices of points; outwards where it turns counter-clockwise

  ExpandingHull(const Difference& difference, const QueryError<L>& error) : difference_(difference), error_(error) {}

  End run(int max_support_calls) {
    if (!begin()) return End::flat;
    while (true) {
      if (proves_overlap()) return End::overlap;
      if (points_.size() >= static_cast<std::size_t>(max_support_calls)) return End::capped;
      const Face face = faces_[nearest_face_index()];
      const Vec3<L> dir = scaled_to_unit_exponent(face.plane.normal);
      const std::size_t added = add_support(dir);
      const L value = dot(dir, points_[added]), slack = error_.support * norm_1(dir);
      if (value < -slack) {
        separating_dir_ = dir;
        return End::disjoint;
      }
      // K ends so near to the origin that no face could have the points' error behind it.
      if (value < L(2.0) * slack) return End::stalled;
      if (!(value - dot(dir, points_[face.corners[0]]) > slack) || !grow(added)) return End::stalled;
    }
  }

  const Vec3<L>& separating_dir() const { return separating_dir_; }
  /// What the difference's `support` gave, call by call.
  const std::vector<Vec3<L>>& points() const { return points_; }

  /// Calls `visit(p, q, r)` with the corners of every face: points of K to their error.
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    for (const Face& face : faces_) {
      visit(points_[face.corners[0]], points_[face.corners[1]], points_[face.corners[2]]);
    }
  }

  /// The face through which the ray from the origin leaves a hull that holds it.
  std::optional<Triangle> face_along(const Vec3<L>& dir) const {
    for (const Face& face : faces_) {
      const Vec3<L>&p = points_[face.corners[0]], &q = points_[face.corners[1]], &r = points_[face.corners[2]];
      if (dot(cross(p, q), dir) >= L(0.0) && dot(cross(q, r), dir) >= L(0.0) && dot(cross(r, p), dir) >= L(0.0)) {
        return face.corners;
      }
    }
    return std::nullopt;
  }

 private:
  struct Face {
    Triangle corners;
    detail::Face<L> plane;
    L distance;  // of the plane, positive where the origin is behind it
  };

  std::size_t add_support(const Vec3<L>& dir) {
    points_.push_back(difference_.support(dir));
    return points_.size() - 1;
  }

  Face face_of_points(std::size_t i, std::size_t j, std::size_t k) const {
    const detail::Face<L> plane = detail::face_of(points_[i], points_[j], points_[k]);
    const L length = norm(plane.normal);
    const L height = dot(plane.normal, points_[i]);
    return {{i, j, k}, plane, length > L(0.0) ? height / length : L(0.0)};
  }

  // A tetrahedron of support points, the largest that these directions give; false where it has no volume.
  bool begin() {
    for (const Vec3d& d :
         {Vec3d{1.0, 0.0, 0.0}, Vec3d{-1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, -1.0, 0.0},
          Vec3d{0.0, 0.0, 1.0}, Vec3d{0.0, 0.0, -1.0}, Vec3d{0.61, 0.47, -0.64}, Vec3d{-0.61, -0.47, 0.64}}) {
      add_support(broadcast<L>(d));
    }
    std::size_t first = 0, second = 0, third = 0;
    L largest(0.0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3<L> e = points_[i] - points_[j];
        if (dot(e, e) > largest) {
          largest = dot(e, e);
          first = i;
          second = j;
        }
      }
    }
    if (!(largest > L(0.0))) return false;
    const Vec3<L> along = scaled_to_unit_exponent(points_[second] - points_[first]);
    // Across the longest edge: the points at hand, and those farthest in two directions at right angles to it.
    const Vec3<L> across = scaled_to_unit_exponent(cross(along, least_axis(along)));
    const Vec3<L> other = scaled_to_unit_exponent(cross(along, across));
    for (const Vec3<L>& d : {across, -across, other, -other}) add_support(d);
    largest = L(0.0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3<L> normal = cross(along, points_[i] - points_[first]);
      if (dot(normal, normal) > largest) {
        largest = dot(normal, normal);
        third = i;
      }
    }
    if (!(largest > L(0.0))) return false;
    const Vec3<L> normal = scaled_to_unit_exponent(cross(along, points_[third] - points_[first]));
    const std::size_t above = add_support(normal), below = add_support(-normal);
    const L up = dot(normal, points_[above] - points_[first]);
    const L down = -dot(normal, points_[below] - points_[first]);
    const std::size_t apex = up > down ? above : below;
    if (!(larger(up, down) > L(64.0) * error_.support * norm_1(normal))) return false;
    if (up > down) std::swap(second, third);
    // `apex` is behind the face (first, second, third).
    faces_ = {face_of_points(first, second, third), face_of_points(first, third, apex),
              face_of_points(third, second, apex), face_of_points(second, first, apex)};
    for (std::size_t i = 0; i < apex; ++i) {
      if (i != first && i != second && i != third) grow(i);
    }
    return true;
  }

  static Vec3<L> least_axis(const Vec3<L>& v) {
    const L x = absolute(v.x), y = absolute(v.y), z = absolute(v.z);
    if (x <= y && x <= z) return {L(1.0), L(0.0), L(0.0)};
    return y <= z ? Vec3<L>{L(0.0), L(1.0), L(0.0)} : Vec3<L>{L(0.0), L(0.0), L(1.0)};
  }

  // Takes a point into the hull: the faces that it is in front of give way to those from their rim to it. False where
  // it is in front of none, or where rounding has torn the rim.
  bool grow(std::size_t added) {
    std::vector<L> heights, roundings;
    bool is_outside = false;
    for (const Face& face : faces_) {
      heights.push_back(dot(face.plane.normal, points_[added] - points_[face.corners[0]]));
      roundings.push_back(L(4.0) * error_.support * norm_1(face.plane.normal));
      is_outside = is_outside || heights.back() > roundings.back();
    }
    if (!is_outside) return false;
    // Faces in whose plane the point is had better go too, or it makes faces without area with their edges.
    for (const double side : {-1.0, 0.0, 1.0}) {
      std::vector<Face> hidden, kept;
      for (std::size_t i = 0; i < faces_.size(); ++i) {
        (heights[i] > L(side) * roundings[i] ? hidden : kept).push_back(faces_[i]);
      }
      const std::vector<Edge> rim = rim_of(hidden);
      if (kept.empty() || !is_one_round(rim)) continue;
      for (const Edge& edge : rim) kept.push_back(face_of_points(edge[0], edge[1], added));
      faces_ = std::move(kept);
      return true;
    }
    return false;
  }

  using Edge = std::array<std::size_t, 2>;

  // The edges that only one of the faces has, as that one goes along them.
  static std::vector<Edge> rim_of(const std::vector<Face>& faces) {
    std::vector<Edge> edges;
    for (const Face& face : faces) {
      for (std::size_t k = 0; k < 3; ++k) edges.push_back({face.corners[k], face.corners[(k + 1) % 3]});
    }
    std::ranges::sort(edges);
    std::vector<Edge> rim;
    for (const Edge& edge : edges) {
      if (!std::ranges::binary_search(edges, Edge{edge[1], edge[0]})) rim.push_back(edge);
    }
    return rim;
  }

  // A single closed line that passes each of its points once. `rim` is sorted.
  static bool is_one_round(const std::vector<Edge>& rim) {
    if (rim.size() < 3) return false;
    std::size_t at = rim[0][0], n_steps = 0;
    do {
      const auto next = std::ranges::lower_bound(rim, Edge{at, 0});
      if (next == rim.end() || (*next)[0] != at) return false;
      at = (*next)[1];
      ++n_steps;
    } while (at != rim[0][0] && n_steps <= rim.size());
    return n_steps == rim.size();
  }

  std::size_t nearest_face_index() const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < faces_.size(); ++i) {
      if (faces_[i].distance < faces_[nearest].distance) nearest = i;
    }
    return nearest;
  }

  // A closed surface whose every face has the ball of the points' error behind it goes around that ball (E15). Growing
  // keeps a closed surface closed.
  bool proves_overlap() const {
    return std::ranges::all_of(faces_, [this](const Face& face) {
      return detail::has_origin_behind(face.plane, points_[face.corners[0]], error_);
    });
  }

  const Difference& difference_;
  QueryError<L> error_;
  std::vector<Vec3<L>> points_;
  std::vector<Face> faces_;
  Vec3<L> separating_dir_;
};

}  // namespace vex
