// What `validate` says of right support mappings, nothing, and of wrong ones.
#include "engine/support/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "engine/support/combinators.h"
#include "shapes/box.h"
#include "shapes/cut_sphere.h"
#include "shapes/egg.h"
#include "shapes/ellipsoid.h"
#include "shapes/lens.h"
#include "shapes/sphere.h"
#include "shapes/spindle.h"
#include "shapes/superellipsoid.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

using Claim = Violation::Claim;

std::string all_of(const std::vector<Violation>& violations) {
  std::string all;
  for (const Violation& violation : violations) all += "\n  " + violation.text;
  return all;
}

bool has(const std::vector<Violation>& violations, Claim claim) {
  return std::ranges::any_of(violations, [claim](const Violation& v) { return v.claim == claim && v.by > 0.0; });
}

class EveryTestBody : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryTestBody, KeepsItsPromises) {
  for (const double scale : {1.0, 1e-40, 1e40}) {
    const std::vector<Violation> found = validate(parse_shape(GetParam(), scale).body, {.n_directions = 400});
    EXPECT_TRUE(found.empty()) << scale << all_of(found);
  }
}
INSTANTIATE_TEST_SUITE_P(Validate, EveryTestBody, ::testing::ValuesIn(every_test_body()));

TEST(Validate, FindsNothingWrongWithHulls) {
  for (const std::size_t n : {33U, 300U, 5000U}) {
    const std::vector<Violation> found = validate(test_point_hull(static_cast<int>(n), {3, 2, 1}, 7).body);
    EXPECT_TRUE(found.empty()) << n << all_of(found);
  }
}

/// The unit ball by its own support mapping, with every claim open to be wrong.
struct ClaimingBall {
  double circumradius_ = 1.0, inradius_ = 1.0, support_error_ = 1e-15;
  Vec3d centre_{};

  Vec3d support(const Vec3d& dir) const { return norm_1(dir) > 0.0 ? ball_support(1.0, dir) : Vec3d{}; }
  double support_error() const { return support_error_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }
};

TEST(Validate, RightClaimsOfAUsersBody) {
  const std::vector<Violation> found = validate(ClaimingBall{});
  EXPECT_TRUE(found.empty()) << all_of(found);
}

TEST(Validate, AWrongCircumradius) {
  const std::vector<Violation> found = validate(ClaimingBall{.circumradius_ = 0.999, .inradius_ = 0.9});
  ASSERT_EQ(found.size(), 1U) << all_of(found);
  EXPECT_EQ(found[0].claim, Claim::circumradius);
  EXPECT_NEAR(found[0].by, 0.001, 1e-12);
  EXPECT_NE(found[0].text.find("the circumradius is too small, 0.999 (by 0.00"), std::string::npos) << found[0].text;
}

TEST(Validate, AWrongInradius) {
  const std::vector<Violation> found = validate(ClaimingBall{.circumradius_ = 1.1, .inradius_ = 1.0001});
  ASSERT_EQ(found.size(), 1U) << all_of(found);
  EXPECT_EQ(found[0].claim, Claim::inradius);
}

TEST(Validate, AWrongCentre) {
  const std::vector<Violation> found =
      validate(ClaimingBall{.circumradius_ = 3.0, .inradius_ = 0.0, .centre_ = {1.5, 0, 0}});
  ASSERT_EQ(found.size(), 1U) << all_of(found);
  EXPECT_EQ(found[0].claim, Claim::centre);
  EXPECT_NEAR(found[0].by, 0.5, 1e-3);
}

TEST(Validate, ASupportErrorThatForgetsRounding) {
  // Of a ball by square root and division no point is right to less than 1e-17.
  const std::vector<Violation> found =
      validate(ClaimingBall{.circumradius_ = 1.1, .inradius_ = 0.9, .support_error_ = 1e-18});
  EXPECT_TRUE(has(found, Claim::convexity)) << all_of(found);
}

struct RoundedBox : Box {
  using Box::Box;
  double support_error() const { return 1e-9; }
  double circumradius() const { return 2.0; }
  double inradius() const { return 0.1; }
  /// Lies by 1e-6, near one direction.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return 1.000001 * Box::support(dir);
  }
  ExactForm exact_form() const { return Box::exact_form(); }
};

TEST(Validate, ASupportErrorThatTheExactFormRefutes) {
  const std::vector<Violation> found = validate(RoundedBox(1, 1, 1));
  EXPECT_TRUE(has(found, Claim::support_error)) << all_of(found);
}

/// Of the astroid-like set |x|^(1/2) + |y|^(1/2) + |z|^(1/2) <= 1 a "support mapping" by the gradient, as users write
/// it.
struct NotConvex : ClaimingBall {
  Vec3d support(const Vec3d& d) const {
    const double sum = d.x * d.x + d.y * d.y + d.z * d.z;
    if (!(sum > 0.0)) return {};
    const auto part = [&](double x) { return std::copysign((x * x / sum) * (x * x / sum), x); };
    return {part(d.x), part(d.y), part(d.z)};
  }
};

TEST(Validate, ABodyThatIsNotConvex) {
  const std::vector<Violation> found = validate(NotConvex{{.inradius_ = 0.0}});
  EXPECT_TRUE(has(found, Claim::convexity)) << all_of(found);
}

/// Forgets to divide by the direction's length.
struct NeedsUnitVectors : ClaimingBall {
  Vec3d support(const Vec3d& d) const { return d; }
};

TEST(Validate, ABodyThatNeedsUnitVectors) {
  const std::vector<Violation> found = validate(NeedsUnitVectors{{.circumradius_ = 2.0, .inradius_ = 0.0}});
  EXPECT_TRUE(has(found, Claim::scale)) << all_of(found);
}

/// Divides by a coordinate that may be 0.
struct NanOnAxes : ClaimingBall {
  Vec3d support(const Vec3d& d) const {
    const double slope = d.y / d.x;
    return std::isnan(slope * 0.0) && d.y == 0.0 ? Vec3d{slope, 0, 0} : ball_support(1.0, d);
  }
};

TEST(Validate, ABodyWithNansOnAxes) {
  const std::vector<Violation> found = validate(NanOnAxes{});
  EXPECT_TRUE(has(found, Claim::finite_points)) << all_of(found);
}

/// Its core is half as large as it says.
struct WrongCore : Sphere {
  using Sphere::Sphere;
  bool rounds_as_kernels() const { return false; }
  double ball_radius() const { return 0.5; }
};

TEST(Validate, ABallThatIsNotTheBodys) {
  const std::vector<Violation> found = validate(WrongCore(1.0));
  EXPECT_TRUE(has(found, Claim::ball_part)) << all_of(found);
}

struct WrongGenerators : Box {
  using Box::Box;
  Generators generators() const { return Box(2, 2, 2).generators(); }
};

TEST(Validate, GeneratorsOfAnotherBody) { EXPECT_TRUE(has(validate(WrongGenerators(1, 1, 1)), Claim::generators)); }

class WrongPowers : public Superball {
 public:
  using Superball::Superball;
  PowerForm power_form() const { return Superball(2.0 * exponent_along(), 1.0).power_form(); }
};

TEST(Validate, PowersOfAnotherBody) {
  EXPECT_TRUE(has(validate(WrongPowers(2.0, 1.0)), Claim::power_form));
  EXPECT_FALSE(has(validate(Superball(2.0, 1.0)), Claim::power_form));
}

// An exponent a little above the least one, said to be that: they differ near two directions alone.
class NearlyFlatPowers : public Superellipsoid {
 public:
  NearlyFlatPowers(double excess, bool across)
      : Superellipsoid(1.0, 0.7, 0.5, 0.5 * (across ? 1.0 + excess : 2.0), 0.5 * (across ? 2.0 : 1.0 + excess)),
        across_(across) {}
  PowerForm power_form() const {
    PowerForm form = Superellipsoid::power_form();
    (across_ ? form.across : form.along) = 1.0;
    return form;
  }

 private:
  bool across_;
};

TEST(Validate, PowersThatAreOthersInFewDirections) {
  for (const double excess : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    for (const bool across : {false, true}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        ValidationSettings settings;
        settings.seed = seed;
        EXPECT_TRUE(has(validate(NearlyFlatPowers(excess, across), settings), Claim::power_form)) << excess << across;
      }
    }
  }
}

// A box, which has both exponents infinite.
struct InfinitePowers : Box {
  using Box::Box;
  PowerForm power_form() const { return {{0.5, 1.0, 1.5}, HUGE_VAL, HUGE_VAL}; }
};

TEST(Validate, InfinitePowersAreABoxs) {
  EXPECT_FALSE(has(validate(InfinitePowers(1.0, 2.0, 3.0)), Claim::power_form));
  EXPECT_TRUE(has(validate(InfinitePowers(1.0, 2.0, 3.1)), Claim::power_form));
}

// Thicker than it says, by a part in 10^9.
struct WrongProfile : Lens {
  using Lens::Lens;
  ProfileForm profile_form() const { return LensProfile(radius(), 0.5 * thickness() * (1.0 + 1e-9)); }
};

TEST(Validate, ProfilesOfAnotherBody) {
  EXPECT_TRUE(has(validate(WrongProfile(1.0, 0.3)), Claim::profile_form));
  for (const ConvexBody& body : {ConvexBody(Lens(1.0, 0.3)), ConvexBody(Lens(1.0, 1e-8)), ConvexBody(Spindle(2.0, 0.5)),
                                 ConvexBody(Spindle(1.0, 1e-9)), ConvexBody(CutSphere(1.0, 0.3, 1e-7)),
                                 ConvexBody(Egg(1.0, 0.5, 30.0)), ConvexBody(Egg(1e-7, 0.5, 0.3))}) {
    for (const Violation& broken : validate(body)) ADD_FAILURE() << broken.text;
  }
}

// Radii of rims, and an egg's image, were products that over- or underflowed.
TEST(Validate, ProfilesOfAnySize) {
  for (const double size : {1e-200, 1e-160, 1e160, 1e200}) {
    for (const ConvexBody& body :
         {ConvexBody(CutSphere(size, 0.3 * size, size)), ConvexBody(Egg(size, 0.5 * size, 2.0 * size)),
          ConvexBody(Lens(size, 0.3 * size)), ConvexBody(Spindle(size, 0.2 * size))}) {
      for (const Violation& broken : validate(body)) ADD_FAILURE() << size << ": " << broken.text;
    }
  }
}

// Far larger than what it is of: its mapping's point is not lost to an overflow.
struct HugeEggProfile : Egg {
  using Egg::Egg;
  ProfileForm profile_form() const { return EggProfile(1e200, 1e200, 1e200); }
};

TEST(Validate, AHugeProfileOfASmallBody) {
  EXPECT_TRUE(has(validate(HugeEggProfile(1.0, 0.5, 2.0)), Claim::profile_form));
}

// A sphere at the rim of a cut sphere, 10^-5 and 10^-6 of its size off contact, was said to be on the other side.
TEST(CutSpheres, OfAnySizeAreDecidedAlike) {
  for (const double size : {1.0, 0x1p-500, 0x1p-531, 0x1p-600, 0x1p500}) {
    for (int k = 0; k < 40; ++k) {
      const double b = 0.1 + 0.004 * k, rim = std::sqrt((1.0 - b) * (1.0 + b)), angle = 0.5 * std::acos(b);
      const ConvexBody cut = CutSphere(size, b * size, b * size), ball = Sphere(0.5 * size);
      for (const double gap : {-1e-5, -1e-6, 1e-6, 1e-5}) {
        Transformd pose;
        pose.translation = size * Vec3d{rim + std::sin(angle) * (0.5 + gap), 0.0, b + std::cos(angle) * (0.5 + gap)};
        const Outcome found = overlap(cut, ball, pose).outcome;
        ASSERT_EQ(found, gap > 0.0 ? Outcome::disjoint : Outcome::overlap) << size << " " << b << " " << gap;
      }
    }
  }
}

struct WrongRolling : Ellipsoid {
  using Ellipsoid::Ellipsoid;
  double rolling_radius() const { return 1.0; }
};

TEST(Validate, ABallThatDoesNotRoll) {
  EXPECT_TRUE(has(validate(WrongRolling(1, 2, 3)), Claim::rolling_radius)) << "a third";
}

/// The hull of a ball and a far point that it forgets where the direction is not exactly towards it: found because
/// support points that were met are tried against all directions.
struct Forgetful : ClaimingBall {
  Vec3d support(const Vec3d& d) const {
    return d.x > 0.0 && d.y == 0.0 && d.z == 0.0 ? Vec3d{1.5, 0, 0} : ClaimingBall::support(d);
  }
};

TEST(Validate, ABodyThatForgetsACorner) {
  const std::vector<Violation> found = validate(Forgetful{{.circumradius_ = 1.5}});
  EXPECT_TRUE(has(found, Claim::convexity)) << all_of(found);
}

TEST(Validate, NeedsADirection) { EXPECT_THROW(validate(Box(1, 1, 1), {.n_directions = 0}), UsageError); }

}  // namespace
}  // namespace vex
