#include "engine/query/first_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "engine/numeric/pose_algebra.h"
#include "engine/numeric/rounding.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/scene/pose_batches.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/prism.h"
#include "shapes/sphere.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Real = long double;  // eleven bits more than the engine has

struct Real3 {
  Real x, y, z;
  explicit Real3(const Vec3d& v) : x(v.x), y(v.y), z(v.z) {}
};
Real dot(const Real3& a, const Real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Transformd moved_to(double x, double y, double z) {
  Transformd pose;
  pose.translation = {x, y, z};
  return pose;
}

// How far apart the bounds may be where nothing but the pair's own rounding keeps them apart: some E of E22 over the
// speed at which the bodies meet.
double width_bound(const FirstContact& contact, const Vec3d& dir, double reach) {
  return 128.0 * 40.0 * kUnitRoundoff * reach / std::fabs(dot(contact.normal, dir));
}

void expect_contact(const FirstContact& found, Real truth, const Vec3d& dir, double reach) {
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_LE(found.lower, truth);
  EXPECT_GE(found.upper, truth);
  EXPECT_LE(found.lower, found.time);
  EXPECT_LE(found.time, found.upper);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-15);
  EXPECT_LT(dot(found.normal, dir), 0.0) << "they move towards each other";
  EXPECT_LE(found.upper - found.lower, width_bound(found, dir, reach));
}

void expect_none(const FirstContact& found) {
  EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
  EXPECT_EQ(found.lower, HUGE_VAL);
  EXPECT_EQ(found.time, HUGE_VAL);
  EXPECT_EQ(found.upper, HUGE_VAL);
}

// --- closed forms: the time at which a ray enters, if it does

std::optional<Real> enters_ball(const Real3& o, const Real3& d, Real radius) {
  const Real a = dot(d, d), b = dot(o, d), c = dot(o, o) - radius * radius;
  const Real square = b * b - a * c;
  if (square < 0.0L || b > 0.0L) return std::nullopt;
  return c / (-b + std::sqrt(square));
}

std::optional<Real> enters_ellipsoid(const Vec3d& o, const Vec3d& d, const Vec3d& axes) {
  Real3 ball_o(o), ball_d(d);
  ball_o.x /= axes.x, ball_o.y /= axes.y, ball_o.z /= axes.z;
  ball_d.x /= axes.x, ball_d.y /= axes.y, ball_d.z /= axes.z;
  return enters_ball(ball_o, ball_d, 1.0L);
}

std::optional<Real> enters_box(const Vec3d& origin, const Vec3d& dir, const Vec3d& half) {
  const Real3 o(origin), d(dir), h(half);
  Real from = 0.0L, to = HUGE_VALL;
  for (const auto& [at, along, extent] : {std::array{o.x, d.x, h.x}, {o.y, d.y, h.y}, {o.z, d.z, h.z}}) {
    if (along == 0.0L) {
      if (std::fabs(at) > extent) return std::nullopt;
      continue;
    }
    from = std::max(from, (-std::copysign(extent, along) - at) / along);
    to = std::min(to, (std::copysign(extent, along) - at) / along);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

// Of a function that falls and rises once.
template <class Function>
std::optional<Real> first_zero(const Function& f, Real latest) {
  Real from = 0.0L, to = latest;
  for (int k = 0; k < 400; ++k) {
    const Real third = (to - from) / 3.0L;
    (f(from + third) < f(to - third) ? to : from) = f(from + third) < f(to - third) ? to - third : from + third;
  }
  Real inside = 0.5L * (from + to), outside = 0.0L;
  if (f(inside) > 0.0L) return std::nullopt;
  for (int k = 0; k < 100; ++k) {
    const Real middle = 0.5L * (inside + outside);
    (f(middle) > 0.0L ? outside : inside) = middle;
  }
  return inside;
}

struct Ray {
  Vec3d origin, dir;
};
// From outside towards a place near the body: about half of them hit.
Ray random_ray(std::mt19937_64& random, double distance, double spread) {
  const Vec3d dir = random_direction(random);
  return {spread * random_direction(random) - (distance / norm(dir)) * dir, dir};
}

template <class Truth>
void compare_with_closed_form(const ConvexBody& body, const Truth& truth, double spread, unsigned seed) {
  std::mt19937_64 random(seed);
  int n_hits = 0;
  constexpr int kRays = 4000;
  for (int k = 0; k < kRays; ++k) {
    const Ray ray = random_ray(random, 10.0, spread);
    const FirstContact found = cast_ray(body, ray.origin, ray.dir);
    const std::optional<Real> time = truth(ray.origin, ray.dir);
    if (!time) {
      expect_none(found);
      continue;
    }
    ++n_hits;
    expect_contact(found, *time, ray.dir, body.reach() + norm_1(ray.origin));
    EXPECT_LE(norm(found.point_a - found.point_b), 1e-9);
    EXPECT_LE(norm(found.point_b - (ray.origin + found.time * ray.dir)), 1e-15 * norm_1(ray.origin));
  }
  EXPECT_GT(n_hits, 0.3 * kRays);
  EXPECT_LT(n_hits, 0.7 * kRays);
}

TEST(CastRay, AgainstABallIsTheClosedForm) {
  const auto truth = [](const Vec3d& o, const Vec3d& d) { return enters_ball(Real3(o), Real3(d), 1.0L); };
  compare_with_closed_form(Sphere(1.0), truth, 1.7, 1);
}

TEST(CastRay, AgainstABoxIsTheClosedForm) {
  const auto truth = [](const Vec3d& o, const Vec3d& d) { return enters_box(o, d, {0.5, 1.0, 1.5}); };
  compare_with_closed_form(Box(1.0, 2.0, 3.0), truth, 2.3, 2);
}

TEST(CastRay, AgainstAnEllipsoidIsTheClosedFormAlsoOfAFlatOne) {
  for (const Vec3d& axes : {Vec3d{1.0, 2.0, 3.0}, Vec3d{1.0, 1e-3, 2.0}}) {
    const auto truth = [&](const Vec3d& o, const Vec3d& d) { return enters_ellipsoid(o, d, axes); };
    compare_with_closed_form(Ellipsoid(axes.x, axes.y, axes.z), truth, axes.y < 1.0 ? 1.3 : 3.3, 3);
  }
}

TEST(CastRay, ThroughCornersEdgesAndMiddlesHits) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  for (const Vec3d& dir : {Vec3d{-1.0, -1.0, -1.0}, Vec3d{-1.0, -1.0, 0.0}, Vec3d{-1.0, 0.0, 0.0},
                           Vec3d{-1.0, -0.25, -0.25}, Vec3d{-1.0, -1.0, -0.25}}) {
    const FirstContact found = cast_ray(cube, -2.0 * dir, dir);
    ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
    EXPECT_LE(found.lower, 1.5);
    EXPECT_GE(found.upper, 1.5);
    EXPECT_LE(found.upper - found.lower, 1e-12);
  }
}

// Past an edge by some 2^-52: of polytopes, points among them, every ray is decided, and right.
TEST(CastRay, ThatNearlyMissesIsNotSaidToHitNorTheOtherWayRound) {
  const ConvexBody box = Box(1.0, 2.0, 3.0);
  std::mt19937_64 random(10);
  int n_hits = 0, n_misses = 0;
  for (int k = 0; k < 2000; ++k) {
    const double off = std::ldexp(std::round(8.0 * (2.0 * random_in_unit_interval(random) - 1.0)), -54 + k % 16);
    const double along = 0.5 * std::round(8.0 * random_in_unit_interval(random)) / 4.0 - 0.5;
    // Past an edge along a face, or across the edge, with coordinates that are exact.
    const Vec3d dir = k % 2 == 0 ? Vec3d{-1.0, 0.0, 0.0} : Vec3d{-1.0, 1.0, 0.0};
    const Vec3d place = k % 2 == 0 ? Vec3d{0.5, 1.0 + off, along} : Vec3d{0.5 + off, 1.0, along};
    const Vec3d origin = place - 2.0 * dir;
    const bool hits = k % 2 == 0 ? origin.y <= 1.0 : origin.x + origin.y <= 1.5;
    const FirstContact found = cast_ray(box, origin, dir);
    ASSERT_EQ(found.verdict.outcome, hits ? Outcome::overlap : Outcome::disjoint) << k;
    ++(hits ? n_hits : n_misses);
  }
  EXPECT_GT(n_hits, 200);
  EXPECT_GT(n_misses, 200);
}

TEST(CastRay, HitsAFlatBodyFromOutside) {
  for (const char* name : {"plate:1,1", "disc:1"}) {
    const ConvexBody body = parse_shape(name).body;
    for (const Vec3d& at : {Vec3d{0.0, 0.0, 0.0}, Vec3d{0.25, 0.25, 0.0}, Vec3d{0.4, -0.1, 0.0}}) {
      const Vec3d dir{0.1, 0.2, -1.0};
      expect_contact(cast_ray(body, at - 2.0 * dir, dir), 2.0L, dir, 10.0);
    }
    expect_none(cast_ray(body, {3.0, 0.0, 2.0}, {0.0, 0.0, -1.0}));
    expect_none(cast_ray(body, {0.0, 0.0, 2.0}, {0.0, 0.0, 1.0}));
  }
}

TEST(CastRay, FromInsideIsContactAtTheStart) {
  const ConvexBody box = Box(1.0, 1.0, 4.0);
  const FirstContact found = cast_ray(box, {0.4, 0.0, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(found.lower, 0.0);
  EXPECT_EQ(found.time, 0.0);
  EXPECT_EQ(found.upper, 0.0);
  EXPECT_NEAR(found.normal.x, 1.0, 1e-12) << "the shortest way out";
}

TEST(CastRay, OfADirectionOfAnyLengthAndFromAnyDistanceIsFound) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  for (const int exponent : {-1000, -100, 100, 900}) {
    const double length = std::ldexp(1.0, exponent);
    const FirstContact found = cast_ray(cube, {2.0, 0.1, 0.2}, {-length, 0.0, 0.0});
    const FirstContact of_unit = cast_ray(cube, {2.0, 0.1, 0.2}, {-1.0, 0.0, 0.0});
    EXPECT_EQ(found.lower, std::ldexp(of_unit.lower, -exponent));
    EXPECT_EQ(found.upper, std::ldexp(of_unit.upper, -exponent));
  }
  for (const double distance : {1e3, 1e6, 1e9}) {
    const Vec3d dir{-1.0, -0.2, 0.3};
    expect_contact(cast_ray(cube, -distance * dir, dir), static_cast<Real>(distance) - 0.5L, dir, 2.0 * distance);
    expect_none(cast_ray(cube, -distance * dir + Vec3d{0.0, 1.5, 0.0}, dir));
  }
}

TEST(LinearCast, OfBallsIsTheClosedForm) {
  const ConvexBody a = Sphere(1.0), b = Sphere(0.25);
  std::mt19937_64 random(4);
  int n_hits = 0;
  for (int k = 0; k < 500; ++k) {
    const Ray ray = random_ray(random, 6.0, 2.1);
    const std::optional<Real> time = enters_ball(Real3(ray.origin), Real3(ray.dir), 1.25L);
    const Transformd pose = moved_to(ray.origin.x, ray.origin.y, ray.origin.z);
    const FirstContact found = linear_cast(a, b, pose, ray.dir);
    if (!time) {
      expect_none(found);
      continue;
    }
    ++n_hits;
    expect_contact(found, *time, ray.dir, 10.0);
    const Vec3d centre = ray.origin + found.time * ray.dir;
    EXPECT_LE(norm(found.point_a - 0.8 * centre), 1e-12);
    EXPECT_LE(norm(found.normal - 0.8 * centre), 1e-12);
  }
  EXPECT_GT(n_hits, 150);
  EXPECT_LT(n_hits, 350);
}

TEST(LinearCast, OfABallAgainstABoxAndACapsuleIsWhereTheirDistanceIsItsRadius) {
  const ConvexBody ball = Sphere(0.5);
  const auto from_box = [](const Real3& p) {
    const auto beyond = [](Real x, Real half) { return std::max(0.0L, std::fabs(x) - half); };
    return std::hypot(beyond(p.x, 0.5L), beyond(p.y, 1.0L), beyond(p.z, 1.5L));
  };
  const auto from_capsule = [](const Real3& p) {  // of length 2, radius 1/4
    return std::hypot(p.x, p.y, std::max(0.0L, std::fabs(p.z) - 1.0L)) - 0.25L;
  };
  const auto compare = [&](const ConvexBody& a, const auto& distance_of, double spread) {
    std::mt19937_64 random(5);
    int n_hits = 0;
    for (int k = 0; k < 300; ++k) {
      const Ray ray = random_ray(random, 8.0, spread);
      const auto gap = [&](Real t) {
        Real3 p(ray.origin);
        p.x += t * ray.dir.x, p.y += t * ray.dir.y, p.z += t * ray.dir.z;
        return distance_of(p) - 0.5L;
      };
      const std::optional<Real> time = first_zero(gap, 20.0L / static_cast<Real>(norm(ray.dir)));
      const Transformd pose = moved_to(ray.origin.x, ray.origin.y, ray.origin.z);
      const FirstContact found = linear_cast(a, ball, pose, ray.dir);
      if (time) {
        ++n_hits;
        expect_contact(found, *time, ray.dir, 14.0);
      } else {
        expect_none(found);
      }
    }
    EXPECT_GT(n_hits, 90);
    EXPECT_LT(n_hits, 210);
  };
  compare(Box(1.0, 2.0, 3.0), from_box, 2.6);
  compare(Capsule(2.0, 0.25), from_capsule, 1.9);
}

TEST(LinearCast, OfAlignedBoxesIsThatOfARayAgainstABox) {
  const ConvexBody a = Box(1.0, 2.0, 3.0), b = Box(0.5, 0.25, 4.0);
  std::mt19937_64 random(6);
  int n_hits = 0;
  for (int k = 0; k < 1000; ++k) {
    Ray ray = random_ray(random, 12.0, 3.7);
    if (k % 4 == 0) ray = {{12.0, ray.dir.y, ray.dir.z}, {-1.0, 0.0, 0.0}};  // face on face
    const std::optional<Real> time = enters_box(ray.origin, ray.dir, {0.75, 1.125, 3.5});
    const FirstContact found = linear_cast(a, b, moved_to(ray.origin.x, ray.origin.y, ray.origin.z), ray.dir);
    if (time) {
      ++n_hits;
      expect_contact(found, *time, ray.dir, 30.0);
    } else {
      expect_none(found);
    }
  }
  EXPECT_GT(n_hits, 300);
  EXPECT_LT(n_hits, 800);
}

TEST(LinearCast, OfBoxesThatSlideIsContactWhereTheyTouchAndNoneWhereTheyDoNot) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  const Vec3d left{-1.0, 0.0, 0.0};
  const FirstContact sliding = linear_cast(cube, cube, moved_to(0.5, 1.0, 0.0), left);
  EXPECT_EQ(sliding.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(sliding.upper, 0.0);
  EXPECT_NEAR(sliding.normal.y, 1.0, 1e-12);
  EXPECT_EQ(linear_cast(cube, cube, moved_to(0.0, 1.0, 0.0), {0.0, 1.0, 0.0}).upper, 0.0) << "and parts";
  expect_none(linear_cast(cube, cube, moved_to(0.0, 1.0 + 0x1p-40, 0.0), {0.0, 1.0, 0.0}));
  expect_none(linear_cast(cube, cube, moved_to(3.0, 1.0 + 1e-12, 0.0), left));
  expect_contact(linear_cast(cube, cube, moved_to(3.0, 1.0 - 1e-12, 0.0), left), 2.0L, left, 7.0);
  // Edge along edge: no bound tells, but whole numbers do.
  const FirstContact grazing = linear_cast(cube, cube, moved_to(3.0, 1.0, 0.0), left);
  expect_contact(grazing, 2.0L, left, 7.0);
  EXPECT_EQ(grazing.verdict.by, DecidedBy::exact);
}

TEST(LinearCast, OfPlatesInOnePlaneIsThatOfTheirSides) {
  const ConvexBody plate = parse_shape("plate:1,1").body;
  const Vec3d left{-1.0, 0.0, 0.0};
  for (const double height : {0.0, 0.25, 1.0}) {
    const FirstContact found = linear_cast(plate, plate, moved_to(2.25, height, 0.0), left);
    expect_contact(found, 1.25L, left, 8.0);
    EXPECT_EQ(found.verdict.by, DecidedBy::exact);
    EXPECT_NEAR(found.point_a.x, 0.5, 1e-12);
  }
  expect_none(linear_cast(plate, plate, moved_to(2.25, 0.0, 1e-12), left));
}

TEST(LinearCast, OfThinSmallAndLargeBodiesIsAsGoodAsTheirCoordinates) {
  for (const double thickness : {1e-3, 1e-6, 1e-9}) {
    const ConvexBody sheet = Box(1.0, 1.0, thickness);
    const Vec3d dir{0.01, 0.02, -1.0}, along{-1.0, 0.0, 0.0};
    expect_contact(linear_cast(sheet, sheet, moved_to(0.1, 0.2, 2.0), dir), 2.0L - static_cast<Real>(thickness), dir,
                   8.0);
    expect_contact(linear_cast(sheet, sheet, moved_to(2.0, 0.2, 0.25 * thickness), along), 1.0L, along, 8.0);
    expect_none(linear_cast(sheet, sheet, moved_to(2.0, 0.2, thickness + 1e-13), along));
  }
  for (const double size : {0x1p-300, 0x1p-30, 0x1p30, 0x1p300}) {
    const ConvexBody a = Box(size, size, size), b = Box(0.5 * size, 0.5 * size, 0.5 * size);
    const FirstContact found = linear_cast(a, b, moved_to(3.0 * size, 0.125 * size, 0.25 * size), {-1.0, 0.0, 0.0});
    expect_contact(found, 2.25L * static_cast<Real>(size), {-1.0, 0.0, 0.0}, 7.0 * size);
  }
}

// Where B starts, and where to: about half of the casts hit.
struct Cast {
  Transformd pose;
  Vec3d motion;
};
Cast random_cast(std::mt19937_64& random, const ConvexBody& a, const ConvexBody& b) {
  Cast cast{random_rotation(random), random_direction(random)};
  const Transformd turn = cast.pose;
  const double reach = a.circumradius() + b.circumradius();
  cast.pose.translation = (a.centre() - turn(b.centre())) + (1.4 * reach) * random_direction(random) -
                          (2.5 * reach / norm(cast.motion)) * cast.motion;
  return cast;
}

Transformd after(const Cast& cast, double time) {
  Transformd pose = cast.pose;
  pose.translation = pose.translation + time * cast.motion;
  return pose;
}

// The referee is the proven verdict: none before the lower bound, and at the upper one a contact but for what the pose
// is rounded by.
void expect_where_verdicts_change(const ConvexBody& a, const ConvexBody& b, const Cast& cast,
                                  const FirstContact& found) {
  const double reach = a.reach() + 2.0 * b.reach() + norm_1(cast.pose.translation);
  const double rounding = 16.0 * kUnitRoundoff * reach;
  ASSERT_NE(found.verdict.outcome, Outcome::undecided);
  const ConvexBody larger = with_margin(a, rounding);
  if (found.verdict.outcome == Outcome::disjoint) {
    const double latest = reach / norm(cast.motion);
    for (int s = 0; s <= 64; ++s) {
      EXPECT_NE(overlap(a, b, after(cast, latest * s / 64)).outcome, Outcome::overlap);
    }
    return;
  }
  EXPECT_LE(found.upper - found.lower, width_bound(found, cast.motion, reach));
  EXPECT_EQ(overlap(larger, b, after(cast, found.upper)).outcome, Outcome::overlap);
  const double earlier = rounding / std::fabs(dot(found.normal, cast.motion));
  for (const double time : {found.lower - 2.0 * earlier, 0.999 * found.lower, 0.5 * found.lower}) {
    EXPECT_NE(overlap(a, b, after(cast, time)).outcome, Outcome::overlap);
  }
  const double apart = norm(found.point_b - found.point_a);
  EXPECT_LE(apart, 1e-8 * reach + 2.0 * (found.upper - found.lower) * norm(cast.motion));
}

// One pose at a time, and many.
TEST(LinearCast, OfAllPairsIsWhereProvenVerdictsChange) {
  std::mt19937_64 random(7);
  int n_hits = 0, n_casts = 0;
  for (const NamedPair& pair : ordered_pairs()) {
    SCOPED_TRACE(test_name(pair));
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    std::vector<Cast> casts;
    std::vector<Pose> poses;
    std::vector<Vec3d> motions;
    for (int k = 0; k < 12; ++k) {
      casts.push_back(random_cast(random, a, b));
      poses.emplace_back(casts.back().pose);
      motions.push_back(casts.back().motion);
    }
    std::vector<FirstContact> many(casts.size());
    linear_cast(a, b, poses, motions, many);
    for (std::size_t k = 0; k < casts.size(); ++k) {
      const FirstContact found = linear_cast(a, b, poses[k], motions[k]);
      expect_where_verdicts_change(a, b, casts[k], found);
      expect_where_verdicts_change(a, b, casts[k], many[k]);
      EXPECT_EQ(many[k].verdict.outcome, found.verdict.outcome);
      ++n_casts;
      n_hits += found.verdict.outcome == Outcome::overlap ? 1 : 0;
    }
  }
  EXPECT_GT(n_hits, 0.3 * n_casts);
  EXPECT_LT(n_hits, 0.7 * n_casts);
}

TEST(LinearCast, SeenFromTheOtherBodyIsTheSame) {
  std::mt19937_64 random(8);
  int n_hits = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const Cast cast = random_cast(random, a, b);
    const FirstContact found = linear_cast(a, b, cast.pose, cast.motion);
    const FirstContact other = linear_cast(b, a, inverse(cast.pose), -cast.pose.direction_to_b(cast.motion));
    ASSERT_EQ(found.verdict.outcome, other.verdict.outcome) << pair.a << " " << pair.b;
    if (found.verdict.outcome != Outcome::overlap) continue;
    ++n_hits;
    // The inverse of the pose is rounded; and so, to 2^-50, is the rotation.
    const double reach = a.reach() + 2.0 * b.reach() + norm_1(cast.pose.translation);
    const double rounding = 64.0 * kUnitRoundoff * reach / std::fabs(dot(found.normal, cast.motion));
    EXPECT_LE(found.lower, other.upper + rounding);
    EXPECT_GE(found.upper, other.lower - rounding);
  }
  EXPECT_GT(n_hits, 100);
}

TEST(LinearCast, OfAMotionThatIsFasterIsSoonerByThat) {
  std::mt19937_64 random(9);
  const ConvexBody a = parse_shape("dodecahedron:0.5").body, b = parse_shape("cone:1,0.5").body;
  int n_hits = 0;
  for (int k = 0; k < 100; ++k) {
    const Cast cast = random_cast(random, a, b);
    const FirstContact found = linear_cast(a, b, cast.pose, cast.motion);
    const FirstContact doubled = linear_cast(a, b, cast.pose, 8.0 * cast.motion);
    const FirstContact third = linear_cast(a, b, cast.pose, (1.0 / 3.0) * cast.motion);
    EXPECT_EQ(doubled.verdict, found.verdict);
    EXPECT_EQ(third.verdict, found.verdict);
    if (found.verdict.outcome != Outcome::overlap) continue;
    ++n_hits;
    EXPECT_EQ(8.0 * doubled.lower, found.lower);
    EXPECT_EQ(8.0 * doubled.upper, found.upper);
    EXPECT_LE(third.lower / 3.0, found.upper);
    EXPECT_GE(third.upper / 3.0, found.lower);
  }
  EXPECT_GT(n_hits, 30);
}

// Sums of such coordinates are not finite, and no bound that is made of them is one.
TEST(LinearCast, OfBodiesFartherOffThanSumsAreFiniteIsUndecided) {
  const ConvexBody ball = Sphere(1.0);
  const auto expect_undecided = [](const FirstContact& found) {
    EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
    EXPECT_EQ(found.lower, 0.0);
    EXPECT_EQ(found.time, 0.0);
    EXPECT_EQ(found.upper, HUGE_VAL);
  };
  expect_undecided(linear_cast(ball, ball, moved_to(9e307, 9e307, 0.0), {-9e307, -9e307, 0.0}));
  expect_undecided(cast_ray(ball, {9e307, 9e307, 0.0}, {-1.0, -1.0, 0.0}));
  // Below that: such a motion is a direction like others.
  const FirstContact found = linear_cast(ball, ball, moved_to(4.0, 0.0, 0.0), {-0x1p1023, 0.0, 0.0});
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_LE(found.lower, 0x1p-1022);
  EXPECT_GE(found.upper, 0x1p-1022);
}

TEST(LinearCast, OfCurvedBodiesThatTouchAtTheStartHasNormalAndPoints) {
  struct Start {
    const char *a, *b;
    Vec3d at, motion;
  };
  const Start starts[] = {{"cylinder:1,0.5", "box:1,1,1", {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}},
                          {"sphere:0.5", "cylinder:1,0.5", {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}},
                          {"cylinder:1,0.5", "sphere:0.5", {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
  const auto expect_touch = [](const FirstContact& found, const Vec3d& motion, const Vec3d& at) {
    ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
    EXPECT_EQ(found.time, 0.0);
    EXPECT_LE(norm(found.normal + motion), 1e-4);
    EXPECT_NEAR(norm(found.normal), 1.0, 1e-15);
    EXPECT_LE(norm(found.point_a - found.point_b), 1e-8);
    // Along the normal; across it the face of a box and the side of a cylinder have a line in common.
    EXPECT_NEAR(dot(found.point_a - at, motion), 0.0, 1e-8);
  };
  for (const Start& start : starts) {
    const ConvexBody a = parse_shape(start.a).body, b = parse_shape(start.b).body;
    const FirstContact found = linear_cast(a, b, moved_to(start.at.x, start.at.y, start.at.z), start.motion);
    expect_touch(found, start.motion, 0.5 * start.at);
  }
  const ConvexBody ellipsoid = Ellipsoid(1.0, 2.0, 3.0);
  expect_touch(cast_ray(ellipsoid, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
}

// A time that no double is was proven to be that of a contact.
TEST(FirstContact, IsAtATimeThatADoubleTells) {
  const Vec3d far{5e10, 0, 0}, slowly{-1e-300, 0, 0};
  const Transformd pose{.translation = far};
  const ConvexBody ball = Sphere(1), box = Box(1, 1, 1);
  for (const FirstContact& found :
       {cast_ray(ball, far, slowly), cast_ray(box, far, slowly), linear_cast(ball, ball, pose, slowly),
        linear_cast(box, box, pose, slowly), time_of_impact(ball, ball, pose, {slowly, {}}),
        time_of_impact(box, box, pose, {slowly, {1e-320, 0, 0}}), time_of_impact(box, ball, pose, {slowly, {}})}) {
    EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
    EXPECT_LT(found.lower, HUGE_VAL);
    EXPECT_EQ(found.upper, HUGE_VAL);
  }
}

// Where exact arithmetic told the time, and it is so early that doubles are whole multiples of 2^-1074, its upper bound
// was rounded down: asked until then, the same cast was disjoint.
TEST(FirstContact, AtASubnormalTimeHasBoundsOnEitherSide) {
  const double unit = 0x1p-70;
  const ConvexBody a = Prism(40, 0.1 * unit, unit), b = Prism(6, unit, unit);
  Transformd pose{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
  pose.translation = {1.6940658945086007e-21, -1.6940658945086007e-21, 1.2705494208814505e-21};
  const double fast = 1.0715086071862673e301;
  const Vec3d motion{-fast, fast, 0};
  const FirstContact found = linear_cast(a, b, pose, motion);
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_LT(found.lower, found.upper);
  EXPECT_EQ(linear_cast(a, b, pose, motion, found.upper).verdict.outcome, Outcome::overlap);
}

}  // namespace
}  // namespace vex
