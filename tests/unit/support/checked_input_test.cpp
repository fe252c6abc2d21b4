// What is no body and what is no pose is refused where it is made, in every build.
#include "engine/support/checked_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"
#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/separation.h"
#include "engine/sampling/estimate.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/points/sobol.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/support/combinators.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disc.h"
#include "shapes/dodecahedron.h"
#include "shapes/ellipsoid.h"
#include "shapes/hemisphere.h"
#include "shapes/icosahedron.h"
#include "shapes/needle.h"
#include "shapes/octahedron.h"
#include "shapes/plate.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"
#include "shapes/tetrahedron.h"

namespace vex {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

TEST(CheckedInput, EverySizeOfEveryBodyIsPositiveAndFinite) {
  struct Kind {
    const char* name;
    std::function<void(double)> make;
  };
  const std::vector<Kind> kinds = {
      {"box x", [](double s) { Box(s, 1, 1); }},
      {"box y", [](double s) { Box(1, s, 1); }},
      {"box z", [](double s) { Box(1, 1, s); }},
      {"sphere", [](double s) { Sphere{s}; }},
      {"ellipsoid x", [](double s) { Ellipsoid(s, 1, 1); }},
      {"ellipsoid y", [](double s) { Ellipsoid(1, s, 1); }},
      {"ellipsoid z", [](double s) { Ellipsoid(1, 1, s); }},
      {"capsule length", [](double s) { Capsule(s, 1); }},
      {"capsule radius", [](double s) { Capsule(1, s); }},
      {"cylinder length", [](double s) { Cylinder(s, 1); }},
      {"cylinder radius", [](double s) { Cylinder(1, s); }},
      {"cone height", [](double s) { Cone(s, 1); }},
      {"cone radius", [](double s) { Cone(1, s); }},
      {"frustum height", [](double s) { Frustum(s, 1, 1); }},
      {"hemisphere", [](double s) { Hemisphere{s}; }},
      {"disc", [](double s) { Disc{s}; }},
      {"plate x", [](double s) { Plate(s, 1); }},
      {"plate y", [](double s) { Plate(1, s); }},
      {"needle", [](double s) { Needle{s}; }},
      {"tetrahedron", [](double s) { Tetrahedron{s}; }},
      {"octahedron", [](double s) { Octahedron{s}; }},
      {"dodecahedron", [](double s) { Dodecahedron{s}; }},
      {"icosahedron", [](double s) { Icosahedron{s}; }},
      {"rounded", [](double s) { Rounded<Needle>(Needle(1), Needle(1).measures(), s); }},
  };
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    EXPECT_NO_THROW(kind.make(1.0));
    for (const double wrong : {0.0, -0.0, -1.0, -kInfinity, kInfinity, kNan, 5e-324, 1e-301, 1e301, 1.7e308}) {
      EXPECT_THROW(kind.make(wrong), InputError) << wrong;
    }
  }
  EXPECT_NO_THROW(Frustum(1, 0, 1));
  EXPECT_THROW(Frustum(1, 0, 0), InputError);
  EXPECT_THROW(Frustum(1, -1, 2), InputError);
  EXPECT_THROW(Frustum(1, 2, kNan), InputError);
}

TEST(CheckedInput, SaysWhatIsWrong) {
  try {
    Box(kNan, 1, 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "an edge of a box is not positive and finite (nan) - every size of a body must be");
  }
}

TEST(CheckedInput, PolytopesAndMargins) {
  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NO_THROW(Polytope(corners, {0.2, 0.2, 0.2}, 0.1));
  EXPECT_THROW(Polytope({}, {}, 0.0), InputError);
  EXPECT_THROW(Polytope(corners, {0.2, 0.2, 0.2}, -0.1), InputError);
  EXPECT_THROW(Polytope(corners, {0.2, 0.2, 0.2}, kNan), InputError);
  EXPECT_THROW(ConvexBody(Polytope(corners, {kNan, 0.2, 0.2}, 0.0)), InputError);
  std::vector<Vec3d> broken = corners;
  broken[2].y = kNan;
  EXPECT_THROW(Polytope(broken, {}, 0.0), InputError);
  EXPECT_THROW(with_margin(Box(1, 1, 1), -0.1), InputError);
  EXPECT_THROW(with_margin(Box(1, 1, 1), kNan), InputError);
  const std::vector<Vec3d> far_apart = {{-1.7e308, -1.7e308, 0}, {1.7e308, 1.7e308, 0}};
  EXPECT_THROW(ConvexBody(Polytope(far_apart, {}, 0.0)), InputError) << "its circumradius is not finite";
}

/// A ball that says what it is told to.
struct Claimant {
  Vec3d centre_{};
  double circumradius_ = 1.0, inradius_ = 1.0, support_error_ = 1e-15;

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return ball_support(L(1.0), dir);
  }
  double support_error() const { return support_error_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }
};

TEST(CheckedInput, WhatAUsersBodySaysOfItself) {
  EXPECT_NO_THROW(ConvexBody(Claimant{}));
  EXPECT_THROW(ConvexBody(Claimant{.centre_ = {0, kNan, 0}}), InputError);
  EXPECT_THROW(ConvexBody(Claimant{.circumradius_ = kInfinity}), InputError);
  EXPECT_THROW(ConvexBody(Claimant{.circumradius_ = 0.5}), InputError) << "the ball inside is larger";
  EXPECT_THROW(ConvexBody(Claimant{.inradius_ = -1}), InputError);
  EXPECT_THROW(ConvexBody(Claimant{.support_error_ = kNan}), InputError);
}

struct Formed : Box {
  Formed() : Box(1, 1, 1) {}
  ExactForm form;
  Generators sum = Box::generators();
  ExactForm exact_form() const { return form; }
  Generators generators() const { return sum; }
};

TEST(CheckedInput, WhatAUsersBodySaysThatItIs) {
  Formed good;
  good.form = Box(1, 1, 1).exact_form();
  EXPECT_NO_THROW(ConvexBody{good});
  EXPECT_THROW(ConvexBody(Formed{}), InputError) << "a form without a point crashed the exact stage";
  for (const double wrong : {kNan, kInfinity}) {
    Formed far = good;
    far.form.points[3].y = wrong;
    EXPECT_THROW(ConvexBody{far}, InputError);
    Formed summed = good;
    summed.sum.vectors[1].x = wrong;
    EXPECT_THROW(ConvexBody{summed}, InputError);
  }
  Formed hollow = good;
  hollow.form.ball_radius = -1.0;
  EXPECT_THROW(ConvexBody{hollow}, InputError);
  Formed inverted = good;
  inverted.form.pieces.push_back({{}, {1, -1, 1}});
  EXPECT_THROW(ConvexBody{inverted}, InputError);
  Formed endless = good;
  endless.sum.n_vectors = 100;
  EXPECT_THROW(ConvexBody{endless}, InputError) << "it was read beyond the three that there are";
}

/// NaN along one direction.
struct Blind : Box {
  Blind() : Box(1, 1, 1) {}
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return Box::support(dir);
  }
  Vec3d support(const Vec3d& dir) const { return dir.x > 0.999999 * norm(dir) ? Vec3d{kNan, 0, 0} : Box::support(dir); }
};

TEST(CheckedInput, BoundsAreNumbersWhateverASupportMappingSays) {
  const ConvexBody blind = Blind{}, box = Box(1, 1, 1);
  for (const double x : {0.5, 1.0, 3.0}) {
    const Separation found = signed_distance(blind, box, Transformd{.translation = {x, 0, 0}});
    EXPECT_LE(found.lower, found.upper);
  }
}

std::vector<Transformd> no_poses() {
  Transformd stretched, mirrored, askew, not_a_number, far, sheared;
  stretched.row_x = {1.001, 0, 0};
  mirrored.row_z = {0, 0, -1};
  askew.row_x = {1, 1e-5, 0};
  not_a_number.row_y = {0, kNan, 0};
  far.translation = {0, kInfinity, 0};
  sheared.row_x = {0, 0, 0};
  Transformd lost;
  lost.translation = {kNan, 0, 0};
  return {stretched, mirrored, askew, not_a_number, far, sheared, lost};
}

TEST(CheckedInput, EveryQueryRefusesWhatIsNoPose) {
  const ConvexBody a = Box(1, 1, 1), b = Sphere(1);
  const std::vector<std::function<void(const Pose&)>> queries = {
      [&](const Pose& pose) { overlap(a, b, pose); },
      [&](const Pose& pose) { prove_again(a, b, pose, Outcome::overlap); },
      [&](const Pose& pose) { distance(a, b, pose); },
      [&](const Pose& pose) { signed_distance(a, b, pose); },
      [&](const Pose& pose) { penetration_depth(a, b, pose); },
      [&](const Pose& pose) {
        linear_cast(a, b, pose, {1, 0, 0});
      },
      [&](const Pose& pose) {
        time_of_impact(a, b, pose, {{1, 0, 0}, {0, 0, 1}});
      },
      [&](const Pose& pose) { contact_manifold(a, b, pose); },
      [&](const Pose& pose) { gjk_backend().make(a, b)->decide(pose); },
  };
  for (const auto& query : queries) {
    EXPECT_NO_THROW(query(Transformd{}));
    for (const Transformd& pose : no_poses()) EXPECT_THROW(query(pose), InputError);
  }
  EXPECT_NO_THROW(Pose(Transformd{{1, 1e-8, 0}, {-1e-8, 1, 0}, {0, 0, 1}, {}})) << "to within 1e-6";
}

TEST(CheckedInput, NoCertificateHoldsInWhatIsNoPose) {
  const ConvexBody a = Box(1, 1, 1);
  const Transformd apart{.translation = {3, 0, 0}};
  OverlapCertificate certificate;
  overlap(a, a, apart, &certificate);
  EXPECT_TRUE(check_certificate(a, a, apart, Outcome::disjoint, certificate).is_proven);
  for (Transformd pose : no_poses()) {
    pose.translation = pose.translation + apart.translation;
    EXPECT_FALSE(check_certificate(a, a, pose, Outcome::disjoint, certificate).is_proven);
  }
}

TEST(CheckedInput, AsManyVerdictsAsPoses) {
  const ConvexBody a = Box(1, 1, 1);
  const std::vector<Pose> poses(3);
  std::vector<Verdict> verdicts(1);
  EXPECT_THROW(gjk_backend().make(a, a)->decide(poses, verdicts), UsageError) << "it wrote beyond their end";
}

TEST(CheckedInput, RaysOfDifferencesAreOfRotationsPointsAndDirections) {
  const ConvexBody a = Box(1, 1, 1), b = Sphere(1);
  for (const Transformd& pose : no_poses()) EXPECT_THROW(radial_function(a, b, {}, pose, {1, 0, 0}), InputError);
  for (const Vec3d& wrong : {Vec3d{0, 0, 0}, Vec3d{kNan, 0, 1}, Vec3d{kInfinity, 0, 0}}) {
    EXPECT_THROW(radial_function(a, b, {}, {}, wrong), InputError);
  }
  for (const Vec3d& wrong : {Vec3d{kNan, 0, 1}, Vec3d{kInfinity, 0, 0}}) {
    EXPECT_THROW(radial_function(a, b, {wrong, {}}, {}, {1, 0, 0}), InputError);
    EXPECT_THROW(radial_function(a, b, {{}, wrong}, {}, {1, 0, 0}), InputError);
  }
}

TEST(CheckedInput, SequencesHaveDimensions) {
  for (const int dimension : {-1, 0, SobolPoints::kMaxDimension + 1, std::numeric_limits<int>::max()}) {
    EXPECT_THROW(SobolPoints{dimension}, UsageError) << dimension;
    EXPECT_THROW(TrialPoints(1, Sequence::sobol, dimension), UsageError) << dimension;
  }
  for (const Sequence sequence : {Sequence::random, Sequence::sobol}) {
    for (const int dimension : {std::numeric_limits<int>::min(), -1, 0}) {
      EXPECT_THROW(TrialPoints(1, sequence, dimension), UsageError) << dimension;
    }
    for (const int n_independent : {-1, 3, 4}) {
      EXPECT_THROW(TrialPoints(1, sequence, 4, {}, InstructionSet::scalar, n_independent), UsageError) << n_independent;
    }
    EXPECT_THROW(TrialPoints(1, sequence, 1, {}, InstructionSet::scalar, 1), UsageError);
    EXPECT_THROW(TrialPoints(1, sequence, 4, Strata{4, 0.0}), UsageError);
  }
}

TEST(CheckedInput, DirectionsAndMotionsAreVectors) {
  const ConvexBody a = Box(1, 1, 1), b = Sphere(1);
  for (const Vec3d& wrong : {Vec3d{0, 0, 0}, Vec3d{kNan, 0, 1}, Vec3d{kInfinity, 0, 0}}) {
    EXPECT_THROW(linear_cast(a, b, Transformd{}, wrong), InputError);
    EXPECT_THROW(cast_ray(a, {5, 0, 0}, wrong), InputError);
  }
  EXPECT_THROW(cast_ray(a, {kNan, 0, 0}, {1, 0, 0}), InputError);
  EXPECT_THROW(time_of_impact(a, b, Transformd{}, {{kNan, 0, 0}, {}}), InputError);
  EXPECT_THROW(time_of_impact(a, b, Transformd{}, {{1, 0, 0}, {0, kInfinity, 0}}), InputError);
  EXPECT_THROW(rotation_from_quaternion(0, 0, 0, 0), InputError);
  EXPECT_THROW(rotation_from_quaternion(1, kNan, 0, 0), InputError);
}

TEST(CheckedInput, SettingsAreWithinTheirRange) {
  const ConvexBody a = Box(1, 1, 1);
  EXPECT_THROW(OrientationLaw::cone(91), UsageError);
  EXPECT_THROW(OrientationLaw::cone(kNan), UsageError);
  EXPECT_THROW(OrientationLaw::onsager(-1), UsageError);
  EXPECT_THROW(OrientationLaw::onsager(kInfinity), UsageError);
  EXPECT_THROW(OrientationLaw::fixed(0, 0, 0, 0), InputError);
  SeparationSettings rough;
  rough.relative_gap = kNan;
  EXPECT_THROW(distance(a, a, Transformd{}, rough), UsageError);
  EXPECT_THROW(contact_manifold(a, a, Transformd{}, -1.0), UsageError);
  MonteCarloSettings settings;
  settings.domain = best_domain(a, a);
  settings.stop.trials = 10;
  settings.n_threads = 0;
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError);
  settings.n_threads = 1;
  settings.stop.trials = 0;
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError);
  settings.stop.trials = 10;
  settings.domain.volume *= 2.0;
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError) << "its volume is not its own";
  settings.domain = best_domain(a, a);
  settings.stop.relative_error = kNan;
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError) << "it never ended";
  settings.stop.relative_error.reset();
  settings.backend.make = nullptr;
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError);
  settings.backend = gjk_backend();
  settings.domain = {};
  EXPECT_THROW(run_monte_carlo(a, a, settings), UsageError) << "without a domain every estimate was 0";
  EXPECT_THROW(hit_or_miss_estimate(Tally{}, 1.0), UsageError);
  EXPECT_THROW(wilson_interval(2, 1, 1.0), UsageError);
}

}  // namespace
}  // namespace vex
