// Bodies and non-bodies for the tests of meshes/, as soups.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/polygon_soup.h"

namespace vex::tests {

using Face = std::vector<std::uint32_t>;

/// One part; coordinates are rounded to 32-bit floats.
PolygonSoup soup_of(const std::vector<Vec3d>& points, const std::vector<Face>& faces);

PolygonSoup box_soup(const Vec3d& low, const Vec3d& high);  // quads
PolygonSoup tetrahedron_soup();                             // (1,1,1), (1,-1,-1), ...: exact in floats
PolygonSoup octahedron_soup();
PolygonSoup dodecahedron_soup();  // pentagons, planar to rounding
PolygonSoup icosahedron_soup();

/// A regular icosahedron's faces cut into `n` x `n` triangles, each vertex moved to the unit sphere and then by
/// `place`.
PolygonSoup sphere_soup(int n, const std::function<Vec3d(const Vec3d&)>& place);
/// A capsule about the z axis, `n` points around: caps of radius 1, `n_rings` rings of the straight part of length 2.
PolygonSoup capsule_soup(int n, int n_rings);
/// A surface of revolution about z: rings of `n` points with (radius, z), closed by a pole at either end.
PolygonSoup revolution_soup(int n, const std::vector<std::array<double, 2>>& rings, double z_low, double z_high);

/// Kepler-Poinsot: twelve faces through the icosahedron's vertices, and twenty. Neither is convex.
PolygonSoup great_dodecahedron_soup();
PolygonSoup great_icosahedron_soup();
PolygonSoup torus_soup(int n);
PolygonSoup l_prism_soup();  // two concave hexagons and six quads

PolygonSoup moved(PolygonSoup soup, const std::function<Vec3d(const Vec3d&)>& place);
PolygonSoup joined(PolygonSoup a, const PolygonSoup& b);
PolygonSoup turned(PolygonSoup soup);  // every face reversed
PolygonSoup face_turned(PolygonSoup soup, std::size_t f);
/// Face f with `vertex` put in before its corner k.
PolygonSoup corner_added(PolygonSoup soup, std::size_t f, std::size_t k, std::uint32_t vertex);
PolygonSoup face_removed(PolygonSoup soup, std::size_t f);
PolygonSoup shuffled(const PolygonSoup& soup, std::uint64_t seed);  // points, faces and first corners in another order

}  // namespace vex::tests
