// Where the surface and the mean curvature of a superellipsoid face.
//
// With g the norm whose unit ball the body is, d = grad g is a point of the dual body, along the normal. Of the point
// with the shares t of (x/a)^p and 1 - t of (y/b)^p in (1 - s)^(p/q), and s = (z/c)^q, t and s in (0, 1),
//   d = (t^(1/p') r / a, (1-t)^(1/p') r / b, s^(1/q') / c),   r = (1-s)^(1/q'),   1/p + 1/p' = 1/q + 1/q' = 1,
// and by Dirichlet's integrals a function f has over the surface, in the first octant,
//   the integral of f dS = a b c / (p q) * that of |d| f t^(1/p-1) (1-t)^(1/p-1) s^(1/q-1) (1-s)^(2/q-1) dt ds.
// Twice the mean curvature is (Laplacian g - n . Hess g n) / |d|. The Hessian is the sum of two terms of rank one,
// (p - 1) r^.. k k^T with k = (y, -x, 0) across z, and (q - 1) r^.. e e^T with e in the plane of z and the normal; and
// k k^T gives |d x k|^2 / |d|^2. Written out no term cancels another:
//   |d x k|^2 = s^(2/q') / c^2 (x^2/b^2 + y^2/a^2) + r^2 / (a b)^2,   x = t^(1/p), y = (1-t)^(1/p),
//   |d x e|^2 = (t^(2/p') / a^2 + (1-t)^(2/p') / b^2) / c^2.
// The densities' poles are taken up by the coordinates: each of t and s is a power of a uniform u that ends at 1/2, or
// one less such a power. So p = 1, where the term across is that of edges (its normals have t = 0), is no exception.
#pragma once

#include <vector>

#include "shapes/normal_measure.h"

namespace vex {

/// Of a mean over u in (0, 1) by the double exponential rule (H. Takahasi and M. Mori, 1974): algebraic singularities
/// at the ends do not matter to it.
struct UnitNode {
  double u, weight;
  bool is_coarse;  // also a node of twice the step, with twice the weight
};
std::vector<UnitNode> unit_nodes(double step);

/// Of p = 2 and a = b: t is taken together then, and w goes around z.
bool is_round(const SuperellipsoidNormals& part);

/// What hangs on t alone, in units of the semi-axes.
struct AcrossPlace {
  double x, y;            // t^(1/p), (1 - t)^(1/p)
  double dual_x, dual_y;  // t^(1/p'), (1 - t)^(1/p')
  double weight;          // of a mean over u in (0, 1) and both halves
};
/// t in (0, 1/2), or mirrored 1 - t there. Of one that is round any place stands for all.
AcrossPlace across_place(const SuperellipsoidNormals& part, bool is_mirrored, double u);

/// What hangs on s alone.
struct AlongPlace {
  double dual_z, rest;  // s^(1/q'), (1 - s)^(1/q')
  double weight;
};
/// s in (0, 1/2), or in (1/2, 1), the half at the pole.
AlongPlace along_place(const SuperellipsoidNormals& part, bool is_upper, double u);

/// In the first octant; the mean over both halves of t and s is a mean over the whole surface of a function that is
/// even in each coordinate.
WeightedNormal octant_normal(const SuperellipsoidNormals& part, const AcrossPlace& across, const AlongPlace& along);

/// The integral of the weights, to some 1e-10 where the body is not a thousand times as wide as thick.
double total_weight(const SuperellipsoidNormals& part);

/// v from pole to pole, w around z.
WeightedNormal superellipsoid_normal(const SuperellipsoidNormals& part, double v, double w);

}  // namespace vex
