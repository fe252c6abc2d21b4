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
#include <utility>
#include <vector>

#include "engine/numeric/directions.h"
#include "engine/query/nearest_simplex.h"
#include "engine/query/portal_refinement.h"

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

/// Memory that a polytope grows in. One serves one query at a time, and then others.
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
      : points_(store.points),
        faces_(store.faces),
        heap_(store.heap),
        hidden_(store.hidden),
        rim_(store.rim),
        path_(store.path),
        point_marks_(store.point_marks),
        difference_(difference),
        error_(error),
        slack_(L(2.0) * error.support),
        coplanar_(L(16.0 * unit_roundoff<L>()) * error.reach),
        max_support_calls_(max_support_calls) {
    store.clear();
  }

  /// From the points of a simplex on. `wanted`: how near the bounds shall be, rounding apart, for a depth.
  template <class Wanted>
  End run(const NearestSimplex<L, Point>& simplex, const Wanted& wanted) {
    const bool has_volume = begin(simplex);
    while (true) {
      if (n_support_calls_ > 0 && height_ < -slack_) return End::separated;
      if (!has_volume) return End::flat;
      const std::optional<std::uint32_t> found = nearest_face();
      if (!found) return End::stalled;
      nearest_ = *found;
      const L distance = faces_[nearest_].distance;
      const Vec3<L> normal = unit_along(faces_[nearest_].normal);
      const std::uint32_t added = add_support(normal);
      const L height = dot(normal, at(added));
      if (height - distance <= wanted(distance)) {
        is_of_face_ = true;
        normal_ = normal;
        answer_height_ = height;
        return End::converged;
      }
      if (height_ - distance <= wanted(distance)) return End::converged;
      if (static_cast<int>(points_.size()) >= max_support_calls_) return End::capped;
      if (!grow(nearest_, added)) return End::stalled;
    }
  }

  /// The unit vector along which K reaches least far of all that were asked for, or that of the nearest face if that is
  /// as near as asked for; and how far it reaches, to rounding. Where K is flat: across it.
  const Vec3<L>& normal() const { return normal_; }
  L height() const { return is_of_face_ ? answer_height_ : height_; }
  /// The depth is not above it, rounding included: the least that K reaches in any direction that was asked for.
  L depth_upper() const { return height_ + slack_; }
  /// The depth is not below it, rounding included; negative where nothing is known.
  L depth_lower() const {
    if (faces_.empty()) return -error_.reach;
    const L distance = -larger(-faces_[nearest_].distance, -height_) - slack_;
    return distance > L(0.0) && goes_around_origin() ? distance : -error_.reach;
  }
  int n_support_calls() const { return n_support_calls_; }

  /// Where the hull ends along the normal, as a combination of a face's corners: `visit(weight, point)`.
  template <class Visit>
  void visit_foot(const Visit& visit) const {
    std::uint32_t at = nearest_;
    if (is_of_face_) {
      // Faces in one plane share a foot: it is in one of them, a few steps away.
      for (std::size_t step = 0; step < faces_.size(); ++step) {
        const std::array<L, 3> weights = weights_along_normal(faces_[at]);
        const std::size_t least = static_cast<std::size_t>(std::ranges::min_element(weights) - weights.begin());
        const std::uint32_t next = faces_[at].across[(least + 1) % 3].face;  // from that corner
        const bool is_coplanar = faces_[next].distance - faces_[nearest_].distance <= L(4.0) * coplanar_ + gap();
        if (!(weights[least] < L(0.0)) || !is_coplanar) break;
        at = next;
      }
    } else {
      at = face_along(normal_).value_or(nearest_);
    }
    std::array<L, 3> weights = weights_along_normal(faces_[at]);
    L sum(0.0);
    for (L& weight : weights) sum += weight = larger(weight, L(0.0));
    if (!(sum > L(0.0))) weights = {sum = L(1.0), L(0.0), L(0.0)};  // a sliver
    for (std::size_t k = 0; k < 3; ++k) visit(weights[k] / sum, points_[faces_[at].corners[k]]);
  }

  /// The corners of the face through which the ray from the origin leaves a hull that holds it.
  std::optional<Corners> corners_along(const Vec3<L>& dir) const {
    const std::optional<std::uint32_t> face = face_along(dir);
    return face ? std::optional(faces_[*face].corners) : std::nullopt;
  }

 private:
  using Face = detail::HullFace<L>;
  using FaceEdge = detail::FaceEdge;

  L gap() const { return larger(answer_height_ - faces_[nearest_].distance, L(0.0)); }

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

  // Also keeps the least height.
  std::uint32_t add_support(const Vec3<L>& dir) {
    ++n_support_calls_;
    points_.push_back(difference_.support(dir));
    const L height = dot(dir, points_.back().w);
    if (n_support_calls_ == 1 || height < height_) {
      height_ = height;
      normal_ = dir;
    }
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  const Vec3<L>& at(std::uint32_t i) const { return points_[i].w; }

  // --- the first tetrahedron

  // Of the simplex, where it has volume; else of these points and of more in directions that span space.
  bool begin(const NearestSimplex<L, Point>& simplex) {
    for (int k = 0; k < simplex.size(); ++k) points_.push_back(simplex.point(k));
    if (points_.size() == 4 && has_volume(0, 1, 2, 3)) {
      make_tetrahedron(0, 1, 2, 3);
      return true;
    }
    for (const Vec3d& d : {Vec3d{0.6113, 0.4717, 0.6361}, Vec3d{-0.6113, -0.4717, -0.6361}})
      add_support(unit_along(broadcast<L>(d)));
    std::uint32_t first = 0, second = 0, third = 0;
    const auto find_longest = [&] {
      L largest(0.0);
      for (std::uint32_t i = 0; i < points_.size(); ++i) {
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
      for (std::uint32_t i = 0; i < points_.size(); ++i) {
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
    make_tetrahedron(first, second, third, apex);
    for (std::uint32_t i = 0; i < apex; ++i) {
      if (i != first && i != second && i != third) grow_by_any(i);
    }
    grow_by_any(apex == above ? below : above);
    return true;
  }

  bool has_volume(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) const {
    const detail::Face<L> face = detail::face_of(at(i), at(j), at(k));
    const L volume = absolute(dot(face.normal, at(l) - at(i)));
    return volume > L(16.0) * slack_ * face.edge_product &&
           norm_1(face.normal) > L(0x1p33 * unit_roundoff<L>()) * face.edge_product;
  }

  void make_tetrahedron(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) {
    if (dot(cross(at(j) - at(i), at(k) - at(i)), at(l) - at(i)) > L(0.0)) std::swap(j, k);
    // l is behind (i, j, k).
    add_face({i, j, k}, {{{3, 0}, {2, 0}, {1, 0}}});
    add_face({i, k, l}, {{{0, 2}, {2, 2}, {3, 1}}});
    add_face({k, j, l}, {{{0, 1}, {3, 2}, {1, 1}}});
    add_face({j, i, l}, {{{0, 0}, {1, 2}, {2, 1}}});
  }

  // A point that is not above a face that was chosen: of the faces that it is above, the one it is highest above.
  void grow_by_any(std::uint32_t added) {
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
    if (highest > L(4.0) * slack_) grow(best, added);
  }

  // --- faces

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
    const L rounding_sq = L(1024.0 * (unit_roundoff<L>() * unit_roundoff<L>())) * (error_.reach * error_.reach);
    const L least_sq = least > L(0.0) ? least * least : L(0.0);
    face.has_origin_behind = !is_sliver && least_sq > rounding_sq * product;  // E21
    // What is farther than the depth can be is never the nearest, and need not be told apart.
    const L farthest = L(1.0 + 0x1p-40) * height_;
    const bool is_far = n_support_calls_ > 0 && least_sq > (farthest * farthest) * square;
    face.distance = is_far ? height_ : least / square_root(square);
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

  using Entry = std::pair<L, std::uint32_t>;
  static constexpr auto is_farther = [](const Entry& a, const Entry& b) { return a.first > b.first; };

  // None where all are farther than K reaches: by rounding only.
  std::optional<std::uint32_t> nearest_face() {
    while (!heap_.empty() && !faces_[heap_.front().second].is_alive) {
      std::pop_heap(heap_.begin(), heap_.end(), is_farther);
      heap_.pop_back();
    }
    return heap_.empty() ? std::nullopt : std::optional(heap_.front().second);
  }

  // Takes a point into the hull: the faces that it is in front of give way to those from their rim to it. False, and
  // nothing changes, where rounding has torn the rim.
  bool grow(std::uint32_t start, std::uint32_t added) {
    // Faces in whose plane the point is had better go too, or it makes faces without area with their edges.
    for (const double side : {-1.0, 0.0, 1.0}) {
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

  // Of the corners, in proportion.
  std::array<L, 3> weights_along_normal(const Face& face) const {
    const Vec3<L>&p = at(face.corners[0]), &q = at(face.corners[1]), &r = at(face.corners[2]);
    return {dot(cross(q, r), normal_), dot(cross(r, p), normal_), dot(cross(p, q), normal_)};
  }

  // --- what the hull proves

  // A closed surface whose faces have the origin behind them goes around it. Else count how often a ray from the origin
  // through the nearest face passes the surface: once, then it goes around every ball that it does not enter. By proven
  // signs; another ray where one passes an edge.
  bool goes_around_origin() const {
    const auto is_clear = [](const Face& face) { return !face.is_alive || face.has_origin_behind; };
    if (std::ranges::all_of(faces_, is_clear)) return true;
    const Corners& corners = faces_[nearest_].corners;
    for (const auto& [u, v, w] : {std::array{0.41, 0.26, 0.33}, std::array{0.22, 0.47, 0.31}}) {
      const Vec3<L> ray = (L(u) * at(corners[0]) + L(v) * at(corners[1])) + L(w) * at(corners[2]);
      int n_passed = 0;
      const bool is_proven = std::ranges::all_of(faces_, [&](const Face& face) {
        if (!face.is_alive) return true;
        const std::optional<int> passed = times_passed(face, ray);
        n_passed += passed.value_or(0);
        return passed.has_value();
      });
      if (is_proven) return n_passed == 1;
    }
    return false;
  }
  // 1 where the ray passes the triangle outwards, -1 inwards, 0 where it passes beside it; none where rounding leaves
  // that open. With s_i the products below, sum s_i p_i = det(p) ray.
  std::optional<int> times_passed(const Face& face, const Vec3<L>& ray) const {
    const L rounding = L(16.0 * unit_roundoff<L>());
    int n_positive = 0, n_negative = 0;
    bool is_behind = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<L>&p = at(face.corners[k]), &q = at(face.corners[(k + 1) % 3]);
      const L turn = dot(cross(p, q), ray), bound = rounding * ((norm_1(p) * norm_1(q)) * norm_1(ray));
      n_positive += turn > bound ? 1 : 0;
      n_negative += turn < -bound ? 1 : 0;
      is_behind = is_behind && dot(p, ray) < -rounding * (norm_1(p) * norm_1(ray));
    }
    if (is_behind || (n_positive > 0 && n_negative > 0)) return 0;
    if (n_positive < 3 && n_negative < 3) return std::nullopt;
    const Vec3<L>&p = at(face.corners[0]), &q = at(face.corners[1]), &r = at(face.corners[2]);
    const L volume = dot(cross(p, q), r), bound = rounding * ((norm_1(p) * norm_1(q)) * norm_1(r));
    if (!(absolute(volume) > bound)) return std::nullopt;
    const bool is_outwards = volume > L(0.0);
    return is_outwards == (n_positive == 3) ? std::optional(is_outwards ? 1 : -1) : std::optional(0);
  }

  std::vector<Point>& points_;
  std::vector<Face>& faces_;
  std::vector<Entry>& heap_;
  std::vector<std::uint32_t>& hidden_;
  std::vector<typename PolytopeStore<L, Point>::RimEdge>& rim_;
  std::vector<typename PolytopeStore<L, Point>::Step>& path_;
  std::vector<std::uint32_t>& point_marks_;
  const Difference& difference_;
  QueryError<L> error_;
  L slack_, coplanar_;
  int max_support_calls_;
  int n_support_calls_ = 0;
  std::uint32_t nearest_ = 0, last_mark_ = 0;
  bool is_of_face_ = false;
  Vec3<L> normal_;
  L height_{0.0}, answer_height_{0.0};
};

}  // namespace vex
