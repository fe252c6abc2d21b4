#include "apps/common/number_range.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

using Texts = std::vector<std::string>;

Texts numbers(const std::string& text) { return numbers_of_range(text, "--for"); }

TEST(NumberRange, HasItsEndWhereStepsLeadThere) {
  EXPECT_EQ(numbers("1:5:2"), (Texts{"1", "3", "5"}));
  EXPECT_EQ(numbers("1:6:2"), (Texts{"1", "3", "5"}));
  EXPECT_EQ(numbers("3:3:1"), (Texts{"3"}));
  EXPECT_EQ(numbers("3:1:-1"), (Texts{"3", "2", "1"}));
  EXPECT_EQ(numbers("-1:1:0.5"), (Texts{"-1", "-0.5", "0", "0.5", "1"}));
}

TEST(NumberRange, RoundsNothing) {
  // In doubles 0.1 * 3 is no 0.3, and a sum of tenths passes by 1.
  const Texts tenths = numbers("0:1:0.1");
  ASSERT_EQ(tenths.size(), 11u);
  EXPECT_EQ(tenths[3], "0.3");
  EXPECT_EQ(tenths.back(), "1");
  const Texts many = numbers("0:1:0.0001");
  ASSERT_EQ(many.size(), 10001u);
  EXPECT_EQ(many[7], "0.0007");
}

TEST(NumberRange, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(numbers("1e-3:3e-3:1e-3"), (Texts{"0.001", "0.002", "0.003"}));
  EXPECT_EQ(numbers("1e3:3000:1e3"), (Texts{"1000", "2000", "3000"}));
  EXPECT_EQ(numbers("1e-9:2e-9:1e-9"), (Texts{"1e-9", "2e-9"}));
  EXPECT_EQ(numbers("1e30:2e30:1e30"), (Texts{"1e30", "2e30"}));
  EXPECT_EQ(numbers("0010.50:11:.5"), (Texts{"10.5", "11"}));
  EXPECT_EQ(numbers("0.00001:0.00002:1e-5"), (Texts{"0.00001", "0.00002"}));
}

TEST(NumberRange, ReadsBackAsTheNearestDouble) {
  for (const std::string& text : numbers("-2.5:2.5:0.0125")) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    EXPECT_EQ(*end, '\0');
    EXPECT_NEAR(value / 0.0125, static_cast<double>(static_cast<long>(value / 0.0125 + (value < 0 ? -0.5 : 0.5))),
                1e-9);
  }
}

TEST(NumberRange, RefusesWhatIsNone) {
  for (const char* text : {"", "1", "1:2", "1:2:", "1:2:3:4", "::", "a:2:1", "1:2:x", "1:2:0", "1:2:-1", "2:1:1",
                           "nan:2:1", "1:inf:1", "0:1e6:1", "0:1:1e-9", "1:1e300:1", "1:2:1e-40", "0x1:2:1"}) {
    EXPECT_THROW(numbers(text), UsageError) << text;
  }
}

}  // namespace
}  // namespace vex
