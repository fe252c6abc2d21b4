#include <algorithm>
#include <cmath>

#include "apps/vex_stress/bodies.h"
#include "apps/vex_stress/known_failures.h"
#include "apps/vex_stress/strata.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/disc.h"
#include "shapes/needle.h"
#include "shapes/plate.h"

namespace vex {
namespace {

ConvexBody single_point() { return Polytope(std::vector<Vec3d>{{0.1, -0.2, 0.0}}, {0.1, -0.2, 0.0}, 0.0); }

// All in the plane z = 0.
std::vector<StressPair> flat_pairs() {
  // The needle of named bodies is along z: this one lies down.
  const ConvexBody needle = Polytope(std::vector<Vec3d>{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {}, 0.0);
  const ConvexBody plate = Plate(1.0, 1.3), disc = Disc(0.7);
  std::vector<StressPair> pairs;
  pairs.emplace_back("plates", plate, plate);
  pairs.emplace_back("needles", needle, needle);
  pairs.emplace_back("plate and needle", plate, needle);
  pairs.emplace_back("points", single_point(), single_point());
  pairs.emplace_back("plate and point", plate, single_point());
  pairs.emplace_back("needle and point", needle, single_point());
  pairs.emplace_back("discs", disc, disc);
  pairs.emplace_back("disc and needle", disc, needle);
  pairs.emplace_back("disc and plate", disc, plate);
  return pairs;
}

StressPose place_coplanar(const StressPair& pair, Draw& draw) {
  Transformd turn;
  if (draw() < 0.6) {
    const double angle = draw.between(0.0, 6.2831853);
    turn = {{std::cos(angle), -std::sin(angle), 0.0}, {std::sin(angle), std::cos(angle), 0.0}, {0.0, 0.0, 1.0}, {}};
  }
  if (draw() < 0.5) {  // rims touch within the plane
    const double angle = draw.between(0.0, 6.2831853);
    return beside_contact(pair, turn, {std::cos(angle), std::sin(angle), 0.0}, random_distance(pair, draw));
  }
  // One over the other, in the same plane or just off it.
  const double distance = draw() < 0.5 ? 0.0 : random_distance(pair, draw);
  StressPose pose{turn, {0.0, 0.0, distance < 0.0 ? -1.0 : 1.0}};
  const double reach = 0.7 * pair.size();
  pose.a_from_b.translation = {draw.between(-reach, reach), draw.between(-reach, reach), distance};
  return pose;
}

Vec3d point_within(const ExactForm& form, Draw& draw) {
  if (!form.points.empty()) {
    Vec3d p = form.points[draw.below(form.points.size())];
    for (int k = 0; k < 3; ++k) {
      const double s = draw();
      p = s * p + (1.0 - s) * form.points[draw.below(form.points.size())];
    }
    return p;
  }
  const ExactForm::Piece& piece = form.pieces[draw.below(form.pieces.size())];
  const Vec3d x = std::sqrt(draw()) * draw.unit_direction();
  return piece.centre + Vec3d{piece.semi_axes.x * x.x, piece.semi_axes.y * x.y, piece.semi_axes.z * x.z};
}

// Through each other at any angle: an inner point of one at an inner point of the other, or just off it.
StressPose place_crossing(const StressPair& pair, Draw& draw) {
  const Transformd turn = draw.rotation();
  const Vec3d first{1.0, 0.0, 0.0}, second = {turn.row_x.x, turn.row_y.x, turn.row_z.x};
  const Vec3d across = cross(first, second);
  const Vec3d normal = norm(across) > 1e-3 ? (1.0 / norm(across)) * across : Vec3d{0.0, 0.0, 1.0};
  const Vec3d p = point_within(pair.form_a, draw), q = point_within(pair.form_b, draw);
  return with_points_at(p, q, turn, normal, random_distance(pair, draw));
}

// Faces on faces: every coplanar vertex ties with all others.
StressPose place_flush(const StressPair& pair, Draw& draw) {
  const std::size_t axis = draw.below(3);
  const double sign = draw.sign();
  const Vec3d normal{axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0};
  StressPose pose = draw() < 0.5 ? beside_contact(pair, {}, normal, random_distance(pair, draw))
                                 : beside_contact(pair, draw.rotation(), normal, random_distance(pair, draw));
  return pose;
}

// A unit cube with n x n points, rounded, on each face, and its corners.
Polytope cube_with_points(int n) {
  std::vector<Vec3d> points = Box(1.0, 1.0, 1.0).vertices();
  for (int i = 1; i < n; ++i) {
    for (int j = 1; j < n; ++j) {
      const double u = static_cast<double>(i) / n - 0.5, v = static_cast<double>(j) / n - 0.5;
      for (const double side : {-0.5, 0.5}) {
        points.push_back({u, v, side});
        points.push_back({u, side, v});
        points.push_back({side, u, v});
      }
    }
  }
  return {points, {}, 0.5};
}

std::vector<StressPair> coplanar_hulls() {
  std::vector<StressPair> pairs;
  const ConvexBody cube_4 = cube_with_points(4), cube_7 = cube_with_points(7);
  pairs.emplace_back("cubes of 62 points", cube_4, cube_4);
  pairs.emplace_back("cubes of 224 and 62 points", cube_7, cube_4);
  pairs.emplace_back("cube of 224 points and box", cube_7, Box(1.0, 2.0, 0.3));
  return pairs;
}

std::vector<StressPair> slivers() {
  std::vector<StressPair> pairs;
  for (const double thickness : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const ConvexBody sliver =
        Polytope(std::vector<Vec3d>{{1.0, 0.0, 0.0}, {-0.5, 0.8, 0.0}, {-0.5, -0.8, 0.0}, {0.1, 0.0, thickness}},
                 {0.025, 0.0, 0.25 * thickness}, 0.0);
    pairs.emplace_back("slivers", sliver, sliver);
    pairs.emplace_back("sliver and cube", sliver, Box(1.0, 1.0, 1.0));
    const ConvexBody flat_hull = sphere_points(40, {1.0, 1.0, thickness}, 7);
    pairs.emplace_back("flat hulls", flat_hull, flat_hull);
  }
  return pairs;
}

std::vector<StressPair> huge_hulls() {
  std::vector<StressPair> pairs;
  const ConvexBody sphere = sphere_points(100'000, {1.0, 1.0, 1.0}, 9);
  pairs.emplace_back("sphere of 10^5 vertices and cube", sphere, Box(1.0, 1.0, 1.0));
  pairs.emplace_back("spheres of 10^5 vertices", sphere, sphere);
  return pairs;
}

std::vector<StressPair> known_failure_pairs() {
  std::vector<StressPair> pairs;
  for (const KnownFailure& known : kKnownFailures) {
    pairs.emplace_back(known.name, parse_shape(known.a).body, parse_shape(known.b).body);
  }
  return pairs;
}

// As reported, and moved by a distance of the usual sizes.
StressPose place_known_failure(const StressPair& pair, Draw& draw) {
  const auto* const known =
      std::ranges::find_if(kKnownFailures, [&pair](const KnownFailure& k) { return pair.name == k.name; });
  StressPose pose{known->a_from_b, {}};
  if (draw() < 0.3) return pose;
  Vec3d& t = pose.a_from_b.translation;
  t = t + random_distance(pair, draw) * (draw() < 0.5 ? draw.unit_direction() : (1.0 / norm(t)) * t);
  return pose;
}

}  // namespace

std::vector<Stratum> degenerate_strata() {
  std::vector<Stratum> strata;
  strata.push_back({"degenerate/coplanar", "plates, needles, points, discs in one plane", flat_pairs, place_coplanar});
  strata.push_back(
      {"degenerate/crossing", "plates, needles, points, discs through each other", flat_pairs, place_crossing});
  strata.push_back({"hull/coplanar", "cubes with many points on each face", coplanar_hulls, place_flush});
  strata.push_back({"hull/sliver", "tetrahedra and hulls of thickness 1e-6 to 1e-15", slivers, place_near});
  strata.push_back({"hull/1e5-vertices", "spheres of 10^5 vertices", huge_hulls, place_near});
  strata.back().most_poses = 20;
  strata.push_back(
      {"cases/known-failures", "reported against FCL, libccd, Jolt, Bullet", known_failure_pairs, place_known_failure});
  return strata;
}

}  // namespace vex
