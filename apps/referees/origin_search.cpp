#include "apps/referees/origin_search.h"

#include <algorithm>
#include <cmath>

namespace vex::exact {
namespace {

// Near contact of two smooth bodies takes a few dozen; ten times that have never been seen.
constexpr int kMaxSteps = 400;

DoubleDouble determinant_of(const Vec3dd& a, const Vec3dd& b, const Vec3dd& c) { return dot(a, cross(b, c)); }

// The nearest point of a face of the simplex, and which of its points carry it (a bit each).
struct Nearest {
  Vec3dd point;
  unsigned carriers = 0;
  DoubleDouble distance_sq = INFINITY;
};

class Simplex {
 public:
  std::vector<DifferencePoint> points;

  // Reduces the simplex to what carries the nearest point; false where the origin is inside of a tetrahedron.
  bool reduce(Vec3dd& nearest_point) {
    if (points.size() == 4 && holds_origin()) return false;
    best_ = {};
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      offer(at(i), 1u << i);
      for (std::size_t j = i + 1; j < n; ++j) {
        offer_edge(i, j);
        for (std::size_t k = j + 1; k < n; ++k) offer_triangle(i, j, k);
      }
    }
    std::vector<DifferencePoint> kept;
    for (std::size_t i = 0; i < n; ++i) {
      if ((best_.carriers >> i) & 1u) kept.push_back(points[i]);
    }
    points = std::move(kept);
    nearest_point = best_.point;
    return true;
  }

 private:
  const Vec3dd& at(std::size_t i) const { return points[i].approximately; }

  bool holds_origin() const {
    const Vec3dd &a = at(0), &b = at(1), &c = at(2), &d = at(3);
    const double whole = determinant_of(b - a, c - a, d - a).value();
    if (whole == 0.0) return false;
    const double sign = whole > 0.0 ? 1.0 : -1.0;
    return sign * determinant_of(b, c, d).value() >= 0.0 && sign * determinant_of(a, d, c).value() >= 0.0 &&
           sign * determinant_of(a, b, d).value() >= 0.0 && sign * determinant_of(a, c, b).value() >= 0.0;
  }

  void offer(const Vec3dd& point, unsigned carriers) {
    const DoubleDouble distance_sq = dot(point, point);
    if ((distance_sq - best_.distance_sq).value() < 0.0 || best_.carriers == 0) {
      best_ = {point, carriers, distance_sq};
    }
  }

  void offer_edge(std::size_t i, std::size_t j) {
    const Vec3dd along = at(j) - at(i);
    const DoubleDouble length_sq = dot(along, along);
    if (!(length_sq.high > 0.0)) return;
    const DoubleDouble s = -dot(at(i), along) / length_sq;
    if (!(s.high > 0.0) || !(s.high < 1.0)) return;
    offer(at(i) + s * along, (1u << i) | (1u << j));
  }

  void offer_triangle(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3dd normal = cross(at(j) - at(i), at(k) - at(i));
    const DoubleDouble normal_sq = dot(normal, normal);
    if (!(normal_sq.high > 0.0)) return;
    if (!(determinant_of(normal, at(j), at(k)).value() > 0.0)) return;
    if (!(determinant_of(normal, at(k), at(i)).value() > 0.0)) return;
    if (!(determinant_of(normal, at(i), at(j)).value() > 0.0)) return;
    const DoubleDouble s = dot(at(i), normal) / normal_sq;
    offer(s * normal, (1u << i) | (1u << j) | (1u << k));
  }

  Nearest best_;
};

// What to add where the nearest point of a triangle, an edge or a vertex is the origin itself, to rounding.
std::vector<Vec3dd> directions_around(const Simplex& simplex) {
  std::vector<Vec3dd> dirs = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.6, 0.7, -0.4}, {-0.5, 0.3, 0.8}};
  const std::vector<DifferencePoint>& p = simplex.points;
  if (p.size() >= 3) {
    dirs.push_back(cross(p[1].approximately - p[0].approximately, p[2].approximately - p[0].approximately));
  }
  if (p.size() == 2) {
    for (std::size_t k = 0; k < 3; ++k) dirs.push_back(cross(p[1].approximately - p[0].approximately, dirs[k]));
  }
  const std::size_t n = dirs.size();
  for (std::size_t k = 0; k < n; ++k) dirs.push_back(-dirs[k]);
  return dirs;
}

}  // namespace

SearchResult search_origin(const DifferenceBody& difference, const Vec3dd& dir) {
  SearchResult result;
  Simplex simplex;
  simplex.points.push_back(difference.support(dir));
  for (int step = 0; step < kMaxSteps; ++step) {
    Vec3dd v;
    if (!simplex.reduce(v)) {
      result.around = simplex.points;
      return result;
    }
    // Points are of size 1; shorter than this, v is nothing but rounding.
    if (norm_1(Vec3d{v.x.high, v.y.high, v.z.high}) < 0x1p-98) break;
    const DifferencePoint w = difference.support(-v);
    if (dot(w.approximately, v).value() > 0.0) {
      result.separating_dir = -v;
      return result;
    }
    const bool repeats = std::ranges::any_of(simplex.points, [&w](const DifferencePoint& p) {
      const Vec3dd d = p.approximately - w.approximately;
      return d.x.value() == 0.0 && d.y.value() == 0.0 && d.z.value() == 0.0;
    });
    if (repeats) break;
    simplex.points.push_back(w);
  }
  for (const Vec3dd& more : directions_around(simplex)) {
    const double largest = std::max({std::fabs(more.x.high), std::fabs(more.y.high), std::fabs(more.z.high)});
    if (largest > 0.0) result.around.push_back(difference.support(more));
  }
  result.around.insert(result.around.end(), simplex.points.begin(), simplex.points.end());
  return result;
}

std::optional<std::array<std::size_t, 4>> deepest_tetrahedron(const std::vector<DifferencePoint>& points) {
  std::optional<std::array<std::size_t, 4>> best;
  double best_share = 0.0;
  const auto at = [&points](std::size_t i) -> const Vec3dd& { return points[i].approximately; };
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const double without_l = determinant_of(at(i), at(j), at(k)).value();
        for (std::size_t l = k + 1; l < n; ++l) {
          const double shares[] = {determinant_of(at(j), at(l), at(k)).value(),
                                   determinant_of(at(i), at(k), at(l)).value(),
                                   determinant_of(at(i), at(l), at(j)).value(), without_l};
          const double whole = shares[0] + shares[1] + shares[2] + shares[3];
          if (whole == 0.0) continue;
          double least = INFINITY;
          for (const double share : shares) least = std::min(least, share / whole);
          if (least > best_share) {
            best_share = least;
            best = {i, j, k, l};
          }
        }
      }
    }
  }
  return best;
}

}  // namespace vex::exact
