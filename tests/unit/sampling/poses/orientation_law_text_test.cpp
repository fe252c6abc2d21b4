#include "engine/sampling/poses/orientation_law_text.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

TEST(OrientationLawText, IsTheInverseOfTheName) {
  for (const OrientationLaw& law :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(0.1, -2.0, 3e-5, 4.0),
        OrientationLaw::cone(0.1), OrientationLaw::cone(90.0), OrientationLaw::angle(180.0),
        OrientationLaw::onsager(1e3)}) {
    EXPECT_EQ(parse_orientation_law(law.name()), law) << law.name();
  }
}

TEST(OrientationLawText, RefusesWhatIsNoLawAndNamesTheOption) {
  for (const char* text : {"", "wild", "isotropic:1", "aligned:", "cone", "cone:", "cone:x", "cone:91", "cone:-1",
                           "cone:1,2", "cone:nan", "angle:181", "onsager:-1", "onsager:inf", "fixed:1,0,0",
                           "fixed:0,0,0,0", "fixed:1,0,0,0,", "Cone:30", " cone:30"}) {
    EXPECT_THROW(parse_orientation_law(text), UsageError) << text;
  }
  const auto message = [](std::string_view option) {
    try {
      parse_orientation_law("wild", option);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string choices = "there are isotropic, aligned, fixed:W,X,Y,Z, cone:DEG, angle:DEG, onsager:ALPHA";
  EXPECT_EQ(message(""), "not a choice (\"wild\") - " + choices);
  EXPECT_EQ(message("--orientations"), "not a choice (\"wild\" for --orientations) - " + choices);
}

}  // namespace
}  // namespace vex
