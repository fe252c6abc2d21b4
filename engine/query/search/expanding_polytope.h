// The hull of points of a body K = A - B, growing where its surface is nearest to the origin: the expanding polytope
// algorithm (G. van den Bergen, "Proximity queries and penetration depth computation on 3D game objects", 2001), with
// bounds of the depth on both sides.
//
// Every direction that was asked for bounds the depth from above; the hull's surface, as long as it goes around the
// origin, bounds it from below: both in the presence of rounding (E21). How the hull grows is not proven and need not
// be.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/search/growing_hull.h"
#include "engine/query/search/nearest_simplex.h"
#include "engine/query/search/portal_refinement.h"
#include "engine/query/search/surface_bound.h"
#include "engine/query/search/winding.h"

namespace vex {

/// One lane only.
template <class L, class Point, class Difference>
class ExpandingPolytope {
 public:
  using Corners = std::array<std::uint32_t, 3>;  // indices of points

  enum class End {
    converged,  // the bounds are as near as asked for
    stalled,    // rounding allows no larger hull
    capped,
    flat,       // K has no volume, to rounding: its depth is 0 along `normal`
    separated,  // all of K is behind the origin along `normal`, proven
  };

  ExpandingPolytope(const Difference& difference, const QueryError<L>& error, int max_support_calls,
                    PolytopeStore<L, Point>& store)
      : hull_(store, error),
        difference_(difference),
        error_(error),
        slack_(L(2.0) * error.support),
        max_support_calls_(max_support_calls) {}

  /// From the points of a simplex on. `wanted`: how near the bounds shall be, rounding apart, for a depth.
  template <class Wanted>
  End run(const NearestSimplex<L, Point>& simplex, const Wanted& wanted) {
    const bool has_volume = begin(simplex);
    if (has_height_ && height_ < -slack_) return End::separated;
    return has_volume ? grow_until(wanted) : End::flat;
  }

  /// A point that is known already, as `make()` gives it: one of a surface to begin with.
  template <class Make>
  void add_known(const Make& make) {
    hull_.add_point_of(make);
  }
  /// The same, of the farthest along its direction.
  void add_farthest(const Point& point) { keep_height(hull_.add_point(point), point.dir); }
  /// From a surface of the points that are known on, `corners(k)` for k below n_faces, whatever these are. `stalled`
  /// where they do not go around the origin, proven.
  template <class CornersOf, class Wanted>
  End run_on(std::uint32_t n_faces, const CornersOf& corners, const Wanted& wanted) {
    if (has_height_ && height_ < -slack_) return End::separated;
    const auto n_known = static_cast<std::uint32_t>(points().size());
    const auto at = [this](std::uint32_t i) -> const Vec3<L>& { return hull_.at(i); };
    surface_ = bound_by_surface<L>(n_known, at, n_faces, corners, error_);
    if (surface_) {
      const L distance = surface_->distance;
      if (has_height_ && height_ - distance <= wanted(distance)) return End::converged;
      const Vec3<L> normal = unit_along(surface_->normal);
      const L height = dot(normal, hull_.at(add_support(normal)));
      if (is_near_enough(normal, height, distance, wanted)) return End::converged;
      surface_.reset();
      if (height_ < -slack_) return End::separated;
    }
    return hull_.make_surface(n_known, n_faces, corners) ? grow_until(wanted) : End::stalled;
  }
  /// Whether that surface was as near as asked for as it was, and so has no triangles here.
  bool is_as_known() const { return surface_.has_value(); }

  const std::vector<Point>& points() const { return hull_.points(); }
  /// The farthest along `normal()`.
  const Point& point_along_normal() const { return hull_.points()[is_of_face_ ? hull_.points().size() - 1 : lowest_]; }
  /// Of the triangle that is nearest to the origin.
  const Corners& nearest_corners() const { return faces()[nearest_].corners; }
  /// `visit(corners)` of each triangle.
  template <class Visit>
  void visit_faces(const Visit& visit) const {
    for (const Face& face : faces()) {
      if (face.is_alive) visit(face.corners);
    }
  }

  /// The unit vector along which K reaches least far of all that were asked for, or that of the nearest face if that
  /// shows as much, rounding apart; and how far it reaches, to rounding. Where K is flat: across it.
  const Vec3<L>& normal() const { return normal_; }
  L height() const { return is_of_face_ ? answer_height_ : height_; }
  /// The depth is not above it, rounding included: the least that K reaches in any direction that was asked for.
  L depth_upper() const { return height_ + slack_; }
  /// The depth is not below it, rounding included; negative where nothing is known.
  L depth_lower() const {
    if (surface_) return surface_->distance - slack_;
    if (faces().empty()) return -error_.reach;
    const L distance = -larger(-faces()[nearest_].distance(), -height_) - slack_;
    return distance > L(0.0) && goes_around_origin(hull_, nearest_) ? distance : -error_.reach;
  }
  int n_support_calls() const { return n_support_calls_; }

  /// Where the hull ends along the normal, as a combination of a face's corners: `visit(weight, point)`.
  template <class Visit>
  void visit_foot(const Visit& visit) {
    visit_foot_along(normal_, visit);
  }
  /// The same along any direction.
  template <class Visit>
  void visit_foot_along(const Vec3<L>& dir, const Visit& visit) {
    const bool is_of_plane = is_of_face_ && &dir == &normal_;
    std::uint32_t at = is_of_plane ? nearest_ : hull_.face_along(dir, nearest_).value_or(nearest_);
    std::array<L, 3> weights = hull_.weights_along(faces()[at], dir);
    if (is_of_plane) {
      // Faces in one plane share a foot: it is in one of them, a few steps away.
      for (std::size_t step = 0; step < faces().size(); ++step) {
        const std::optional<std::uint32_t> next = hull_.face_towards(at, weights);
        if (!next) break;
        const bool is_coplanar =
            faces()[*next].distance() - faces()[nearest_].distance() <= L(4.0) * hull_.coplanar() + gap();
        if (!is_coplanar) break;
        at = *next;
        weights = hull_.weights_along(faces()[at], dir);
      }
      // A hull that is known from another pose may bulge: the foot on the nearest face's plane is beside the face then,
      // and the normal leaves the hull, no nearer than that, through another one.
      if (std::ranges::min(weights) < L(-kBesideFace) * std::ranges::max(weights)) {
        at = hull_.face_along(dir, nearest_).value_or(at);
        weights = hull_.weights_along(faces()[at], dir);
      }
    }
    L sum(0.0);
    for (L& weight : weights) sum += weight = larger(weight, L(0.0));
    if (!(sum > L(0.0))) weights = {sum = L(1.0), L(0.0), L(0.0)};  // a sliver
    for (std::size_t k = 0; k < 3; ++k) visit(weights[k] / sum, hull_.points()[faces()[at].corners[k]]);
  }

  /// The corners of the face through which the ray from the origin leaves a hull that holds it.
  std::optional<Corners> corners_along(const Vec3<L>& dir) {
    const std::optional<std::uint32_t> face = hull_.face_along(dir, nearest_);
    return face ? std::optional(faces()[*face].corners) : std::nullopt;
  }

 private:
  static constexpr double kBesideFace = 1e-9;  // of a foot's weights: more than rounding
  using Face = detail::HullFace<L>;

  const std::vector<Face>& faces() const { return hull_.faces(); }

  L gap() const { return larger(answer_height_ - faces()[nearest_].distance(), L(0.0)); }

  // Once K has been asked for along the nearest face's normal. That is the answer, unless another direction bounds the
  // depth clearly better.
  template <class Wanted>
  bool is_near_enough(const Vec3<L>& normal, const L& height, const L& distance, const Wanted& wanted) {
    const L most = wanted(distance);
    if (height - distance <= most && height - height_ <= slack_) {
      is_of_face_ = true;
      normal_ = normal;
      answer_height_ = height;
    }
    return height_ - distance <= most;
  }

  template <class Wanted>
  End grow_until(const Wanted& wanted) {
    while (true) {
      const std::optional<std::uint32_t> found = hull_.nearest_face();
      if (!found) return End::stalled;
      nearest_ = *found;
      const L distance = faces()[nearest_].distance();
      const Vec3<L> normal = unit_along(faces()[nearest_].normal);
      const std::uint32_t added = add_support(normal);
      const L height = dot(normal, at(added));
      if (is_near_enough(normal, height, distance, wanted)) return End::converged;
      if (goes_round(added)) return End::stalled;
      if (static_cast<int>(hull_.points().size()) >= max_support_calls_) return End::capped;
      if (!hull_.grow(nearest_, added)) return End::stalled;
      if (height_ < -slack_) return End::separated;
    }
  }

  // Also keeps the least height.
  std::uint32_t add_support(const Vec3<L>& dir) {
    ++n_support_calls_;
    return keep_height(hull_.add_point_of([&] { return difference_.support(dir); }), dir);
  }
  std::uint32_t keep_height(std::uint32_t added, const Vec3<L>& dir) {
    const L height = dot(dir, at(added));
    if (!has_height_ || height < height_) {
      has_height_ = true;
      height_ = height;
      normal_ = dir;
      lowest_ = added;
      hull_.set_least_height(height);
    }
    return added;
  }
  const Vec3<L>& at(std::uint32_t i) const { return hull_.at(i); }

  // A corner of the nearest face is not beyond it but by rounding: a polytope has no point there. Nor will a hull of
  // few points that are taken in again and again, each of them hiding another, ever be convex.
  bool goes_round(std::uint32_t added) {
    bool is_at_corner = false;
    for (const std::uint32_t corner : faces()[nearest_].corners) is_at_corner |= hull_.is_same(corner, added);
    if (is_at_corner) return true;
    constexpr std::uint32_t kLong = 48, kLast = 32;
    constexpr int kMostRepeated = 8;
    if (added < kLong) return false;
    for (std::uint32_t i = added - kLast; i < added; ++i) {
      if (hull_.is_same(i, added)) return ++n_repeated_ > kMostRepeated;
    }
    return false;
  }

  // --- the first tetrahedron

  // Of the simplex, where it has volume; else of these points and of more in directions that span space.
  bool begin(const NearestSimplex<L, Point>& simplex) {
    for (int k = 0; k < simplex.size(); ++k) hull_.add_point(simplex.point(k));
    if (hull_.points().size() == 4 && has_volume(0, 1, 2, 3)) {
      hull_.make_tetrahedron(0, 1, 2, 3);
      return true;
    }
    for (const Vec3d& d : {Vec3d{0.6113, 0.4717, 0.6361}, Vec3d{-0.6113, -0.4717, -0.6361}})
      add_support(unit_along(broadcast<L>(d)));
    std::uint32_t first = 0, second = 0, third = 0;
    const auto find_longest = [&] {
      L largest(0.0);
      for (std::uint32_t i = 0; i < hull_.points().size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          const Vec3<L> e = at(i) - at(j);
          if (dot(e, e) > largest) {
            largest = dot(e, e);
            first = i;
            second = j;
          }
        }
      }
      return largest;
    };
    const L least_length = L(4.0) * slack_;
    L longest = find_longest();
    if (!(longest > least_length * least_length)) {
      for (const Vec3d& d : {Vec3d{1.0, 0.0, 0.0}, Vec3d{-1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, -1.0, 0.0},
                             Vec3d{0.0, 0.0, 1.0}, Vec3d{0.0, 0.0, -1.0}}) {
        add_support(broadcast<L>(d));
      }
      longest = find_longest();
      if (!(longest > least_length * least_length)) return false;  // a point: all directions are as good
    }
    const Vec3<L> along = unit_along(at(second) - at(first));
    const Vec3<L> across = unit_along(cross(along, least_axis(along))), other = cross(along, across);
    const auto off_line = [&](std::uint32_t i) {
      const Vec3<L> normal = cross(along, at(i) - at(first));
      return dot(normal, normal);
    };
    const auto find_third = [&] {
      L largest(0.0);
      for (std::uint32_t i = 0; i < hull_.points().size(); ++i) {
        if (off_line(i) > largest) {
          largest = off_line(i);
          third = i;
        }
      }
      return largest;
    };
    if (!(find_third() > L(0x1p-10) * longest)) {
      for (const Vec3<L>& d : {across, -across, other, -other}) add_support(d);
      if (!(find_third() > least_length * least_length)) return false;  // a segment: `normal` is across it
    }
    const Vec3<L> normal = unit_along(cross(along, at(third) - at(first)));
    const std::uint32_t above = add_support(normal), below = add_support(-normal);
    const L up = dot(normal, at(above) - at(first)), down = -dot(normal, at(below) - at(first));
    const std::uint32_t apex = up > down ? above : below;
    if (!(larger(up, down) > least_length)) return false;  // in a plane: one of its normals is `normal`
    hull_.make_tetrahedron(first, second, third, apex);
    for (std::uint32_t i = 0; i < apex; ++i) {
      if (i != first && i != second && i != third) hull_.grow_by_any(i, L(4.0) * slack_);
    }
    hull_.grow_by_any(apex == above ? below : above, L(4.0) * slack_);
    return true;
  }

  bool has_volume(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) const {
    const detail::Face<L> face = detail::face_of(at(i), at(j), at(k));
    const L volume = absolute(dot(face.normal, at(l) - at(i)));
    return volume > L(16.0) * slack_ * face.edge_product &&
           norm_1(face.normal) > L(0x1p33 * unit_roundoff<L>()) * face.edge_product;
  }

  GrowingHull<L, Point> hull_;
  const Difference& difference_;
  QueryError<L> error_;
  L slack_;
  int max_support_calls_;
  int n_support_calls_ = 0, n_repeated_ = 0;
  std::optional<SurfaceBound<L>> surface_;
  std::uint32_t nearest_ = 0, lowest_ = 0;
  bool is_of_face_ = false, has_height_ = false;
  Vec3<L> normal_;
  L height_{0.0}, answer_height_{0.0};
};

}  // namespace vex
