// The convex hull of points, exactly.
//
// Qhull computes in double and merges what is coplanar to rounding, which costs two things here. A body 10^-6 thick
// knew its volume to 10^-10 only. And its time is quadratic in the number of corners of one facet: 40 s for a prism
// with 10^5 sides that takes 0.6 s below. So mesh hulls are made here, and Qhull (hull.h) is the second opinion.
#pragma once

#include <optional>
#include <span>

#include "engine/numeric/vec3.h"
#include "meshes/triangles.h"

namespace vex {

/// Triangles that are convex exactly, every one with area, and above which no point lies. A point in a facet or an edge
/// may be a corner of triangles or not. The points are joined one after another to a tetrahedron of four of them, by
/// flips (Edelsbrunner and Shah, "Incremental topological flipping works for regular triangulations", Algorithmica 15,
/// 1996), and every sign is exact (exact_sign.h, which says what coordinates may be). Time is near-linear; memory
/// beyond the points is 56 bytes for each, and 48 more for each that is a corner. Nothing where all points lie in one
/// plane, or so near to one that no point inside is a vertex and a step in double from it. Throws InputError where the
/// points lie so that every order tried takes more than a bounded number of steps for each.
std::optional<Triangles> exact_hull(std::span<const Vec3d> points);

}  // namespace vex
