#include "apps/referees/origin_search.h"

#include <algorithm>
#include <cmath>

#include "apps/referees/origin_simplex.h"

namespace vex::exact {
namespace {

// Near contact of two smooth bodies takes a few dozen; ten times that have never been seen.
constexpr int kMaxSteps = 400;

// What to add where the nearest point of a triangle, an edge or a vertex is the origin itself, to rounding.
std::vector<Vec3dd> directions_around(const OriginSimplex& simplex) {
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
  OriginSimplex simplex;
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
    if (has_point(simplex, w)) break;
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
          double least = HUGE_VAL;
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
