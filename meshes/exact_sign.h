// Signs of determinants of points, always right: -1, 0 or 1.
//
// Nearly all are sure in double; the others are summed without any rounding, as expansions (Shewchuk, "Adaptive
// precision floating-point arithmetic and fast robust geometric predicates", Discrete & Computational Geometry 18,
// 1997). Coordinates are 0 or between 2^-300 and 2^300 in magnitude, so that no product of three loses its last bit.
#pragma once

#include "engine/numeric/vec3.h"
#include "meshes/polyhedron_measures.h"

namespace vex {

/// 1 where d lies above the plane of a, b, c seen counter-clockwise; 0 where it lies in it.
int orientation_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// The sign of det(a - o, b - o, c - o), of which each `..._local` is o.to(...).value().
int determinant_sign(const LocalPoint& o, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& a_local,
                     const Vec3d& b_local, const Vec3d& c_local);

/// Whether a, b and c lie on one line.
bool collinear(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace vex
