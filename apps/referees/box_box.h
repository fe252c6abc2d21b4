// Do two boxes share a point? By the separating-axis test, and by edges of one that meet the other.
//
// Both answer about the placed vertices of B (docs/derivations.md, "What the input is"), and leave what is within
// rounding of contact undecided.
#pragma once

#include <array>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "shapes/box.h"

namespace vex {

using Triple = std::array<double, 3>;

struct BoxPair {
  BoxPair(const Box& a, const Box& b);
  Triple half_a, half_b;  // edges
  double reach;           // |x| over A, and twice that over B: W of E8 without the translation
};

/// B as a parallelepiped in A's frame. R is taken as it is: its columns need not be orthonormal.
struct PlacedBox {
  explicit PlacedBox(const Transformd& a_from_b);
  Triple centre;
  std::array<Triple, 3> column;  // directions of B's edges: R's columns
  std::array<Triple, 3> normal;  // of B's faces: normal[j] = column[j+1] x column[j+2], rounded
  double norm_1_of_centre;
};

/// The 15 axes of S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 96, section 5; three-valued (E8).
Outcome overlap_by_axes(const BoxPair& pair, const Transformd& a_from_b);

/// Twelve parallelepiped edges against a solid of three slabs. Coordinates are those across the slabs.
struct EdgesAndSlabs {
  Triple centre;                    // of the parallelepiped
  std::array<Triple, 3> half_edge;  // half an edge of each of the three directions
  Triple half_width;                // of the slabs, about the origin
};
EdgesAndSlabs edges_of_b_against_a(const BoxPair& pair, const PlacedBox& b);
EdgesAndSlabs edges_of_a_against_b(const BoxPair& pair, const PlacedBox& b);

/// Clips every edge by the slabs (M. Cyrus, J. Beck, Computers & Graphics 3, 23 (1978); Y.-D. Liang, B. A. Barsky, ACM
/// Trans. Graphics 3, 1 (1984)). `overlap` where an edge meets the solid even if each slab is thinner by `error` on
/// both sides, `disjoint` where no edge does even if each is thicker; at error 0 there is no third answer. `reach`
/// bounds every coordinate.
Outcome edges_meet_solid(const EdgesAndSlabs& edges, double error, double reach);

/// Two boxes share a point where an edge of one meets the other, asked both ways (D. R. Baker, G. Paul, S. Sreenivasan,
/// H. E. Stanley, Phys. Rev. E 66, 046136 (2002)); three-valued (E9). Undecided also far from contact where edges lie
/// in the other's faces to within rounding and no other edge decides: parallel boxes are a case for the axes.
Outcome overlap_by_edges(const BoxPair& pair, const Transformd& a_from_b);

}  // namespace vex
