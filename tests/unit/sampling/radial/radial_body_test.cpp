#include "engine/sampling/radial/radial_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

// A A^T of a random A with rows of the given lengths.
Symmetric<double> random_matrix(std::mt19937_64& random, const Vec3d& lengths) {
  const Transformd r = random_rotation(random);
  const auto entry = [&](const Vec3d& p, const Vec3d& q) {
    return (lengths.x * lengths.x * p.x * q.x + lengths.y * lengths.y * p.y * q.y) + lengths.z * lengths.z * p.z * q.z;
  };
  return {entry(r.row_x, r.row_x), entry(r.row_y, r.row_y), entry(r.row_z, r.row_z),
          entry(r.row_x, r.row_y), entry(r.row_x, r.row_z), entry(r.row_y, r.row_z)};
}
Vec3d times(const Symmetric<double>& q, const Vec3d& v) {
  return {(q.xx * v.x + q.xy * v.y) + q.xz * v.z, (q.xy * v.x + q.yy * v.y) + q.yz * v.z,
          (q.xz * v.x + q.yz * v.y) + q.zz * v.z};
}

TEST(Root, TimesItsTransposeIsTheMatrix) {
  std::mt19937_64 random(1);
  for (const Vec3d& lengths : {Vec3d{1, 1, 1}, Vec3d{1, 2, 3}, Vec3d{64, 1, 1}, Vec3d{1, 1, 1e-3}}) {
    for (int k = 0; k < 20; ++k) {
      const Symmetric<double> q = random_matrix(random, lengths);
      const Root<double> root = root_of(q);
      EXPECT_NEAR(root.determinant(), lengths.x * lengths.y * lengths.z, 1e-9 * root.determinant());
      for (const Vec3d& v : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
        // normal is L^-T: L^-1 Q L^-T = 1
        const Vec3d same = root.inverse(times(q, root.normal(v)));
        EXPECT_LE(norm(same - v), 1e-8);
        EXPECT_LE(norm(root.inverse(root(v)) - v), 1e-8);
      }
    }
  }
}

TEST(Root, OfAFlatMatrixIsRegular) {
  for (const Symmetric<double>& q :
       {Symmetric<double>{1.0, 0.0, 0.0}, Symmetric<double>{0.0, 0.0, 1.0}, Symmetric<double>{1.0, 1.0, 0.0},
        Symmetric<double>{1.0, 1.0, 0.0, 1.0}, Symmetric<double>{1.0, 1.0, 1.0, 1.0, 1.0, 1.0}}) {
    EXPECT_GT(root_of(q).determinant(), 0.0);
    EXPECT_TRUE(is_finite(root_of(q).normal({1.0, 1.0, 1.0})));
  }
}

TEST(MatchingEllipsoid, OfAnEllipsoidIsItself) {
  for (const Vec3d& d : {Vec3d{1, 1, 1}, Vec3d{1, 2, 3}, Vec3d{4, 1, 1}, Vec3d{1e-3, 1, 1}}) {
    const MatchingEllipsoid found = matching_ellipsoid(Ellipsoid(d.x, d.y, d.z));
    EXPECT_NEAR(std::sqrt(found.q.xx), d.x, 0.15 * d.x);
    EXPECT_NEAR(std::sqrt(found.q.yy), d.y, 0.15 * d.y);
    EXPECT_NEAR(std::sqrt(found.q.zz), d.z, 0.15 * d.z);
    EXPECT_EQ(norm(found.centre), 0.0);
  }
}

TEST(MatchingEllipsoid, OfABoxHasTheProportionsOfItsEdges) {
  const MatchingEllipsoid found = matching_ellipsoid(parse_shape("box:64,1,0.01").body);
  EXPECT_NEAR(found.q.xx / found.q.yy, 64.0 * 64.0, 0.05 * 64.0 * 64.0);
  EXPECT_NEAR(found.q.yy / found.q.zz, 1e4, 0.05 * 1e4);
}

TEST(MatchingEllipsoid, GoesWhereTheBodyGoes) {
  const std::vector<Vec3d> box = box_vertices(8.0, 2.0, 1.0);
  std::mt19937_64 random(1);
  Transformd pose = random_rotation(random);
  pose.translation = {3.0, -1.0, 2.0};
  std::vector<Vec3d> placed;
  for (const Vec3d& v : box) placed.push_back(pose(v));
  const MatchingEllipsoid there = matching_ellipsoid(Polytope(placed, pose.translation, 0.5));
  EXPECT_LE(norm(there.centre - pose.translation), 0.2);
  const MatchingEllipsoid here = matching_ellipsoid(Polytope(box, {}, 0.5));
  // x^T Q x of turned vectors
  const auto form = [](const Symmetric<double>& q, const Vec3d& x) {
    return (q.xx * x.x * x.x + q.yy * x.y * x.y + q.zz * x.z * x.z) +
           2.0 * (q.xy * x.x * x.y + q.xz * x.x * x.z + q.yz * x.y * x.z);
  };
  const Vec3d none;
  for (const Vec3d& x : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    pose.translation = none;
    EXPECT_NEAR(form(there.q, pose(x)), form(here.q, x), 0.3 * form(here.q, x));
  }
}

TEST(MatchingEllipsoid, OfAFlatBodyIsFlatAndOfALineALine) {
  const MatchingEllipsoid plate = matching_ellipsoid(parse_shape("plate:1,2").body);
  EXPECT_EQ(plate.q.zz, 0.0);
  EXPECT_GT(plate.q.xx, 0.1);
  const MatchingEllipsoid needle = matching_ellipsoid(parse_shape("needle:2").body);
  EXPECT_EQ(needle.q.xx + needle.q.yy, 0.0);
  EXPECT_GT(needle.q.zz, 0.5);
}

TEST(MatchingEllipsoid, OfAPointIsThePoint) {
  const std::vector<Vec3d> vertices(3, Vec3d{1.0, 2.0, 3.0});
  const MatchingEllipsoid found = matching_ellipsoid(Polytope(vertices, vertices[0], 0.0));
  EXPECT_EQ(norm(found.centre - vertices[0]), 0.0);
  EXPECT_EQ(found.q.xx + found.q.yy + found.q.zz, 0.0);
}

TEST(RadialBody, FindsTheAxisInWhichABodyIsUnlikeTheOthers) {
  struct Case {
    const char* shape;
    Vec3d axis;
    RadialBody::Form form;
    int n_sectors;
    Turns::Poles poles = Turns::Poles::two;
  };
  using Form = RadialBody::Form;
  for (const Case& c :
       {Case{"box:1,1,1", {0, 0, 1}, Form::lump, 4, Turns::Poles::six}, Case{"box:64,1,1", {1, 0, 0}, Form::rod, 4},
        Case{"box:1,64,2", {0, 1, 0}, Form::rod, 2}, Case{"box:1,0.01,1", {0, 1, 0}, Form::slab, 4},
        Case{"plate:1,1", {0, 0, 1}, Form::slab, 4}, Case{"plate:4,1", {1, 0, 0}, Form::rod, 2},
        Case{"ellipsoid:4,1,1", {1, 0, 0}, Form::rod, 1}, Case{"capsule:64,0.5", {0, 0, 1}, Form::rod, 1},
        Case{"disc:1", {0, 0, 1}, Form::slab, 1}, Case{"needle:1", {0, 0, 1}, Form::rod, 1},
        Case{"sphere:1", {0, 0, 1}, Form::lump, 1}, Case{"octahedron:1", {0, 0, 1}, Form::lump, 4, Turns::Poles::six},
        Case{"icosahedron:1", {0, 0, 1}, Form::lump, 2, Turns::Poles::six},
        Case{"snub-cube:1", {0, 0, 1}, Form::lump, 4, Turns::Poles::six},
        Case{"cone:1,0.5", {0, 0, 1}, Form::lump, 1, Turns::Poles::one},
        Case{"ellipsoid:1,2,3", {1, 0, 0}, Form::slab, 2},
        Case{"tetrahedron:1", {0, 0, 1}, Form::lump, 2, Turns::Poles::six},
        Case{"antiprism:3,1,1", {0, 0, 1}, Form::lump, 3, Turns::Poles::one}}) {
    SCOPED_TRACE(c.shape);
    const RadialBody found = radial_body(parse_shape(c.shape).body);
    const Vec3d z = found.axes.row_z;
    EXPECT_NEAR(std::fabs(z.x), c.axis.x, 1e-12);
    EXPECT_NEAR(std::fabs(z.y), c.axis.y, 1e-12);
    EXPECT_NEAR(std::fabs(z.z), c.axis.z, 1e-12);
    EXPECT_EQ(found.form, c.form);
    EXPECT_EQ(found.turns.n_sectors, c.n_sectors);
    EXPECT_EQ(found.turns.poles, c.poles);
    EXPECT_NEAR(dot(cross(found.axes.row_x, found.axes.row_y), z), 1.0, 1e-14);
    EXPECT_EQ(found.is_upright, found.axes.row_x.x == 1.0 && z.z == 1.0);
  }
}

TEST(RadialBody, FindsTheAxisOfATurnedBox) {
  std::mt19937_64 random(1);
  const Transformd pose = random_rotation(random);
  std::vector<Vec3d> placed;
  for (const Vec3d& v : box_vertices(8.0, 1.0, 1.0)) placed.push_back(pose(v));
  const RadialBody found = radial_body(Polytope(placed, pose.translation, 0.5));
  EXPECT_EQ(found.form, RadialBody::Form::rod);
  EXPECT_FALSE(found.is_upright);
  EXPECT_GT(std::fabs(dot(found.axes.row_z, pose(Vec3d{1, 0, 0}))), 0.99);
  EXPECT_NEAR(found.q.xx + found.q.yy, 0.1 * found.q.zz, 0.1 * found.q.zz);
}

TEST(RadialBody, OfAPointIsALump) {
  const std::vector<Vec3d> vertices(3, Vec3d{1.0, 2.0, 3.0});
  const RadialBody found = radial_body(Polytope(vertices, vertices[0], 0.0));
  EXPECT_EQ(found.form, RadialBody::Form::lump);
  EXPECT_TRUE(found.is_upright);
}

}  // namespace
}  // namespace vex
