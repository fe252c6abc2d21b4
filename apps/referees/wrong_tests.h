// Overlap tests of two boxes that suggest themselves and are wrong, to be shown wrong. Each misses or invents overlaps;
// the averages are what <V_ex> of two unit cubes at random orientations comes to (truly 11).
#pragma once

#include <vector>

#include "engine/query/overlap_backend.h"

namespace vex {

/// Does an edge of B meet A? Forgets the edges of A: 10.569, and in all fourteen rows the Monte Carlo values of Table I
/// of Sreenivasan, Baker, Paul, Stanley (2002), which were found faulty later.
BackendKind one_sided_backend();

/// Does an edge of B meet A, and an edge of A meet B? 10.138.
BackendKind edges_required_both_ways_backend();

/// Is a vertex of one inside the other? Forgets edges that cross: 9.661.
BackendKind vertices_either_way_backend();

/// Is a vertex of B inside A? 7.313.
BackendKind vertices_one_way_backend();

/// Does no face normal separate? Forgets the nine axes across two edges: 12.169. It invents
/// overlaps, also where the circumscribed balls do not meet: domains that hold all true contacts are too small for it,
/// but box_domain is not.
BackendKind face_normals_only_backend();

/// These five.
std::vector<BackendKind> wrong_box_backends();

}  // namespace vex
