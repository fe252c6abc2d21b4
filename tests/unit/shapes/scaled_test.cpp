#include "shapes/scaled.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/support/validate.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

const Vec3d kFactors[] = {{2.0, 2.0, 2.0}, {0.3, 1.7, -2.1}, {-1.0, 1.0, 1.0}, {1.0, -3.0, 0.01}, {-0.7, -0.7, -0.7}};

TEST(Scaled, BodiesKeepWhatTheyClaim) {
  for (const char* name : every_test_body()) {
    for (const Vec3d& factors : kFactors) {
      SCOPED_TRACE(std::string(name) + " times " + std::to_string(factors.x) + ", " + std::to_string(factors.z));
      const Body body = scaled(parse_shape(name), factors);
      for (const Violation& violation : validate(body, {.n_directions = 100})) ADD_FAILURE() << violation.text;
    }
  }
}

TEST(Scaled, SupportFunctionsAreThoseOfTheStretchedDirection) {
  std::mt19937_64 random(321);
  for (const char* name : every_test_body()) {
    SCOPED_TRACE(name);
    const Body body = parse_shape(name);
    for (const Vec3d& f : kFactors) {
      const Body image = scaled(body, f);
      for (int k = 0; k < 20; ++k) {
        const Vec3d d = random_direction(random), stretched{f.x * d.x, f.y * d.y, f.z * d.z};
        const double expected = dot(stretched, body.body.support(stretched));
        EXPECT_NEAR(dot(d, image.body.support(d)), expected,
                    4.0 * image.body.support_error() + 64.0 * kUnitRoundoff * image.body.reach());
      }
    }
  }
}

TEST(Scaled, MeasuresAreThoseKnown) {
  const Body cone = parse_shape("cone:1,0.5");
  const Body twice = scaled(cone, -2.0);
  EXPECT_NEAR(twice.measures.volume, 8.0 * cone.measures.volume, 1e-14);
  EXPECT_NEAR(twice.measures.surface_area, 4.0 * cone.measures.surface_area, 1e-14);
  EXPECT_NEAR(twice.measures.integrated_mean_curvature, 2.0 * cone.measures.integrated_mean_curvature, 1e-14);
  const Body wide = scaled(cone, {2.0, 3.0, 0.5});
  EXPECT_NEAR(wide.measures.volume, 3.0 * cone.measures.volume, 1e-14);
  EXPECT_TRUE(std::isnan(wide.measures.surface_area));
  EXPECT_FALSE(wide.measures.are_known());
  const Body brick = scaled(parse_shape("box:1,1,1"), {1.0, -2.0, 3.0});
  EXPECT_EQ(brick.kind, "box");
  EXPECT_NEAR(brick.measures.surface_area, 22.0, 1e-14);
  const Body egg = scaled(parse_shape("sphere:1"), {1.0, -2.0, 3.0});
  EXPECT_EQ(egg.kind, "ellipsoid");
  EXPECT_NEAR(egg.measures.volume, 8.0 * std::numbers::pi, 1e-13);
  EXPECT_TRUE(egg.measures.are_known());
  EXPECT_EQ(mirrored(cone).measures.surface_area, cone.measures.surface_area);
}

TEST(Scaled, MirrorImagesMeetAsTheBodiesDoInTheMirror) {
  // In the plane x = 0, of poses too: every number is kept, so that verdicts are the same.
  std::mt19937_64 random(322);
  int n = 0, n_overlaps = 0;
  for (const NamedPair& pair : further_pairs()) {
    const Body a = parse_shape(pair.a), b = parse_shape(pair.b), of_a = mirrored(a), of_b = mirrored(b);
    for (int k = 0; k < 20; ++k) {
      Transformd pose = random_rotation(random);
      pose.translation = contact_along(a, b, pose, random_direction(random)) * random_direction(random);
      Transformd image = pose;
      image.row_x = {pose.row_x.x, -pose.row_x.y, -pose.row_x.z};
      image.row_y.x = -pose.row_y.x;
      image.row_z.x = -pose.row_z.x;
      image.translation.x = -pose.translation.x;
      const Outcome outcome = overlap(a, b, pose).outcome;
      EXPECT_EQ(overlap(of_a, of_b, image).outcome, outcome);
      n_overlaps += outcome == Outcome::overlap ? 1 : 0;
      ++n;
    }
  }
  EXPECT_GT(n_overlaps, n / 6);
  EXPECT_LT(n_overlaps, n * 5 / 6);
}

TEST(Scaled, PolytopesAreDecidedExactlyAboutTheirScaledVertices) {
  std::mt19937_64 random(323);
  int n_overlaps = 0, n = 0;
  for (const char* name : {"tetrahedron:1.3", "octahedron:1", "box:1,1,1", "pyramid:6,0.6,1.1"}) {
    const Body a = scaled(parse_shape(name), {0.3, 1.7, -2.1});
    const Body b =
        mapped(parse_shape("tetrahedron:1"), {Vec3d{1.0, 0.5, 0.0}, Vec3d{0.0, 0.7, 0.3}, Vec3d{0.1, 0.0, 1.9}});
    ASSERT_TRUE(a.body.exact_form()->is_polytope());
    for (int k = 0; k < 8; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double together = contact_along(a, b, pose, dir);
      for (const double at : {together, std::nextafter(together, HUGE_VAL)}) {
        pose.translation = at * dir;
        const Outcome truth = rounded_polytopes_outcome(*a.body.exact_form(), *b.body.exact_form(), pose);
        ASSERT_EQ(overlap(a, b, pose).outcome, truth);
        n_overlaps += truth == Outcome::overlap ? 1 : 0;
        ++n;
      }
    }
  }
  EXPECT_GT(n_overlaps, n / 4);
  EXPECT_LT(n_overlaps, n * 3 / 4);
}

TEST(Scaled, ACapsuleStretchedIsTheHullOfTwoEllipsoids) {
  const Body capsule = scaled(parse_shape("capsule:1,0.25"), {1.0, 2.0, 4.0});
  const ExactForm form = capsule.body.exact_form().value();
  EXPECT_EQ(form.pieces.size(), 2u);
  EXPECT_EQ(form.ball_radius, 0.0);
  const Body ball = parse_shape("sphere:0.5");
  // Its top is at 4 (1/2 + 1/4), its side at 2/4.
  EXPECT_NEAR(distance(capsule, ball, Transformd{.translation = {0.0, 0.0, 5.0}}).signed_distance, 1.5, 1e-9);
  EXPECT_NEAR(distance(capsule, ball, Transformd{.translation = {0.0, 5.0, 0.0}}).signed_distance, 4.0, 1e-9);
}

TEST(Scaled, VolumesOfMapsAreRightOrNotKnown) {
  const Body tetrahedron = parse_shape("tetrahedron:1");
  const std::array<Vec3d, 3> small = {Vec3d{1.5e-108, 0.0, 0.0}, Vec3d{0.0, 1.5e-108, 0.0}, Vec3d{0.0, 0.0, 1.5e-108}};
  const double truth = tetrahedron.measures.volume * 3.375e-24;
  EXPECT_NEAR(mapped(scaled(tetrahedron, 1e100), small).measures.volume, truth, 1e-12 * truth);
  const std::array<Vec3d, 3> flat = {Vec3d{0.04034813428436524, -0.57525543059635198, -0.55342563601271633},
                                     Vec3d{-0.8688643407579264, 0.065656620224555651, 0.071543691102779139},
                                     Vec3d{-0.050973868269808313, 0.42022789565520302, 0.4044895124150143}};
  EXPECT_TRUE(std::isnan(mapped(tetrahedron, flat).measures.volume));
  const std::array<Vec3d, 3> stretched = {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1e6, 0.0}, Vec3d{0.0, 0.0, 1e-6}};
  EXPECT_NEAR(mapped(tetrahedron, stretched).measures.volume, tetrahedron.measures.volume, 1e-13);
}

TEST(Scaled, SizesOutOfRangeAreRefusedOrNotKnown) {
  EXPECT_THROW(scaled(parse_shape("cylinder:1e-250,1e-250"), 1e-100), InputError);
  EXPECT_THROW(scaled(parse_shape("cylinder:1e-2,1e-250"), 1e-100), InputError);
  EXPECT_THROW(scaled(parse_shape("capsule:1e-2,1e-250"), 1e-100), InputError);
  const Body box = parse_shape("tetrahedron:1");
  EXPECT_TRUE(std::isnan(scaled(scaled(scaled(box, 1e-100), 1e-100), 1e100).measures.volume));
  EXPECT_TRUE(std::isnan(scaled(scaled(scaled(box, 1e100), 1e100), 1e-100).measures.volume));
}

TEST(Scaled, WhatIsNoScaleIsRefused) {
  const Body box = parse_shape("box:1,1,1"), ball = parse_shape("sphere:1");
  for (const double factor : {0.0, std::nan(""), HUGE_VAL, 1e-200, 1e200}) {
    EXPECT_THROW(scaled(box, {1.0, factor, 1.0}), InputError);
    EXPECT_THROW(scaled(ball, factor), InputError);
  }
  EXPECT_THROW(scaled(scaled(scaled(scaled(ball, 1e100), 1e100), 1e100), 1e100), InputError);
  EXPECT_THROW(mapped(ball, {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}), InputError);
  EXPECT_THROW(mapped(box, {Vec3d{1.0, 0.0, 0.0}, Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}), InputError);
  EXPECT_THROW(mapped(box, {Vec3d{HUGE_VAL, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}), InputError);
}

}  // namespace
}  // namespace vex
