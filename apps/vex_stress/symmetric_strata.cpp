// Placements that random ones never are: balls that touch in exact arithmetic, and curved bodies whose axes or planes
// of symmetry fall together.
#include <array>

#include "apps/vex_stress/bodies.h"
#include "apps/vex_stress/strata.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

// Whole vectors of whole length.
struct WholeVector {
  double x, y, z, length;
};
constexpr std::array<WholeVector, 6> kWholeVectors = {
    {{0, 0, 1, 1}, {0, 3, 4, 5}, {1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}, {2, 6, 9, 11}}};

// The sum of the radii is 5 * 7 * 9 * 11, in units of 2^-11: the multiple of every vector above is whole.
constexpr double kUnit = 0x1p-11, kRadiusA = 1234.0 * kUnit, kRadii = 3465.0 * kUnit, kRadiusB = kRadii - kRadiusA;

std::vector<StressPair> touching_pairs() {
  const ConvexBody ball_a = Sphere(kRadiusA), ball_b = Sphere(kRadiusB);
  const ConvexBody rod_a = Capsule(1.5, kRadiusA), rod_b = Capsule(0.75, kRadiusB);
  const Box slab(1.0, 0.5, 2.0), bar(0.25, 3.0, 1.0);
  const ConvexBody box_a = Rounded(slab, slab.measures(), kRadiusA), box_b = Rounded(bar, bar.measures(), kRadiusB);
  std::vector<StressPair> pairs;
  pairs.emplace_back("balls", ball_a, ball_b);
  pairs.emplace_back("ball and capsule", ball_a, rod_b);
  pairs.emplace_back("capsules", rod_a, rod_b);
  pairs.emplace_back("capsule and rounded box", rod_a, box_b);
  pairs.emplace_back("rounded boxes", box_a, box_b);
  return pairs;
}

// Axes taken to axes, one to its opposite or none.
Transformd axes_to_axes(Draw& draw) {
  const std::array<Vec3d, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::size_t k = draw.below(3);
  const double first = draw.sign(), second = draw.sign();
  return {first * axes[k], second * axes[(k + 1) % 3], (first * second) * axes[(k + 2) % 3], {}};
}

// The corners of the cores, all of whose coordinates are whole multiples of 2^-3, are moved apart by a whole vector as
// long as the radii together: they touch, and no sum rounds. Half of the poses are left there, others are moved by the
// last bit of a coordinate or by a distance of the usual sizes.
StressPose place_touching(const StressPair& pair, Draw& draw) {
  const Transformd turn = axes_to_axes(draw);
  const WholeVector& whole = kWholeVectors[draw.below(kWholeVectors.size())];
  std::array<double, 3> entries = {whole.x, whole.y, whole.z};
  std::swap(entries[draw.below(3)], entries[draw.below(3)]);
  for (double& entry : entries) entry *= draw.sign() * (kRadii / whole.length);
  const Vec3d apart{entries[0], entries[1], entries[2]};
  const auto farthest = [](const std::vector<Vec3d>& points, const Vec3d& dir) {
    Vec3d best = points.front();
    for (const Vec3d& p : points) best = dot(p, dir) > dot(best, dir) ? p : best;
    return best;
  };
  const Vec3d p_a = farthest(pair.form_a.points, apart);
  const Vec3d p_b = farthest(pair.form_b.points, turn.direction_to_b(-apart));
  StressPose pose = with_points_at(p_a, p_b, turn, (1.0 / norm(apart)) * apart, 0.0);
  Vec3d& t = pose.a_from_b.translation;
  t = t + apart;
  const double kind = draw();
  if (kind > 0.8) {
    t = t + random_distance(pair, draw) * pose.normal;
  } else if (kind > 0.5) {
    double& moved = kind > 0.7 ? t.x : kind > 0.6 ? t.y : t.z;
    moved = std::nextafter(moved, draw.sign() * HUGE_VAL);
  }
  return pose;
}

// A turn about z (of the axis of every named body of revolution), or from end to end.
Transformd about_the_axis(Draw& draw) {
  const double angle = draw() < 0.5 ? 0.0 : draw.between(0.0, 6.2831853), end = draw.sign();
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, -s, 0.0}, {end * s, end * c, 0.0}, {0.0, 0.0, end}, {}};
}

Transformd within_a_plane(Draw& draw) {
  const double angle = draw.between(0.0, 6.2831853), c = std::cos(angle), s = std::sin(angle);
  return {{c, 0.0, s}, {0.0, 1.0, 0.0}, {-s, 0.0, c}, {}};
}

StressPose place_concentric(const StressPair& pair, Draw& draw) {
  const double kind = draw();
  Transformd turn = kind < 0.3   ? axes_to_axes(draw)
                    : kind < 0.6 ? about_the_axis(draw)
                    : kind < 0.8 ? within_a_plane(draw)
                                 : draw.rotation();
  const Vec3d centre_b = turn(pair.b.centre());
  turn.translation = pair.a.centre() - centre_b;
  // Exactly so; moved a little, along the common axis or anywhere; or moved far along the axis.
  const double moved = draw();
  if (moved > 0.7) {
    turn.translation.z += draw.between(-1.2, 1.2) * pair.size();
  } else if (moved > 0.4) {
    const Vec3d dir = draw() < 0.5 ? Vec3d{0.0, 0.0, 1.0} : draw.unit_direction();
    turn.translation = turn.translation + random_distance(pair, draw) * dir;
  }
  return {turn, {0.0, 0.0, 1.0}};
}

StressPose place_coaxial(const StressPair& pair, Draw& draw) {
  return beside_contact(pair, about_the_axis(draw), {0.0, 0.0, draw.sign()}, random_distance(pair, draw));
}

StressPose place_in_a_plane(const StressPair& pair, Draw& draw) {
  const double angle = draw.between(0.0, 6.2831853);
  return beside_contact(pair, within_a_plane(draw), {std::cos(angle), 0.0, std::sin(angle)},
                        random_distance(pair, draw));
}

// Every curved kind, and thin ones, for which concentric does not mean deep.
std::vector<StressPair> symmetric_pairs() {
  std::vector<StressPair> pairs = curved_pairs();
  for (StressPair& pair :
       named_pairs({"ellipsoid:1,1,1e-6", "ellipsoid:1e-6,1e-6,1", "disc:1 ellipsoid:0.5,0.5,1e-3",
                    "cylinder:1e-6,1 cylinder:2,1e-6", "disc:1 cylinder:3,0.01", "disc:1 disc:0.3", "disc:1 cone:1,0.3",
                    "ellipsoid:1,2,3 cylinder:1,0.5", "cone:1,0.5 hemisphere:0.3", "frustum:1,0.7,0.01 disc:0.7"})) {
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

std::vector<Stratum> symmetric_strata() {
  std::vector<Stratum> strata;
  strata.push_back({"touching/rounded", "balls, capsules, rounded boxes at exactly the sum of the radii, or an ulp off",
                    touching_pairs, place_touching});
  const std::string bodies = "every curved kind, thin ones too";
  strata.push_back({"symmetric/concentric", bodies, symmetric_pairs, place_concentric});
  strata.push_back({"symmetric/coaxial", bodies, symmetric_pairs, place_coaxial});
  strata.push_back({"symmetric/in-a-plane", bodies, symmetric_pairs, place_in_a_plane});
  return strata;
}

}  // namespace vex
