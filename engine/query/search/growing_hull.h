// A triangulated hull of points in a body K about or near the origin, which grows by a point at a time: the surface of
// the expanding polytope algorithm, and which of its faces is the nearest to the origin.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/search/hull_face.h"
#include "engine/query/search/query_error.h"
#include "engine/query/search/surface_bound.h"

namespace vex {

/// Rounding may tear it: `grow` then says so. What the hull proves is told by who grows it (expanding_polytope.h).
template <class L, class Point>
class GrowingHull {
 public:
  using Corners = std::array<std::uint32_t, 3>;  // indices of points
  using Face = detail::HullFace<L>;

  GrowingHull(PolytopeStore<L, Point>& store, const QueryError<L>& error)
      : points_(store.points),
        faces_(store.faces),
        near_(store.near),
        hidden_(store.hidden),
        rim_(store.rim),
        path_(store.path),
        point_marks_(store.point_marks),
        coplanar_(L(16.0 * unit_roundoff<L>()) * error.reach),
        rounding_sq_(L(1024.0 * (unit_roundoff<L>() * unit_roundoff<L>())) * (error.reach * error.reach)) {
    store.clear();
  }

  std::uint32_t add_point(const Point& point) {
    points_.push_back(point);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  /// The point that `make()` gives, made where it stays: of one that is written by coordinates and then copied by
  /// registers the copy waits for the coordinates to reach the cache.
  template <class Make>
  std::uint32_t add_point_of(const Make& make) {
    struct Made {
      const Make& make;
      operator Point() const { return make(); }
    };
    points_.emplace_back(Made{make});
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  const Vec3<L>& at(std::uint32_t i) const { return points_[i].w; }
  /// Whether two points are one, found without a jump: which of their coordinates is larger nothing foretells.
  bool is_same(std::uint32_t i, std::uint32_t j) const {
    const Vec3<L>&p = at(i), &q = at(j);
    return !((p.x < q.x) | (q.x < p.x) | (p.y < q.y) | (q.y < p.y) | (p.z < q.z) | (q.z < p.z));
  }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// What is less above a plane is in it.
  const L& coplanar() const { return coplanar_; }

  /// K is known to reach no farther than this in some direction: faces that are farther away are never the nearest.
  void set_least_height(const L& height) {
    least_height_ = height;
    has_least_height_ = true;
    const L farthest = L(1.0 + 0x1p-40) * height;
    farthest_sq_ = farthest * farthest;
  }

  void make_tetrahedron(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) {
    if (dot(cross(at(j) - at(i), at(k) - at(i)), at(l) - at(i)) > L(0.0)) std::swap(j, k);
    // l is behind (i, j, k).
    add_face({i, j, k}, {{{3, 0}, {2, 0}, {1, 0}}});
    add_face({i, k, l}, {{{0, 2}, {2, 2}, {3, 1}}});
    add_face({k, j, l}, {{{0, 1}, {3, 2}, {1, 1}}});
    add_face({j, i, l}, {{{0, 0}, {1, 2}, {2, 1}}});
  }

  /// Faces about the origin, of the first n_points: `corners(k)` for k below n_faces, whatever they are. Corners of a
  /// face that are one point are taken for one. False, and the hull is of no use, where that makes no closed surface,
  /// or where the origin is not behind each of its faces, proven.
  template <class CornersOf>
  bool make_surface(std::uint32_t n_points, std::uint32_t n_faces, const CornersOf& corners) {
    if (n_points > kMostSurfaceCorners) return false;
    std::array<std::uint32_t, kMostSurfaceCorners> same;
    for (std::uint32_t i = 0; i < n_points; ++i) same[i] = i;
    const auto first_same = [&same](std::uint32_t i) {
      while (same[i] != i) i = same[i];
      return i;
    };
    for (std::uint32_t f = 0; f < n_faces; ++f) {
      const Corners of = corners(f);
      if (std::max({of[0], of[1], of[2]}) >= n_points) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!is_same(of[k], of[kNext[k]])) continue;
        const std::uint32_t i = first_same(of[k]), j = first_same(of[kNext[k]]);
        same[std::max(i, j)] = std::min(i, j);
      }
    }
    SurfaceEdges edges(n_points);
    is_linked_ = false;
    for (std::uint32_t f = 0; f < n_faces; ++f) {
      Corners of = corners(f);
      for (std::uint32_t& corner : of) corner = first_same(corner);
      if (of[0] == of[1] || of[1] == of[2] || of[2] == of[0]) continue;
      if (!edges.add(of)) return false;
      if (!faces_[add_face(of, {FaceEdge(0, 0), FaceEdge(0, 0), FaceEdge(0, 0)})].has_origin_behind) return false;
    }
    return !faces_.empty() && edges.are_closed();
  }
  /// Has the faces of a surface that was made at once know each other.
  void link() {
    if (is_linked_) return;
    is_linked_ = true;
    std::array<std::array<std::uint16_t, kMostSurfaceCorners>, kMostSurfaceCorners>
        of_edge;  // read where it was written, for it is closed
    for (std::uint16_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        of_edge[faces_[f].corners[k]][faces_[f].corners[kNext[k]]] = static_cast<std::uint16_t>(4 * f + k);
      }
    }
    for (Face& face : faces_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = of_edge[face.corners[kNext[k]]][face.corners[k]];
        face.across[k] = FaceEdge(other / 4, other % 4);
      }
    }
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
    if (is_heap_ || n_near_ > kFew) return nearest_of_many();
    // Few faces are nearer than K is known to reach: to look at all of them, without a branch, costs less than a heap.
    // The least distance first, then whose it is: chosen together the one waits for the other.
    std::size_t n = 0;
    L least(HUGE_VAL);
    for (std::size_t k = 0; k < n_near_; ++k) {
      const Entry entry = near_[k];
      near_[n] = entry;
      const bool is_alive = faces_[entry.second].is_alive;
      least = smaller(blend(is_alive, entry.first, L(HUGE_VAL)), least);
      n += is_alive ? 1 : 0;
    }
    n_near_ = n;
    std::uint64_t are_least = 0;
    for (std::size_t k = 0; k < n; ++k) are_least |= std::uint64_t{near_[k].first <= least} << k;
    if (are_least == 0) return std::nullopt;
    return near_[static_cast<std::size_t>(std::countr_zero(are_least))].second;
  }

  /// Takes a point into the hull: the faces that it is in front of give way to those from their rim to it. False, and
  /// nothing changes, where rounding has torn the rim.
  bool grow(std::uint32_t start, std::uint32_t added) {
    link();
    // Faces in whose plane the point is stay: of a cap of many corners all of them would be made again with each new
    // one. Where that tears the rim they go too.
    for (const double side : {1.0, 0.0, -1.0}) {
      hide(start, added, L(side));
      if (!is_one_round()) continue;
      for (std::size_t k = 0; k < n_hidden_; ++k) faces_[hidden_[k]].is_alive = false;
      const std::uint32_t first = static_cast<std::uint32_t>(faces_.size());
      const std::uint32_t n = static_cast<std::uint32_t>(n_rim_);
      for (std::uint32_t k = 0; k < n; ++k) {
        const auto [from, to, outside] = rim_[k];
        const std::uint32_t next = k + 1 < n ? k + 1 : 0, last = k > 0 ? k - 1 : n - 1;
        add_face({from, to, added}, {{outside, {first + next, 2}, {first + last, 1}}});
        faces_[outside.face()].across[outside.edge()] = {first + k, 0};
      }
      return true;
    }
    return false;
  }

  /// The face across the edge that a ray is farthest beyond, by its weights on this face; none where it passes that.
  std::optional<std::uint32_t> face_towards(std::uint32_t face, const std::array<L, 3>& weights) {
    const std::size_t least = static_cast<std::size_t>(std::ranges::min_element(weights) - weights.begin());
    if (!(weights[least] < L(0.0))) return std::nullopt;
    link();
    return faces_[face].across[kNext[least]].face();  // from that corner
  }

  /// The face through which the ray from the origin leaves a hull that holds it. From `start` on, face by face towards
  /// it; of a hull that bulges that may go round, and all faces are looked at.
  std::optional<std::uint32_t> face_along(const Vec3<L>& dir, std::uint32_t start) {
    constexpr int kMostSteps = 64;
    for (int step = 0; step < kMostSteps; ++step) {
      const std::optional<std::uint32_t> next = face_towards(start, weights_along(faces_[start], dir));
      if (!next) return start;
      start = *next;
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].is_alive && std::ranges::min(weights_along(faces_[f], dir)) >= L(0.0)) return f;
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
  static constexpr std::array<std::uint32_t, 3> kNext = {1, 2, 0};
  static constexpr std::size_t kFew = 64;

  auto end_of_near() { return near_.begin() + static_cast<std::ptrdiff_t>(n_near_); }
  std::optional<std::uint32_t> nearest_of_many() {
    if (!is_heap_) std::make_heap(near_.begin(), end_of_near(), is_farther);
    is_heap_ = true;
    while (n_near_ > 0 && !faces_[near_.front().second].is_alive) {
      std::pop_heap(near_.begin(), end_of_near(), is_farther);
      --n_near_;
    }
    return n_near_ == 0 ? std::nullopt : std::optional(near_.front().second);
  }

  // Times the length of its normal.
  L height_above(const Face& face, std::uint32_t point) const { return dot(face.normal, at(point)) - face.offset; }

  // In line, for its arguments are made where it is called: a call has them written and read again.
  [[gnu::always_inline]] std::uint32_t add_face(const Corners& corners, const std::array<FaceEdge, 3>& across) {
    const Vec3<L>&p = at(corners[0]), &q = at(corners[1]), &r = at(corners[2]);
    // e x f = e x g = f x g, and that of the two shorter ones, from the corner that they share, has no noise of the
    // longest. Chosen without a branch: no guess at it would be good.
    const Vec3<L> e = q - p, f = r - p, g = r - q;
    const L square_e = dot(e, e), square_f = dot(f, f), square_g = dot(g, g);
    const bool omits_e = (square_e > square_f) & (square_e > square_g);
    const bool omits_f = !omits_e & (square_f > square_g);
    Vec3<L> normal = cross(blend(omits_e, f, e), blend(omits_e | omits_f, g, f));
    const L product = smaller(square_e, square_f) * smaller(larger(square_e, square_f), square_g);
    L square = dot(normal, normal);
    // All but a segment, whose normal would be noise: the direction of its nearest point will do, as any would.
    const L thinnest_sq(0x1p54 * (unit_roundoff<L>() * unit_roundoff<L>()));
    const bool is_sliver = !(square > thinnest_sq * product);
    if (is_sliver) [[unlikely]] {
      const Vec3<L> nearest = detail::nearest_on_longest_edge(p, q, r);
      normal = norm_1(nearest) > L(0.0) ? unit_along(nearest) : least_axis(e);
      square = L(1.0);
    }
    const L of_p = dot(normal, p), of_q = dot(normal, q), of_r = dot(normal, r);
    const L least = smaller(smaller(of_p, of_q), of_r);
    const L least_sq = larger(least, L(0.0)) * larger(least, L(0.0));
    // What is farther than the depth can be is never the nearest, and need not be told apart.
    const bool is_far = has_least_height_ & (least_sq > farthest_sq_ * square);
    const L nearness = absolute(least) * (least / square);  // by such steps, which neither of them overflows
    const bool has_origin_behind = !is_sliver & (least_sq > rounding_sq_ * product);  // E21
    const std::uint32_t index = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back({corners, across, normal, of_p, coplanar_ * norm_1(normal), nearness, 0, true, has_origin_behind});
    if (near_.size() <= n_near_) near_.resize(2 * n_near_ + 16);
    near_[n_near_] = {nearness, index};
    n_near_ += std::size_t{!is_far};
    if (is_heap_) [[unlikely]] {
      if (!is_far) std::push_heap(near_.begin(), end_of_near(), is_farther);
    }
    return index;
  }
  // The connected faces about `start` that `added` is above, and in order their rim, as they go along it. Above: by
  // more than `side` times what counts as coplanar. Depth first, edge by edge counter-clockwise, gives the rim in
  // order.
  void hide(std::uint32_t start, std::uint32_t added, const L& side) {
    // Each face is entered once at most.
    if (path_.size() <= faces_.size()) {
      path_.resize(2 * faces_.size() + 64);
      hidden_.resize(path_.size());
      rim_.resize(3 * path_.size());
    }
    ++last_mark_;
    faces_[start].mark = last_mark_;
    hidden_[0] = start;
    n_hidden_ = 1;
    n_rim_ = 0;
    auto* step = path_.data();
    *step = {start, 0, 3};
    while (true) {
      if (step->n_left == 0) {
        if (step == path_.data()) return;
        --step;
        continue;
      }
      const FaceEdge entered = faces_[step->face].across[step->edge];
      step->edge = kNext[step->edge];
      --step->n_left;
      Face& face = faces_[entered.face()];
      if (face.mark == last_mark_) continue;
      const std::uint32_t next = kNext[entered.edge()];
      if (!(height_above(face, added) > side * face.coplanar)) {
        rim_[n_rim_++] = {face.corners[next], face.corners[entered.edge()], entered};
        continue;
      }
      face.mark = last_mark_;
      hidden_[n_hidden_++] = entered.face();
      *++step = {entered.face(), next, 2};
    }
  }

  // A single closed line that passes each of its points once.
  bool is_one_round() {
    const std::size_t n = n_rim_;
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
  std::vector<Entry>& near_;
  std::vector<std::uint32_t>& hidden_;
  std::vector<typename PolytopeStore<L, Point>::RimEdge>& rim_;
  std::vector<typename PolytopeStore<L, Point>::Step>& path_;
  std::vector<std::uint32_t>& point_marks_;
  L coplanar_, rounding_sq_;
  L least_height_{0.0}, farthest_sq_{0.0};
  bool has_least_height_ = false, is_heap_ = false;
  std::size_t n_near_ = 0, n_hidden_ = 0, n_rim_ = 0;
  std::uint32_t last_mark_ = 0;
  bool is_linked_ = true;
};

}  // namespace vex
