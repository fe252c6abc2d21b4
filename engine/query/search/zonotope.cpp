#include "engine/query/search/zonotope.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

constexpr double kU = kUnitRoundoff;
// Two vectors whose angle's sine is below this are taken for parallel: to turn one into the other's direction moves no
// point of K by more than this times its length (E24).
constexpr double kParallel = 64.0 * kU;
// Normals of pairs turn by no more than this over the sine of the pair's angle: what they are rounded by, and 64 u for
// each vector of the pair that is turned so (E24).
constexpr double kTurn = 160.0;

std::size_t index_of(int k) { return static_cast<std::size_t>(k); }

Vec3d turned(const Transformd& a_from_b, const Vec3d& v) {
  return {dot(a_from_b.row_x, v), dot(a_from_b.row_y, v), dot(a_from_b.row_z, v)};
}

Vec3d centre_of(const DifferenceZonotope& k) { return k.centre_a - k.centre_b; }

using Factors = std::array<double, DifferenceZonotope::kMostVectors>;

// The points of A and B whose difference has these factors.
void set_points(ZonotopeSeparation& result, const DifferenceZonotope& k, const Factors& factors) {
  result.point_a = k.centre_a;
  result.point_b = k.centre_b;
  result.own_point_b = k.own_b.centre;
  for (int i = 0; i < k.n_vectors; ++i) {
    const Vec3d part = factors[index_of(i)] * k.vectors[index_of(i)];
    if (i < k.n_of_a) {
      result.point_a = result.point_a + part;
    } else {
      result.point_b = result.point_b - part;
      result.own_point_b = result.own_point_b - factors[index_of(i)] * k.own_b.vectors[index_of(i - k.n_of_a)];
    }
  }
}

const volatile double kOne = 1.0;
// Between -one and one, and of what is no number -one, in two instructions. Of a limit that it knows the compiler would
// make jumps, for what is at the one is not beyond the other; processors foretell every other one of them wrongly, and
// a distance of capsules takes a tenth longer or more. So it is read (kOne).
double clamped(double s, double one) {
  const double above = s > -one ? s : -one;
  return above < one ? above : one;
}

// The vectors in a plane with the unit normal `normal` whose combination is `target`, which is in their zonotope to
// rounding: one factor after the other, each in the middle of what leaves the rest within reach of the others.
void combine_in_plane(const DifferenceZonotope& k, const std::array<int, 6>& members, int n_members,
                      const Vec3d& normal, Vec3d target, Factors& factors) {
  for (int m = 0; m < n_members; ++m) {
    const Vec3d& g = k.vectors[index_of(members[index_of(m)])];
    double low = -1.0, high = 1.0;
    // |d . (target - s g)| <= sum over the rest of |d . g_j|, along the rest's vectors and across them.
    const auto limit = [&](const Vec3d& d) {
      double reach = 0.0;
      for (int j = m + 1; j < n_members; ++j) reach += std::fabs(dot(d, k.vectors[index_of(members[index_of(j)])]));
      const double along = dot(d, g), wanted = dot(d, target);
      if (!(along * along > (kParallel * kParallel) * (dot(d, d) * dot(g, g)))) return;
      const double one = (wanted - reach) / along, other = (wanted + reach) / along;
      low = std::max(low, std::min(one, other));
      high = std::min(high, std::max(one, other));
    };
    for (int j = m + 1; j < n_members; ++j) {
      const Vec3d& rest = k.vectors[index_of(members[index_of(j)])];
      limit(cross(normal, rest));
      limit(rest);
    }
    if (m + 1 == n_members) low = high = dot(target, g) / dot(g, g);
    const double factor = clamped(0.5 * (low + high), kOne);
    factors[index_of(members[index_of(m)])] = factor;
    target = target - factor * g;
  }
}

}  // namespace

DifferenceZonotope::DifferenceZonotope(const Generators& a, const Generators& b, const Transformd& a_from_b)
    : centre_a(a.centre),
      centre_b(a_from_b(b.centre)),
      n_of_a(a.n_vectors),
      n_vectors(a.n_vectors + b.n_vectors),
      own_b(b) {
  for (int i = 0; i < a.n_vectors; ++i) vectors[index_of(i)] = a.vectors[index_of(i)];
  for (int i = 0; i < b.n_vectors; ++i) vectors[index_of(n_of_a + i)] = turned(a_from_b, b.vectors[index_of(i)]);
}

// What is clamped is as often beyond a limit as not, so nothing here is a branch: each of the factors is the best one
// for the other's last value (C. Ericson, Real-Time Collision Detection, section 5.1.9), and that of a vector that is
// not there is 0.
std::optional<ZonotopeSeparation> nearest_of_segments(const Generators& a, const Generators& b,
                                                      const Transformd& a_from_b, const QueryError<double>& error) {
  if (a.n_vectors + b.n_vectors > 2) return std::nullopt;
  // One of each body, or both of one.
  const bool are_of_a = a.n_vectors == 2, are_of_b = b.n_vectors == 2;
  const Vec3d g = are_of_b ? turned(a_from_b, b.vectors[0]) : a.vectors[0];
  const Vec3d h = are_of_a ? a.vectors[1] : turned(a_from_b, b.vectors[are_of_b ? 1 : 0]);
  const Vec3d centre_b = a_from_b(b.centre), centre = a.centre - centre_b;
  const double gg = dot(g, g), hh = dot(h, h), gh = dot(g, h), cg = dot(centre, g), ch = dot(centre, h);
  const double inverse_gg = gg > 0.0 ? 1.0 / gg : 0.0, inverse_hh = hh > 0.0 ? 1.0 / hh : 0.0;
  const Vec3d across = cross(g, h);
  const double determinant = dot(across, across);
  const double crossing = (gh * ch - cg * hh) / determinant;
  const double one = kOne;
  const double first = determinant > 0x1p-80 * (gg * hh) ? clamped(crossing, one) : 0.0;
  const double t = clamped(-(ch + first * gh) * inverse_hh, one), s = clamped(-(cg + t * gh) * inverse_gg, one);
  const Vec3d nearest = (centre + s * g) + t * h;
  const double slack = 2.0 * error.support, length = norm(nearest);
  if (!(length > slack)) return std::nullopt;
  const auto lower_along = [&](const Vec3d& normal) {
    return (-dot(normal, centre) - std::fabs(dot(normal, g))) - std::fabs(dot(normal, h));
  };
  std::optional<ZonotopeSeparation> answer(std::in_place);
  ZonotopeSeparation& result = *answer;
  result.normal = (-1.0 / length) * nearest;
  double lower = lower_along(result.normal);
  // Of segments that nearly cross the nearest point is all rounding, and what is across them is not.
  const double few_roundings = 8.0 * kU * error.reach;
  if (length - lower > few_roundings && std::fabs(s) < 1.0 && std::fabs(t) < 1.0 && determinant > 0.0) [[unlikely]] {
    const Vec3d normal = ((dot(across, nearest) < 0.0 ? 1.0 : -1.0) / std::sqrt(determinant)) * across;
    const double found = lower_along(normal);
    if (found > lower) {
      lower = found;
      result.normal = normal;
    }
  }
  result.distance = length;
  result.bounds = {lower - slack, length + slack};
  result.point_a = (a.centre + (are_of_b ? 0.0 : s) * g) + (are_of_a ? t : 0.0) * h;
  result.point_b = (centre_b - (are_of_b ? s : 0.0) * g) - (are_of_a ? 0.0 : t) * h;
  result.own_point_b = b.centre - (are_of_a ? 0.0 : t) * b.vectors[are_of_b ? 1 : 0];
  if (are_of_b) result.own_point_b = result.own_point_b - s * b.vectors[0];
  return answer;
}

std::optional<ZonotopeSeparation> deepest_of_faces(const DifferenceZonotope& k, const QueryError<double>& error) {
  if (k.n_vectors < 3) return std::nullopt;
  constexpr int kMostPairs = 15;
  std::array<double, kMostPairs> x, y, z, reach, aside, square, product;
  std::array<std::array<int, 2>, kMostPairs> pairs;
  std::array<double, 6> squares;
  for (int i = 0; i < k.n_vectors; ++i) squares[index_of(i)] = dot(k.vectors[index_of(i)], k.vectors[index_of(i)]);
  int n_pairs = 0;
  for (int i = 0; i < k.n_vectors; ++i) {
    for (int j = i + 1; j < k.n_vectors; ++j) {
      const Vec3d normal = cross(k.vectors[index_of(i)], k.vectors[index_of(j)]);
      const std::size_t p = index_of(n_pairs++);
      x[p] = normal.x;
      y[p] = normal.y;
      z[p] = normal.z;
      product[p] = squares[index_of(i)] * squares[index_of(j)];
      pairs[p] = {i, j};
    }
  }
  const Vec3d centre = centre_of(k);
  const std::size_t n = index_of(n_pairs);
  for (std::size_t p = 0; p < n; ++p) {
    aside[p] = (x[p] * centre.x + y[p] * centre.y) + z[p] * centre.z;
    square[p] = (x[p] * x[p] + y[p] * y[p]) + z[p] * z[p];
    reach[p] = -std::fabs(aside[p]);
  }
  for (int i = 0; i < k.n_vectors; ++i) {
    const Vec3d g = k.vectors[index_of(i)];
    for (std::size_t p = 0; p < n; ++p) reach[p] += std::fabs((x[p] * g.x + y[p] * g.y) + z[p] * g.z);
  }
  // Heights over the lengths of the normals, and what the roundings of the normals change in them (E24). The least is
  // found by the squares, and a root is drawn only of those that are about as low, or that much is changed in.
  std::array<double, kMostPairs> low;  // the square, with the height's sign
  bool leaves_out = false;
  for (std::size_t p = 0; p < n; ++p) {
    const bool is_pair = square[p] > (kParallel * kParallel) * product[p];
    low[p] = is_pair ? reach[p] * std::fabs(reach[p]) / square[p] : HUGE_VAL;
    leaves_out |= !is_pair;
  }
  std::size_t best = 0;
  for (std::size_t p = 1; p < n; ++p) best = low[p] < low[best] ? p : best;
  if (!(low[best] < HUGE_VAL)) return std::nullopt;
  const double slack = 2.0 * error.support, turn = (kTurn * kU) * error.reach;
  const double least = reach[best] / std::sqrt(square[best]);
  double least_lower = HUGE_VAL;
  constexpr double kFewTurns = 64.0;
  const double near = least + kFewTurns * turn, near_low = near * std::fabs(near);
  for (std::size_t p = 0; p < n; ++p) {
    const bool may_be_lower = !(low[p] > near_low) || product[p] > (kFewTurns * kFewTurns) * square[p];
    if (!may_be_lower || !(low[p] < HUGE_VAL)) continue;
    const double inverse = 1.0 / std::sqrt(square[p]);
    least_lower = std::min(least_lower, reach[p] * inverse - turn * (std::sqrt(product[p]) * inverse));
  }
  std::optional<ZonotopeSeparation> answer(std::in_place);
  ZonotopeSeparation& result = *answer;
  const double sign = aside[best] > 0.0 ? -1.0 : 1.0;
  result.normal = (sign / std::sqrt(square[best])) * Vec3d{x[best], y[best], z[best]};
  result.distance = -least;
  result.bounds = {-least - slack, -(least_lower - slack - (leaves_out ? 6.0 * kParallel * error.reach : 0.0))};
  if (result.bounds.lower > 0.0) return answer;
  if (!(result.bounds.upper < 0.0)) return std::nullopt;

  Factors factors{};
  std::array<int, 6> members{};
  int n_members = 0;
  Vec3d target = least * result.normal - centre;
  for (int i = 0; i < k.n_vectors; ++i) {
    const Vec3d& g = k.vectors[index_of(i)];
    const double along = dot(result.normal, g);
    const bool spans = i == pairs[best][0] || i == pairs[best][1];
    if (spans || std::fabs(along) <= kParallel * std::sqrt(squares[index_of(i)])) {
      members[index_of(n_members++)] = i;
      continue;
    }
    factors[index_of(i)] = along > 0.0 ? 1.0 : -1.0;
    target = target - factors[index_of(i)] * g;
  }
  combine_in_plane(k, members, n_members, result.normal, target, factors);
  set_points(result, k, factors);
  // Vectors that lean out of the face's plane by more than rounding, and hardly more, may have to be cut short, too:
  // for the search.
  const Vec3d off = (result.point_b - result.point_a) - result.distance * result.normal;
  if (!(norm_1(off) <= 4.0 * slack)) return std::nullopt;
  return answer;
}

}  // namespace vex
