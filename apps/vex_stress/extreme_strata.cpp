#include <cmath>
#include <cstdlib>

#include "apps/vex_stress/bodies.h"
#include "apps/vex_stress/strata.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "shapes/tetrahedron.h"

namespace vex {
namespace {

// Against itself and against a body without an aspect.
std::vector<StressPair> with_itself_and(const ConvexBody& body, const ConvexBody& plain, const std::string& name) {
  std::vector<StressPair> pairs;
  pairs.emplace_back(name, body, body);
  pairs.emplace_back(name + " and a plain one", body, plain);
  return pairs;
}

std::vector<StressPair> boxes_of_ratio(double ratio) {
  return with_itself_and(Box(1.0, 1.0, ratio), Box(1.0, 1.0, 1.0), "box");
}
std::vector<StressPair> ellipsoids_of_ratio(double ratio) {
  return with_itself_and(Ellipsoid(1.0, 1.0, ratio), Sphere(1.0), "ellipsoid");
}
std::vector<StressPair> cylinders_of_ratio(double ratio) {
  return with_itself_and(Cylinder(ratio, 0.5), Box(1.0, 1.0, 1.0), "cylinder");
}
std::vector<StressPair> cones_of_ratio(double ratio) {
  return with_itself_and(Cone(ratio, 0.5), Ellipsoid(1.0, 2.0, 3.0), "cone");
}
std::vector<StressPair> rounded_of_ratio(double ratio) {
  return with_itself_and(Capsule(ratio, 0.5), Box(1.0, 1.0, 1.0), "capsule");
}

// One of each kind, `scale` times as large as a unit body.
std::vector<std::pair<std::string, ConvexBody>> bodies_of_size(double scale) {
  const std::vector<Vec3d> corners = {
      {scale, scale, scale}, {scale, -scale, -scale}, {-scale, scale, -scale}, {-scale, -scale, scale}};
  return {{"box", Box(scale, 2.0 * scale, 0.5 * scale)},
          {"tetrahedron", Polytope(corners, {}, 0.5 * scale)},
          {"sphere", Sphere(scale)},
          {"capsule", Capsule(scale, 0.3 * scale)},
          {"ellipsoid", Ellipsoid(scale, 2.0 * scale, 3.0 * scale)},
          {"cylinder", Cylinder(scale, scale)},
          {"cone", Cone(scale, 0.5 * scale)}};
}

// Every kind with itself and with the next one.
std::vector<StressPair> pairs_of_sizes(double scale_a, double scale_b) {
  const auto of_a = bodies_of_size(scale_a), of_b = bodies_of_size(scale_b);
  std::vector<StressPair> pairs;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    for (const std::size_t other : {k, (k + 1) % of_a.size()}) {
      pairs.emplace_back(of_a[k].first + " " + of_b[other].first, of_a[k].second, of_b[other].second);
    }
  }
  return pairs;
}

// Bodies that lie far from the origin of their own frame; the pose brings them back.
std::vector<StressPair> far_pairs(double offset) {
  const Vec3d away = {0.6 * offset, -0.3 * offset, 0.7 * offset};
  const Polytope hull = sphere_points(60, {1.0, 0.8, 1.2}, 5, away);
  std::vector<Vec3d> corners;
  for (const Vec3d& v : Box(1.0, 1.0, 1.0).vertices()) corners.push_back(v + away);
  const Polytope cube(corners, away, 0.25);
  std::vector<StressPair> pairs;
  pairs.emplace_back("two far cubes", cube, cube);
  pairs.emplace_back("far cube and box", cube, Box(1.0, 2.0, 0.5));
  pairs.emplace_back("box and far hull", Box(1.0, 2.0, 0.5), hull);
  pairs.emplace_back("far hull and far cube", hull, cube);
  pairs.emplace_back("far cube and ellipsoid", cube, Ellipsoid(0.5, 0.7, 1.1));
  pairs.emplace_back("cone and far hull", Cone(1.0, 0.5), hull);
  return pairs;
}

std::string power_text(int exponent) { return "1e" + std::to_string(exponent); }

}  // namespace

std::vector<Stratum> extreme_strata() {
  std::vector<Stratum> strata;
  struct Kind {
    const char* name;
    std::vector<StressPair> (*pairs)(double ratio);
  };
  for (const Kind& kind :
       {Kind{"boxes", boxes_of_ratio}, Kind{"rounded", rounded_of_ratio}, Kind{"ellipsoids", ellipsoids_of_ratio},
        Kind{"cylinders", cylinders_of_ratio}, Kind{"cones", cones_of_ratio}}) {
    for (const int exponent : {-9, -6, -3, 3, 6, 9}) {
      const double ratio = std::pow(10.0, exponent);
      strata.push_back({"aspect/" + std::string(kind.name) + "/" + power_text(exponent),
                        "plates or needles with themselves and with a plain body",
                        [ratio, pairs = kind.pairs] { return pairs(ratio); }, place_near});
      strata.back().has_band = std::abs(exponent) <= 6;
    }
  }
  for (const int exponent : {-12, -9, -6, -3, 3, 6, 9, 12}) {
    const double ratio = std::pow(10.0, exponent);
    strata.push_back({"size-ratio/" + power_text(exponent), "every kind; B is so much larger than A",
                      [ratio] { return pairs_of_sizes(1.0, ratio); }, place_near});
  }
  for (const int exponent : {-150, -100, -50, -20, 20, 50, 100, 150}) {
    const double scale = std::pow(10.0, exponent);
    strata.push_back({"coordinates/" + power_text(exponent), "every kind, of this size",
                      [scale] { return pairs_of_sizes(scale, scale); }, place_near});
  }
  for (const int exponent : {3, 4, 5, 6, 7, 8, 10, 12, 14}) {
    const double offset = std::pow(10.0, exponent);
    strata.push_back({"far-from-origin/" + power_text(exponent),
                      "polytopes so far from the origin of their frame, and plain curved bodies",
                      [offset] { return far_pairs(offset); }, place_near});
  }
  return strata;
}

}  // namespace vex
