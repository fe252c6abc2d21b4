// A triangulated hull of points in a body K about or near the origin, which grows by a point at a time: the surface of
// the expanding polytope algorithm, and which of its faces is the nearest to the origin.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/search/query_error.h"

namespace vex {

namespace detail {

/// A place in an array of faces, and an edge of that face: from corner k to the next one.
struct FaceEdge {
  std::uint32_t face = 0, edge = 0;
};

template <class L>
struct HullFace {
  std::array<std::uint32_t, 3> corners;  // outwards where it turns counter-clockwise
  std::array<FaceEdge, 3> across;        // the other side of the edge from corner k to the next one
  Vec3<L> normal;                        // outwards, of any length
  L offset;                              // of the plane: normal . corner
  L coplanar;                            // what is less above the plane, times the normal's length, is in it
  L distance;  // no point of the triangle is nearer to the origin, by its computed products; of faces that are farther
               // than K reaches in some direction, that reach
  bool is_alive = true;
  bool has_origin_behind = false;  // proven
  std::uint32_t mark = 0;          // of the last search that came by
};

}  // namespace detail

/// Memory that a hull grows in. One serves one query at a time, and then others.
template <class L, class Point>
struct PolytopeStore {
  struct RimEdge {
    std::uint32_t from, to;
    detail::FaceEdge outside;
  };
  std::vector<Point> points;
  std::vector<detail::HullFace<L>> faces;
  std::vector<std::pair<L, std::uint32_t>> heap;  // of distances and faces, the nearest first
  std::vector<std::uint32_t> hidden;
  std::vector<RimEdge> rim;
  struct Step {
    std::uint32_t face, edge, n_left;
  };
  std::vector<Step> path;
  std::vector<std::uint32_t> point_marks;  // of the last rim that passed

  void clear() {
    points.clear();
    faces.clear();
    heap.clear();
    point_marks.clear();
  }
};

/// Rounding may tear it: `grow` then says so. What the hull proves is told by who grows it (expanding_polytope.h).
template <class L, class Point>
class GrowingHull {
 public:
  using Corners = std::array<std::uint32_t, 3>;  // indices of points
  using Face = detail::HullFace<L>;

  GrowingHull(PolytopeStore<L, Point>& store, const QueryError<L>& error)
      : points_(store.points),
        faces_(store.faces),
        heap_(store.heap),
        hidden_(store.hidden),
        rim_(store.rim),
        path_(store.path),
        point_marks_(store.point_marks),
        reach_of_error_(error.reach),
        coplanar_(L(16.0 * unit_roundoff<L>()) * error.reach) {
    store.clear();
  }

  std::uint32_t add_point(const Point& point) {
    points_.push_back(point);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  const Vec3<L>& at(std::uint32_t i) const { return points_[i].w; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// What is less above a plane is in it.
  const L& coplanar() const { return coplanar_; }

  /// K is known to reach no farther than this in some direction: faces that are farther away are never the nearest.
  void set_least_height(const L& height) {
    least_height_ = height;
    has_least_height_ = true;
  }

  void make_tetrahedron(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) {
    if (dot(cross(at(j) - at(i), at(k) - at(i)), at(l) - at(i)) > L(0.0)) std::swap(j, k);
    // l is behind (i, j, k).
    add_face({i, j, k}, {{{3, 0}, {2, 0}, {1, 0}}});
    add_face({i, k, l}, {{{0, 2}, {2, 2}, {3, 1}}});
    add_face({k, j, l}, {{{0, 1}, {3, 2}, {1, 1}}});
    add_face({j, i, l}, {{{0, 0}, {1, 2}, {2, 1}}});
  }

  /// A point that is not above a face that was chosen: of the faces that it is above, the one it is highest above.
  void grow_by_any(std::uint32_t added, const L& least) {
    std::uint32_t best = 0;
    L highest(0.0);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (!faces_[f].is_alive) continue;
      const L height = height_above(faces_[f], added) / norm(faces_[f].normal);
      if (height > highest) {
        highest = height;
        best = f;
      }
    }
    if (highest > least) grow(best, added);
  }

  /// None where all are farther than K reaches: by rounding only.
  std::optional<std::uint32_t> nearest_face() {
    while (!heap_.empty() && !faces_[heap_.front().second].is_alive) {
      std::pop_heap(heap_.begin(), heap_.end(), is_farther);
      heap_.pop_back();
    }
    return heap_.empty() ? std::nullopt : std::optional(heap_.front().second);
  }

  /// Takes a point into the hull: the faces that it is in front of give way to those from their rim to it. False, and
  /// nothing changes, where rounding has torn the rim.
  bool grow(std::uint32_t start, std::uint32_t added) {
    // Faces in whose plane the point is stay: of a cap of many corners all of them would be made again with each new
    // one. Where that tears the rim they go too.
    for (const double side : {1.0, 0.0, -1.0}) {
      hide(start, added, L(side));
      if (!is_one_round()) continue;
      for (const std::uint32_t f : hidden_) faces_[f].is_alive = false;
      const std::uint32_t first = static_cast<std::uint32_t>(faces_.size());
      const std::uint32_t n = static_cast<std::uint32_t>(rim_.size());
      for (std::uint32_t k = 0; k < n; ++k) {
        const auto [from, to, outside] = rim_[k];
        const std::uint32_t next = k + 1 < n ? k + 1 : 0, last = k > 0 ? k - 1 : n - 1;
        add_face({from, to, added}, {{outside, {first + next, 2}, {first + last, 1}}});
        faces_[outside.face].across[outside.edge] = {first + k, 0};
      }
      return true;
    }
    return false;
  }

  /// The face through which the ray from the origin leaves a hull that holds it.
  std::optional<std::uint32_t> face_along(const Vec3<L>& dir) const {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      const Vec3<L>&p = at(face.corners[0]), &q = at(face.corners[1]), &r = at(face.corners[2]);
      if (face.is_alive && dot(cross(p, q), dir) >= L(0.0) && dot(cross(q, r), dir) >= L(0.0) &&
          dot(cross(r, p), dir) >= L(0.0)) {
        return f;
      }
    }
    return std::nullopt;
  }

  /// Of the corners of the face, in proportion: their sum with these is along the normal.
  std::array<L, 3> weights_along(const Face& face, const Vec3<L>& normal) const {
    const Vec3<L>&p = at(face.corners[0]), &q = at(face.corners[1]), &r = at(face.corners[2]);
    return {dot(cross(q, r), normal), dot(cross(r, p), normal), dot(cross(p, q), normal)};
  }

 private:
  using FaceEdge = detail::FaceEdge;
  using Entry = std::pair<L, std::uint32_t>;
  static constexpr auto is_farther = [](const Entry& a, const Entry& b) { return a.first > b.first; };

  // Times the length of its normal.
  L height_above(const Face& face, std::uint32_t point) const { return dot(face.normal, at(point)) - face.offset; }

  std::uint32_t add_face(const Corners& corners, const std::array<FaceEdge, 3>& across) {
    const Vec3<L>&p = at(corners[0]), &q = at(corners[1]), &r = at(corners[2]);
    // e x f = e x g = f x g, and that of the two shorter ones has no noise of the longest.
    const Vec3<L> e = q - p, f = r - p, g = r - q;
    const L square_e = dot(e, e), square_f = dot(f, f), square_g = dot(g, g);
    const bool omits_e = square_e > square_f && square_e > square_g, omits_f = !omits_e && square_f > square_g;
    const std::uint32_t index = static_cast<std::uint32_t>(faces_.size());
    Face& face = faces_.emplace_back();
    face.corners = corners;
    face.across = across;
    face.normal = cross(select<L>(omits_e, f, e), select<L>(omits_e || omits_f, g, f));
    const L product = select(omits_e, square_f, square_e) * select(omits_e || omits_f, square_g, square_f);
    L square = dot(face.normal, face.normal);
    // All but a segment, whose normal would be noise: the direction of its nearest point will do, as any would.
    const L thinnest_sq(0x1p54 * (unit_roundoff<L>() * unit_roundoff<L>()));
    const bool is_sliver = !(square > thinnest_sq * product);
    if (is_sliver) {
      const Vec3<L> nearest = nearest_on_longest_edge(p, q, r);
      face.normal = norm_1(nearest) > L(0.0) ? unit_along(nearest) : least_axis(e);
      square = L(1.0);
    }
    const L of_p = dot(face.normal, p), of_q = dot(face.normal, q), of_r = dot(face.normal, r);
    const L least = -larger(-of_p, larger(-of_q, -of_r));
    face.offset = of_p;
    face.coplanar = coplanar_ * norm_1(face.normal);
    const L rounding_sq = L(1024.0 * (unit_roundoff<L>() * unit_roundoff<L>())) * (reach_of_error_ * reach_of_error_);
    const L least_sq = least > L(0.0) ? least * least : L(0.0);
    face.has_origin_behind = !is_sliver && least_sq > rounding_sq * product;  // E21
    // What is farther than the depth can be is never the nearest, and need not be told apart.
    const L farthest = L(1.0 + 0x1p-40) * least_height_;
    const bool is_far = has_least_height_ && least_sq > (farthest * farthest) * square;
    face.distance = is_far ? least_height_ : least / square_root(square);
    if (!is_far) {
      heap_.push_back({face.distance, index});
      std::push_heap(heap_.begin(), heap_.end(), is_farther);
    }
    return index;
  }
  static Vec3<L> nearest_on_longest_edge(const Vec3<L>& p, const Vec3<L>& q, const Vec3<L>& r) {
    const std::array<std::array<const Vec3<L>*, 2>, 3> edges = {{{&p, &q}, {&q, &r}, {&r, &p}}};
    Vec3<L> nearest = p;
    L longest(-1.0);
    for (const auto& edge : edges) {
      const Vec3<L>&from = *edge[0], &to = *edge[1];
      const Vec3<L> e = to - from;
      const L square = dot(e, e);
      if (!(square > longest)) continue;
      longest = square;
      const L along = -dot(from, e);
      nearest = !(along > L(0.0)) ? from : !(along < square) ? to : from + (along / square) * e;
    }
    return nearest;
  }

  // The connected faces about `start` that `added` is above, and in order their rim, as they go along it. Above: by
  // more than `side` times what counts as coplanar. Depth first, edge by edge counter-clockwise, gives the rim in
  // order.
  void hide(std::uint32_t start, std::uint32_t added, const L& side) {
    hidden_.assign(1, start);
    rim_.clear();
    path_.assign(1, {start, 0, 3});
    ++last_mark_;
    faces_[start].mark = last_mark_;
    while (!path_.empty()) {
      auto& [from, edge, n_left] = path_.back();
      if (n_left == 0) {
        path_.pop_back();
        continue;
      }
      const FaceEdge entered = faces_[from].across[edge];
      edge = (edge + 1) % 3;
      --n_left;
      Face& face = faces_[entered.face];
      if (face.mark == last_mark_) continue;
      if (!(height_above(face, added) > side * face.coplanar)) {
        rim_.push_back({face.corners[(entered.edge + 1) % 3], face.corners[entered.edge], entered});
        continue;
      }
      face.mark = last_mark_;
      hidden_.push_back(entered.face);
      path_.push_back({entered.face, (entered.edge + 1) % 3, 2});
    }
  }

  // A single closed line that passes each of its points once.
  bool is_one_round() {
    const std::size_t n = rim_.size();
    if (n < 3) return false;
    point_marks_.resize(points_.size(), 0);
    for (std::size_t k = 0; k < n; ++k) {
      if (rim_[k].to != rim_[k + 1 < n ? k + 1 : 0].from) return false;
      std::uint32_t& mark = point_marks_[rim_[k].from];
      if (mark == last_mark_) return false;
      mark = last_mark_;
    }
    return true;
  }

  std::vector<Point>& points_;
  std::vector<Face>& faces_;
  std::vector<Entry>& heap_;
  std::vector<std::uint32_t>& hidden_;
  std::vector<typename PolytopeStore<L, Point>::RimEdge>& rim_;
  std::vector<typename PolytopeStore<L, Point>::Step>& path_;
  std::vector<std::uint32_t>& point_marks_;
  L reach_of_error_, coplanar_;
  L least_height_{0.0};
  bool has_least_height_ = false;
  std::uint32_t last_mark_ = 0;
};

}  // namespace vex
