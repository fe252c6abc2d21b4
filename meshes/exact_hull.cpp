#include "meshes/exact_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/numeric/rounding.h"
#include "meshes/determinant.h"
#include "meshes/exact_sign.h"
#include "meshes/joining_order.h"
#include "meshes/polyhedron_measures.h"

namespace vex {
namespace {

/// A convex surface all of whose triangles see `centre` from inside, growing vertex by vertex.
class GrowingHull {
 public:
  GrowingHull(Triangles tetrahedron, const LocalPoint& centre, std::size_t most_steps_of_a_point)
      : hull_(std::move(tetrahedron)),
        centre_(centre),
        is_gone_(hull_.size(), false),
        most_steps_of_a_point_(most_steps_of_a_point) {
    local_.reserve(hull_.vertices.size());
    for (const Vec3d& v : hull_.vertices) {
      local_.push_back(centre_.to(v).value());
    }
    for (const auto& [a, b, c] : hull_.corners) {
      failed_ = failed_ || !sees_centre(a, b, c);
    }
  }

  /// Joins a vertex that is above the hull to the triangle below it, and flips what becomes reflex until nothing is.
  /// Each flip puts a tetrahedron on the surface, so no state comes twice.
  void join(std::uint32_t v) {
    most_steps_ += most_steps_of_a_point_;
    near_ = triangle_towards(v);
    is_too_slow_ = n_steps_ > most_steps_;
    const std::uint32_t t = near_;
    const auto [a, b, c] = hull_.corners[t];
    if (orientation_sign(hull_.point(a), hull_.point(b), hull_.point(c), hull_.point(v)) <= 0) {
      return;
    }
    if (!sees_centre(a, b, v) || !sees_centre(b, c, v) || !sees_centre(c, a, v)) {
      failed_ = true;  // seen from the centre it is on an edge
      return;
    }
    const std::array<std::uint32_t, 3> past{hull_.mates[3 * t], hull_.mates[3 * t + 1], hull_.mates[3 * t + 2]};
    const std::uint32_t second = new_triangle();
    const std::uint32_t third = new_triangle();
    put({a, b, v}, t, {past[0], 3 * second + 2, 3 * third + 1});
    put({b, c, v}, second, {past[1], 3 * third + 2, 3 * t + 1});
    put({c, a, v}, third, {past[2], 3 * t + 2, 3 * second + 1});
    std::size_t n_visits = 0;
    for (; !to_visit_.empty(); ++n_visits) {
      const std::uint32_t h = to_visit_.back();
      to_visit_.pop_back();
      visit(h);
    }
    n_steps_ += n_visits;
  }

  bool failed() const { return failed_ || is_too_slow_; }
  /// Points in an order that was made for it would take their number squared.
  bool is_too_slow() const { return is_too_slow_; }

  /// The hull, unless a vertex could not be joined. No edge is reflex, all triangles see the centre and, as flips keep
  /// it, cover the directions from there once: it is convex.
  std::optional<Triangles> result() && {
    local_ = {};
    if (failed() || has_a_reflex_edge()) {
      return std::nullopt;
    }
    close_gaps();
    return std::move(hull_);
  }

 private:
  int sign_from_centre(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return determinant_sign(centre_, hull_.point(a), hull_.point(b), hull_.point(c), local_[a], local_[b], local_[c]);
  }
  bool sees_centre(std::uint32_t a, std::uint32_t b, std::uint32_t c) const { return sign_from_centre(a, b, c) > 0; }

  /// The triangle that the ray from the centre through a vertex meets, walking from the last one across edges that the
  /// vertex is beyond. On a convex surface each step raises n . p / offset of the triangle's plane, so the walk ends.
  std::uint32_t triangle_towards(std::uint32_t v) {
    std::uint32_t t = near_;
    std::uint32_t came_across = kNone;
    for (std::size_t n_steps = 0; n_steps < hull_.size(); ++n_steps, ++n_steps_) {
      std::uint32_t next = t;
      for (std::uint32_t k = 0; k < 3 && next == t; ++k) {
        const std::uint32_t h = 3 * t + k;
        if (h != came_across && sign_from_centre(hull_.tail(h), hull_.head(h), v) < 0) {
          came_across = hull_.mates[h];
          next = came_across / 3;
        }
      }
      if (next == t) {
        break;
      }
      t = next;
    }
    return t;
  }

  /// Where the edge a b between the triangles a b c and b a d is reflex: flips it to c d; or takes out an end of it
  /// that has three triangles and lies below the plane of its neighbours. Other reflex edges wait for their neighbours'
  /// flips.
  void visit(std::uint32_t h) {
    if (is_gone_[h / 3]) {
      return;
    }
    const std::uint32_t back = hull_.mates[h];
    const std::uint32_t a = hull_.tail(h);
    const std::uint32_t b = hull_.head(h);
    const std::uint32_t c = hull_.opposite(h);
    const std::uint32_t d = hull_.opposite(back);
    if (c == d || orientation_sign(hull_.point(a), hull_.point(b), hull_.point(c), hull_.point(d)) <= 0) {
      return;
    }
    const std::uint32_t past_bc = hull_.mates[next_in_triangle(h)];
    const std::uint32_t past_ca = hull_.mates[previous_in_triangle(h)];
    const std::uint32_t past_ad = hull_.mates[next_in_triangle(back)];
    const std::uint32_t past_db = hull_.mates[previous_in_triangle(back)];
    const bool without_a = sees_centre(d, b, c);
    const bool without_b = sees_centre(a, d, c);
    if (without_a && without_b) {
      put({a, d, c}, h / 3, {past_ad, 3 * (back / 3) + 2, past_ca});
      put({d, b, c}, back / 3, {past_db, past_bc, 3 * (h / 3) + 1});
    } else if (without_a && past_ca / 3 == past_ad / 3) {
      const std::uint32_t past_dc = hull_.mates[third_of(past_ca, past_ad)];
      take_out(back / 3, past_ca / 3);
      put({d, b, c}, h / 3, {past_db, past_bc, past_dc});
    } else if (without_b && past_bc / 3 == past_db / 3) {
      const std::uint32_t past_dc = hull_.mates[third_of(past_bc, past_db)];
      take_out(back / 3, past_bc / 3);
      put({a, d, c}, h / 3, {past_ad, past_dc, past_ca});
    }
  }

  /// The half-edge of a triangle that is neither of two others of it.
  static std::uint32_t third_of(std::uint32_t first, std::uint32_t second) {
    return next_in_triangle(first) == second ? previous_in_triangle(first) : next_in_triangle(first);
  }

  void put(const std::array<std::uint32_t, 3>& corners, std::uint32_t triangle,
           const std::array<std::uint32_t, 3>& past) {
    hull_.corners[triangle] = corners;
    near_ = triangle;
    for (std::uint32_t k = 0; k < 3; ++k) {
      hull_.mates[3 * triangle + k] = past[k];
      hull_.mates[past[k]] = 3 * triangle + k;
      to_visit_.push_back(3 * triangle + k);
    }
  }

  std::uint32_t new_triangle() {
    if (!free_.empty()) {
      const std::uint32_t t = free_.back();
      free_.pop_back();
      is_gone_[t] = false;
      return t;
    }
    hull_.corners.emplace_back();
    hull_.mates.insert(hull_.mates.end(), 3, 0U);
    is_gone_.push_back(false);
    return static_cast<std::uint32_t>(hull_.size() - 1);
  }

  void take_out(std::uint32_t first, std::uint32_t second) {
    for (const std::uint32_t t : {first, second}) {
      is_gone_[t] = true;
      free_.push_back(t);
    }
  }

  bool has_a_reflex_edge() const {
    for (std::uint32_t h = 0; h < hull_.mates.size(); ++h) {
      if (!is_gone_[h / 3] && hull_.mates[h] > h &&
          orientation_sign(hull_.point(hull_.tail(h)), hull_.point(hull_.head(h)), hull_.point(hull_.opposite(h)),
                           hull_.point(hull_.opposite(hull_.mates[h]))) > 0) {
        return true;
      }
    }
    return false;
  }

  /// Moves the triangles together over those that are gone.
  void close_gaps() {
    std::vector<std::uint32_t> renumbered(hull_.size());
    std::uint32_t n = 0;
    for (std::uint32_t t = 0; t < hull_.size(); ++t) {
      renumbered[t] = n;
      n += is_gone_[t] ? 0U : 1U;
    }
    for (std::uint32_t t = 0; t < hull_.size(); ++t) {
      if (!is_gone_[t]) {
        hull_.corners[renumbered[t]] = hull_.corners[t];
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t mate = hull_.mates[3 * t + k];
          hull_.mates[3 * renumbered[t] + k] = 3 * renumbered[mate / 3] + mate % 3;
        }
      }
    }
    hull_.corners.resize(n);
    hull_.mates.resize(3 * std::size_t{n});
  }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  Triangles hull_;
  LocalPoint centre_;
  std::vector<Vec3d> local_;  // the vertices from the centre, rounded
  std::vector<bool> is_gone_;
  std::vector<std::uint32_t> free_;  // those that are gone
  std::vector<std::uint32_t> to_visit_;
  std::uint32_t near_ = 0;  // where the last search or flip was
  std::size_t most_steps_of_a_point_;
  std::size_t n_steps_ = 0, most_steps_ = 100'000;  // of walks, and edges looked at
  bool failed_ = false, is_too_slow_ = false;
};

/// Four vertices, the fourth below the other three: each as far as can be from the point, the line, the plane before
/// it, in double-double where double leaves a doubt. Nothing where all points lie in one plane.
std::optional<std::array<std::uint32_t, 4>> wide_tetrahedron(std::span<const Vec3d> points) {
  std::array<std::uint32_t, 4> corner{};
  // `rough` is in double, off by less than gamma(16) times `magnitude`.
  const auto farthest = [&](std::size_t k, const auto& rough, const auto& magnitude, const auto& measure) {
    double most = 0.0;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      if (rough(points[v]) + gamma(16) * magnitude(points[v]) > most) {
        if (const double value = measure(points[v]); value > most) {
          most = value;
          corner[k] = v;
        }
      }
    }
    return points[corner[k]];
  };
  const Vec3d a = points[0];
  const auto distance = [&](const Vec3d& p) { return norm(p - a); };
  const Vec3d b = farthest(1, distance, distance, distance);
  const Vec3d ab = b - a;
  const Vec3d c = farthest(
      2, [&](const Vec3d& p) { return norm(cross(ab, p - a)); }, [&](const Vec3d& p) { return norm(ab) * norm(p - a); },
      [&](const Vec3d& p) { return norm(cross(exact_difference(b, a), exact_difference(p, a))); });
  const Vec3d ac = c - a;
  const Vec3d d = farthest(
      3, [&](const Vec3d& p) { return std::fabs(dot(p - a, cross(ab, ac))); },
      [&](const Vec3d& p) { return 3.0 * norm(ab) * norm(ac) * norm(p - a); },
      [&](const Vec3d& p) { return std::fabs(orientation(a, b, c, p).value.value()); });
  const int sign = orientation_sign(a, b, c, d);
  if (sign > 0) {
    std::swap(corner[1], corner[2]);
  }
  return sign == 0 ? std::nullopt : std::optional(corner);
}

}  // namespace

std::optional<Triangles> exact_hull(std::span<const Vec3d> points) {
  const auto tetrahedron = points.size() < 4 ? std::nullopt : wide_tetrahedron(points);
  if (!tetrahedron) {
    return std::nullopt;
  }
  const auto [a, b, c, d] = *tetrahedron;
  // A point inside, with weights of no symmetry: vertices of a symmetric body then are on no edge seen from there.
  // Others for the case that one is all the same, or that the order of the points makes it slow. Measured: bodies,
  // grids, curves and points in a ball take 1 to 50 steps for each point, long ones 85 in the first order and 32 in the
  // others; an order that was made to take long, tens of thousands.
  struct Attempt {
    std::array<double, 3> weights;
    std::size_t most_steps_of_a_point;
  };
  constexpr std::array<Attempt, 3> kAttempts{
      {{{0.271, 0.229, 0.243}, 100}, {{0.2633, 0.2377, 0.2219}, 400}, {{0.2371, 0.2593, 0.2917}, 400}}};
  end_if_interrupted();
  std::vector<std::uint32_t> order = joining_order(points);
  std::uint64_t another = 0;
  bool is_too_slow = false;
  for (const auto& [weights, most_steps_of_a_point] : kAttempts) {
    const auto& [u, v, w] = weights;
    const Vec3d step = (u * (points[b] - points[a]) + v * (points[c] - points[a])) + w * (points[d] - points[a]);
    std::optional<Triangles> start = paired_triangles(points, {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}});
    if (!start) {
      break;
    }
    GrowingHull hull(std::move(*start), {points[a], step}, most_steps_of_a_point);
    for (std::size_t i = 0; i < order.size() && !hull.failed(); ++i) {
      if (i % 64 == 0) end_if_interrupted();
      hull.join(order[i]);
    }
    is_too_slow = hull.is_too_slow();
    if (std::optional<Triangles> result = std::move(hull).result()) {
      return result;
    }
    if (is_too_slow) order = joining_order(points, ++another);
  }
  if (is_too_slow) {
    throw InputError("the convex hull of the points takes too long (" + std::to_string(points.size()) +
                     " points that lie as if to make it slow) - thin them out");
  }
  return std::nullopt;
}

}  // namespace vex
