#include "engine/query/checker/exact_hull.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vex::checker {
namespace {

using whole::Dyadic;
using whole::DyadicVector;
using whole::Integer;
using whole::Vector;

constexpr std::size_t kMostPoints = 8, kMostOfHull = 12;

// With a length more in the same unit.
std::vector<Vector> with_length(std::vector<DyadicVector> points, const Dyadic& length, Integer& whole_length) {
  points.push_back({length, {}, {}});
  int exponent = 0;
  std::vector<Vector> w = checker::as_whole(points, exponent);
  whole_length = w.back().x;
  w.pop_back();
  return w;
}

bool holds_origin(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector cd = cross(c, d), ab = cross(a, b);
  const std::array<int, 4> signs = {whole::sign(dot(b, cd)), -whole::sign(dot(a, cd)), whole::sign(dot(d, ab)),
                                    -whole::sign(dot(c, ab))};
  // Not all are 0: then the points may be in one plane, and fewer of them do.
  const bool none_is_negative = std::ranges::all_of(signs, [](int s) { return s >= 0; });
  const bool none_is_positive = std::ranges::all_of(signs, [](int s) { return s <= 0; });
  return none_is_negative != none_is_positive;
}

}  // namespace

std::vector<Vector> as_whole(const std::vector<DyadicVector>& points, int& exponent) {
  exponent = whole::lowest_exponent(0.0);
  for (const DyadicVector& p : points) {
    exponent =
        std::min({exponent, whole::lowest_exponent(p.x), whole::lowest_exponent(p.y), whole::lowest_exponent(p.z)});
  }
  std::vector<Vector> all;
  all.reserve(points.size());
  for (const DyadicVector& p : points) all.push_back(whole::in_units(p, exponent));
  return all;
}

bool nearest_of_affine_hull(std::span<const Vector> w, RationalPoint& nearest) {
  if (w.size() == 1) {
    nearest = {w[0], 1, true};
    return true;
  }
  if (w.size() == 2) {
    const Vector e = w[1] - w[0];
    const Integer first = dot(w[1], e), second = -dot(w[0], e);
    nearest = {first * w[0] + second * w[1], dot(e, e), first.sign() >= 0 && second.sign() >= 0};
    return nearest.denominator.sign() > 0;
  }
  if (w.size() != 3) return false;
  const Vector normal = cross(w[1] - w[0], w[2] - w[0]);
  const Integer first = dot(cross(w[1], w[2]), normal), second = dot(cross(w[2], w[0]), normal),
                third = dot(cross(w[0], w[1]), normal);
  nearest = {dot(normal, w[0]) * normal, dot(normal, normal),
             first.sign() >= 0 && second.sign() >= 0 && third.sign() >= 0};
  return nearest.denominator.sign() > 0;
}

bool comes_within(const std::vector<DyadicVector>& points, const Dyadic& distance) {
  const std::size_t n = points.size();
  if (n < 1 || n > kMostPoints || whole::sign(distance) < 0) return false;
  Integer most;
  const std::vector<Vector> w = with_length(points, distance, most);
  const auto is_near = [&](std::span<const Vector> some) {
    RationalPoint nearest;
    if (!nearest_of_affine_hull(some, nearest) || !nearest.is_inside) return false;
    const Integer allowed = most * nearest.denominator;
    return dot(nearest.numerator, nearest.numerator) <= allowed * allowed;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (is_near(std::array{w[i]})) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (is_near(std::array{w[i], w[j]})) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (is_near(std::array{w[i], w[j], w[k]})) return true;
        for (std::size_t l = 0; l < k; ++l) {
          if (holds_origin(w[i], w[j], w[k], w[l])) return true;
        }
      }
    }
  }
  return false;
}

bool holds_ball(const std::vector<DyadicVector>& points, const Dyadic& radius) {
  if (points.size() < 4 || points.size() > kMostOfHull || whole::sign(radius) < 0) return false;
  Integer margin;
  const std::vector<Vector> w = with_length(points, radius, margin);
  bool has_volume = false;
  for (std::size_t i = 0; i < w.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Vector normal = cross(w[j] - w[i], w[k] - w[i]);
        if (whole::is_zero(normal)) continue;
        bool is_any_above = false, is_any_below = false;
        for (const Vector& p : w) {
          const int side = whole::sign(dot(normal, p - w[i]));
          is_any_above = is_any_above || side > 0;
          is_any_below = is_any_below || side < 0;
        }
        has_volume = has_volume || is_any_above || is_any_below;
        if (is_any_above == is_any_below) continue;  // through the inside; or all in one plane
        const Integer height = is_any_below ? dot(normal, w[i]) : Integer(-dot(normal, w[i]));
        if (height.sign() < 0) return false;
        if (margin.sign() > 0 && height * height <= margin * margin * dot(normal, normal)) return false;
      }
    }
  }
  return has_volume;
}

bool surrounds_ball(const std::vector<DyadicVector>& points, std::span<const Corners> faces, const Dyadic& radius) {
  if (faces.empty() || whole::sign(radius) < 0) return false;
  Integer margin;
  const std::vector<Vector> w = with_length(points, radius, margin);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Corners& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (face[k] >= w.size()) return false;
      ++edges[{face[k], face[(k + 1) % 3]}];
    }
    const Vector &p = w[face[0]], &q = w[face[1]], &r = w[face[2]];
    const Vector normal = cross(q - p, r - p);
    const Integer height = dot(normal, p);
    if (height.sign() <= 0 || height * height < margin * margin * dot(normal, normal)) return false;
  }
  return std::ranges::all_of(edges, [&](const auto& edge) {
    const auto& [ends, n] = edge;
    const auto back = edges.find({ends.second, ends.first});
    return n == 1 && back != edges.end() && back->second == 1;
  });
}

}  // namespace vex::checker
