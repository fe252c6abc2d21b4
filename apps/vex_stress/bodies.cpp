#include "apps/vex_stress/bodies.h"

namespace vex {

std::vector<StressPair> named_pairs(std::initializer_list<const char*> texts) {
  std::vector<StressPair> pairs;
  for (const char* const text : texts) pairs.push_back(named_pair(text));
  return pairs;
}

std::vector<StressPair> polytope_pairs() {
  std::vector<StressPair> pairs =
      named_pairs({"box:1,1,1", "box:0.2,1,3", "tetrahedron:1.3", "octahedron:1", "dodecahedron:0.5", "icosahedron:0.7",
                   "plate:1,1.3", "box:1,1,1 needle:2", "box:0.2,1,3 tetrahedron:1", "plate:1,1 needle:3",
                   "dodecahedron:0.5 box:1,2,0.1"});
  const ConvexBody hull_100 = sphere_points(100, {1.0, 0.7, 1.3}, 1),
                   hull_1000 = sphere_points(1000, {1.0, 1.0, 1.0}, 2);
  pairs.emplace_back("hull of 100 points", hull_100, hull_100);
  pairs.emplace_back("hulls of 1000 and 100 points", hull_1000, hull_100);
  return pairs;
}

std::vector<StressPair> rounded_pairs() {
  return named_pairs({"sphere:0.6", "capsule:1,0.25", "sphere:1 box:1,1,1", "capsule:2,0.1 box:1,1,1",
                      "rounded:0.1,box:1,1,1", "rounded:0.2,plate:1,0.8", "rounded:0.1,tetrahedron:1 capsule:1,0.3",
                      "sphere:0.5 octahedron:1", "rounded:0.01,box:1,2,3 icosahedron:0.7"});
}

std::vector<StressPair> curved_pairs() {
  return named_pairs({"ellipsoid:1,2,3", "cylinder:1,0.5", "cone:1,0.5", "frustum:1,0.7,0.3", "hemisphere:0.8",
                      "disc:0.7", "rounded:0.2,cylinder:1,0.5", "box:1,1,1 ellipsoid:0.5,0.5,1.5",
                      "cylinder:0.1,1 box:0.2,1,3", "cone:1,0.5 cylinder:1,0.5", "disc:0.7 needle:2",
                      "hemisphere:0.8 tetrahedron:1.3", "sphere:0.6 ellipsoid:1,2,3", "capsule:1,0.25 cylinder:1,0.5",
                      "rounded:0.1,disc:1 cone:0.2,1", "ellipsoid:1,1,0.1 plate:1,1"});
}

std::vector<StressPair> parallel_pairs() {
  return named_pairs({"box:1,1,1", "box:0.2,1,3", "box:1,1,1 box:0.3,0.7,0.1", "octahedron:1 box:1,1,1", "plate:1,1.3",
                      "plate:1,1 box:1,1,1", "cylinder:1,0.5", "cylinder:1,0.5 box:1,1,1", "disc:0.7", "cone:1,0.5",
                      "hemisphere:0.8 box:1,1,1", "capsule:1,0.25", "rounded:0.1,box:1,1,1",
                      "frustum:1,0.7,0.3 disc:1"});
}

std::vector<StressPair> feature_pairs() {
  return named_pairs({"box:1,1,1", "box:0.2,1,3", "tetrahedron:1.3", "octahedron:1", "dodecahedron:0.5",
                      "icosahedron:0.7", "box:1,1,1 tetrahedron:1", "octahedron:1 icosahedron:0.5",
                      "dodecahedron:0.5 box:1,2,0.1"});
}

std::vector<StressPair> identical_polytope_pairs() {
  std::vector<StressPair> pairs = named_pairs({"box:1,1,1", "box:0.2,1,3", "tetrahedron:1.3", "octahedron:1",
                                               "dodecahedron:0.5", "icosahedron:0.7", "plate:1,1.3"});
  const ConvexBody hull = sphere_points(100, {1.0, 1.0, 1.0}, 3);
  pairs.emplace_back("hull of 100 points", hull, hull);
  return pairs;
}

std::vector<StressPair> identical_curved_pairs() {
  return named_pairs({"sphere:0.6", "capsule:1,0.25", "rounded:0.1,tetrahedron:1", "ellipsoid:1,2,3", "cylinder:1,0.5",
                      "cone:1,0.5", "frustum:1,0.7,0.3", "hemisphere:0.8", "disc:0.7"});
}

Polytope sphere_points(std::size_t n, const Vec3d& stretch, std::uint64_t seed, const Vec3d& offset) {
  std::vector<Vec3d> points;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3d d = Draw(seed, "points of a hull", k).unit_direction();
    points.push_back({stretch.x * d.x + offset.x, stretch.y * d.y + offset.y, stretch.z * d.z + offset.z});
  }
  return {points, offset, 0.0};
}

}  // namespace vex
