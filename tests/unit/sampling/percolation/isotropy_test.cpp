#include "engine/sampling/percolation/isotropy.h"

#include <gtest/gtest.h>

#include "engine/support/combinators.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

bool is_isotropic_with(std::vector<std::string_view> bodies, const BodyOrientations& orientations) {
  std::vector<BodyPart> parts;
  for (const std::string_view body : bodies) parts.push_back({parse_shape(body).body, 1.0});
  return is_isotropic(Placements(std::move(parts), orientations, 1));
}

TEST(Isotropy, OfLaws) {
  EXPECT_TRUE(is_isotropic_with({"box:1,2,3"}, {}));
  EXPECT_TRUE(is_isotropic_with({"box:1,2,3"}, {OrientationLaw::cone(90.0)}));
  EXPECT_TRUE(is_isotropic_with({"box:1,2,3"}, {OrientationLaw::onsager(0.0)}));
  EXPECT_FALSE(is_isotropic_with({"box:1,1,1"}, {OrientationLaw::cone(89.0)}));
  EXPECT_FALSE(is_isotropic_with({"box:1,1,1"}, {OrientationLaw::onsager(0.1)}));
  EXPECT_FALSE(is_isotropic_with({"capsule:1,1"}, {OrientationLaw::isotropic(), true}));
}

TEST(Isotropy, OfBallsWhateverTheLaw) {
  EXPECT_TRUE(is_isotropic_with({"sphere:1", "sphere:2"}, {OrientationLaw::cone(10.0)}));
  EXPECT_TRUE(is_isotropic_with({"sphere:1"}, {OrientationLaw::aligned(), true}));
  EXPECT_FALSE(is_isotropic_with({"sphere:1", "capsule:1,1"}, {OrientationLaw::cone(10.0)}));
}

TEST(Isotropy, OfAlignedBodiesThatAreAlikeAlongTheAxes) {
  const BodyOrientations aligned{OrientationLaw::aligned()};
  for (const char* body : {"box:1,1,1", "rounded:0.3,box:1,1,1", "octahedron:1", "sphere:1", "ellipsoid:2,2,2"}) {
    EXPECT_TRUE(is_isotropic_with({body}, aligned)) << body;
  }
  for (const char* body :
       {"box:1,1,1.001", "box:3,3,1", "ellipsoid:1,1,4", "cylinder:1,0.5", "cone:1,1", "disc:1", "capsule:0.01,1"}) {
    EXPECT_FALSE(is_isotropic_with({body}, aligned)) << body;
  }
  EXPECT_TRUE(is_isotropic_with({"box:1,1,1", "sphere:1"}, aligned));
  EXPECT_FALSE(is_isotropic_with({"box:1,1,1", "box:1,1,2"}, aligned));
}

}  // namespace
}  // namespace vex
