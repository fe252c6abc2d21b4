#include "apps/referees/box_box.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

constexpr std::array<std::size_t, 3> kNext = {1, 2, 0};
constexpr std::array<std::size_t, 3> kAfterNext = {2, 0, 1};

Triple triple(const Vec3d& v) { return {v.x, v.y, v.z}; }

double inner(const Triple& a, const Triple& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }
double inner_of_sizes(const Triple& a, const Triple& b) {
  return (std::fabs(a[0]) * b[0] + std::fabs(a[1]) * b[1]) + std::fabs(a[2]) * b[2];
}

// An axis shorter than this is left out (E8).
constexpr double kNoAxis = 0x1p-400;

}  // namespace

BoxPair::BoxPair(const Box& a, const Box& b)
    : half_a(triple(0.5 * a.edges())),
      half_b(triple(0.5 * b.edges())),
      reach(a.circumradius() + 2.0 * b.circumradius()) {}

PlacedBox::PlacedBox(const Transformd& p)
    : centre(triple(p.translation)),
      column{{{p.row_x.x, p.row_y.x, p.row_z.x}, {p.row_x.y, p.row_y.y, p.row_z.y}, {p.row_x.z, p.row_y.z, p.row_z.z}}},
      norm_1_of_centre(norm_1(p.translation)) {
  for (std::size_t j = 0; j < 3; ++j) {
    const Triple &c = column[kNext[j]], &d = column[kAfterNext[j]];
    for (std::size_t i = 0; i < 3; ++i) {
      normal[j][i] = c[kNext[i]] * d[kAfterNext[i]] - c[kAfterNext[i]] * d[kNext[i]];
    }
  }
}

Outcome overlap_by_axes(const BoxPair& pair, const Transformd& a_from_b) {
  const PlacedBox b(a_from_b);
  const Triple &h = pair.half_a, &k = pair.half_b, &t = b.centre;
  const double error = 20.0 * kUnitRoundoff * (pair.reach + b.norm_1_of_centre);
  bool unsure = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap =
        (std::fabs(t[i]) - h[i]) -
        ((std::fabs(b.column[0][i]) * k[0] + std::fabs(b.column[1][i]) * k[1]) + std::fabs(b.column[2][i]) * k[2]);
    if (gap > error) return Outcome::disjoint;
    unsure = unsure || gap >= -error;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double gap = (std::fabs(inner(b.normal[j], t)) - inner_of_sizes(b.normal[j], h)) -
                       k[j] * std::fabs(inner(b.normal[j], b.column[j]));
    if (gap > error) return Outcome::disjoint;
    unsure = unsure || gap >= -error;
  }
  // The axis e_i x c_j is two coordinates of c_j, exactly, and its products with the other columns are coordinates of
  // the normals, each computed with an error that is relative to the axis. The usual form takes R's entries for them:
  // true of an exact rotation, off by u of the boxes' size for a rounded one, however short the axis.
  for (std::size_t j = 0; j < 3; ++j) {
    const Triple& c = b.column[j];
    const Triple &n_1 = b.normal[kNext[j]], &n_2 = b.normal[kAfterNext[j]];
    const double k_1 = k[kNext[j]], k_2 = k[kAfterNext[j]];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t p = kNext[i], q = kAfterNext[i];
      const double size_p = std::fabs(c[p]), size_q = std::fabs(c[q]);
      const double axis_error = error * (size_p + size_q);
      const double gap = (std::fabs(t[q] * c[p] - t[p] * c[q]) - (h[p] * size_q + h[q] * size_p)) -
                         (k_1 * std::fabs(n_2[i]) + k_2 * std::fabs(n_1[i]));
      if (gap > axis_error) {
        if (size_p + size_q > kNoAxis) return Outcome::disjoint;
      } else {
        unsure = unsure || (gap >= -axis_error && size_p + size_q > kNoAxis);
      }
    }
  }
  return unsure ? Outcome::undecided : Outcome::overlap;
}

EdgesAndSlabs edges_of_b_against_a(const BoxPair& pair, const PlacedBox& b) {
  EdgesAndSlabs result{b.centre, {}, pair.half_a};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) result.half_edge[j][i] = pair.half_b[j] * b.column[j][i];
  }
  return result;
}

EdgesAndSlabs edges_of_a_against_b(const BoxPair& pair, const PlacedBox& b) {
  EdgesAndSlabs result;
  for (std::size_t j = 0; j < 3; ++j) {
    result.centre[j] = -inner(b.normal[j], b.centre);
    result.half_width[j] = pair.half_b[j] * std::fabs(inner(b.normal[j], b.column[j]));
    for (std::size_t i = 0; i < 3; ++i) result.half_edge[i][j] = pair.half_a[i] * b.normal[j][i];
  }
  return result;
}

Outcome edges_meet_solid(const EdgesAndSlabs& edges, double error, double reach) {
  bool unsure = false;
  const double least = 0x1p-200 * reach;
  for (std::size_t j = 0; j < 3; ++j) {
    // Along an edge: x = middle + s * half_edge, -1 <= s <= 1. In slab i s is within `width` of `at`.
    Triple at, to_next, to_after, width, slack;
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = edges.half_edge[j][i];
      const double per_length = 1.0 / (std::fabs(along) < least ? std::copysign(least, along) : along);
      at[i] = -edges.centre[i] * per_length;
      to_next[i] = edges.half_edge[kNext[j]][i] * per_length;
      to_after[i] = edges.half_edge[kAfterNext[j]][i] * per_length;
      width[i] = edges.half_width[i] * std::fabs(per_length);
      slack[i] = error * std::fabs(per_length);
    }
    for (int corner = 0; corner < 4; ++corner) {
      const double sign_next = (corner & 1) != 0 ? 1.0 : -1.0, sign_after = (corner & 2) != 0 ? 1.0 : -1.0;
      Triple middle;
      for (std::size_t i = 0; i < 3; ++i) middle[i] = at[i] + (sign_next * to_next[i] + sign_after * to_after[i]);
      const auto meets = [&](double side) {
        double enter = -1.0, leave = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double w = width[i] + side * slack[i];
          enter = std::max(enter, middle[i] - w);
          leave = std::min(leave, middle[i] + w);
        }
        return enter <= leave;
      };
      if (!meets(1.0)) continue;
      if (meets(-1.0)) return Outcome::overlap;
      unsure = true;
    }
  }
  return unsure ? Outcome::undecided : Outcome::disjoint;
}

Outcome overlap_by_edges(const BoxPair& pair, const Transformd& a_from_b) {
  const PlacedBox b(a_from_b);
  const double reach = pair.reach + b.norm_1_of_centre;
  const double error = 40.0 * kUnitRoundoff * reach;
  const Outcome of_b = edges_meet_solid(edges_of_b_against_a(pair, b), error, reach);
  if (of_b == Outcome::overlap) return of_b;
  const Outcome of_a = edges_meet_solid(edges_of_a_against_b(pair, b), error, reach);
  if (of_a == Outcome::overlap) return of_a;
  return of_a == Outcome::undecided ? of_a : of_b;
}

}  // namespace vex
