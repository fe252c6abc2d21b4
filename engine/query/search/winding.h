// Whether the surface of a hull goes around the origin: what makes its distance from there a bound (E21).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "engine/query/search/growing_hull.h"

namespace vex {

namespace detail {

/// 1 where the ray passes the triangle outwards, -1 inwards, 0 where it passes beside it; none where rounding leaves
/// that open. With s_i the products below, sum s_i p_i = det(p) ray.
template <class L>
std::optional<int> times_passed(const std::array<const Vec3<L>*, 3>& corners, const Vec3<L>& ray) {
  const L rounding = L(16.0 * unit_roundoff<L>());
  int n_positive = 0, n_negative = 0;
  bool is_behind = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<L>&p = *corners[k], &q = *corners[(k + 1) % 3];
    const L turn = dot(cross(p, q), ray), bound = rounding * ((norm_1(p) * norm_1(q)) * norm_1(ray));
    n_positive += turn > bound ? 1 : 0;
    n_negative += turn < -bound ? 1 : 0;
    is_behind = is_behind && dot(p, ray) < -rounding * (norm_1(p) * norm_1(ray));
  }
  if (is_behind || (n_positive > 0 && n_negative > 0)) return 0;
  if (n_positive < 3 && n_negative < 3) return std::nullopt;
  const Vec3<L>&p = *corners[0], &q = *corners[1], &r = *corners[2];
  const L volume = dot(cross(p, q), r), bound = rounding * ((norm_1(p) * norm_1(q)) * norm_1(r));
  if (!(absolute(volume) > bound)) return std::nullopt;
  const bool is_outwards = volume > L(0.0);
  return is_outwards == (n_positive == 3) ? std::optional(is_outwards ? 1 : -1) : std::optional(0);
}

}  // namespace detail

/// A closed surface whose faces have the origin behind them goes around it. Else count how often a ray from the origin
/// through the nearest face passes the surface: once, then it goes around every ball that it does not enter. By proven
/// signs; another ray where one passes an edge.
template <class L, class Point>
bool goes_around_origin(const GrowingHull<L, Point>& hull, std::uint32_t nearest) {
  using Face = detail::HullFace<L>;
  bool are_clear = true;
  for (const Face& face : hull.faces()) are_clear = are_clear & (!face.is_alive | face.has_origin_behind);
  if (are_clear) return true;
  const auto corner = [&hull](const Face& face, std::size_t k) { return &hull.at(face.corners[k]); };
  const Face& through = hull.faces()[nearest];
  for (const auto& [u, v, w] : {std::array{0.41, 0.26, 0.33}, std::array{0.22, 0.47, 0.31}}) {
    const Vec3<L> ray = (L(u) * *corner(through, 0) + L(v) * *corner(through, 1)) + L(w) * *corner(through, 2);
    int n_passed = 0;
    const bool is_proven = std::ranges::all_of(hull.faces(), [&](const Face& face) {
      if (!face.is_alive) return true;
      const std::optional<int> passed =
          detail::times_passed<L>({corner(face, 0), corner(face, 1), corner(face, 2)}, ray);
      n_passed += passed.value_or(0);
      return passed.has_value();
    });
    if (is_proven) return n_passed == 1;
  }
  return false;
}

}  // namespace vex
