#include "apps/common/numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

TEST(ParseCount, ReadsWholeNumbersInBothNotations) {
  EXPECT_EQ(parse_count("1", "--n"), 1u);
  EXPECT_EQ(parse_count("1e7", "--n"), 10000000u);
  EXPECT_EQ(parse_count("2.5e3", "--n"), 2500u);
  EXPECT_EQ(parse_count("18446744073709551615", "--n"), ~0ull);
  for (const char* text : {"", "-1", "1.5", "1e-1", "abc", "1e20", "18446744073709551616", "inf", "nan", "1 ", " 1",
                           "0x10", "1e7x", "+1"}) {
    EXPECT_THROW(parse_count(text, "--n"), UsageError) << text;
  }
}

TEST(ParseNumber, ReadsFiniteNumbers) {
  EXPECT_EQ(parse_number("1e-3", "--x"), 1e-3);
  for (const char* text : {"", "abc", "1,5", "inf", "nan", "1e999", "1 "})
    EXPECT_THROW(parse_number(text, "--x"), UsageError) << text;
}

TEST(WithError, ShowsTwoDigitsOfTheError) {
  EXPECT_EQ(with_error(11.0007, 0.0010), "11.0007(10)");
  EXPECT_EQ(with_error(87.953, 0.0861), "87.953(86)");
  EXPECT_EQ(with_error(366.3, 2.2), "366.3(22)");
  EXPECT_EQ(with_error(100023.0, 640.0), "1.0002(64)e5");
  EXPECT_EQ(with_error(1748630.0, 3218.0), "1.7486(32)e6");
  EXPECT_EQ(with_error(2.5e-9, 1.3e-11), "2.500(13)e-9");
  EXPECT_EQ(with_error(0.0, 0.5), "0.00(50)");
}

TEST(WithError, AnErrorThatRoundsUpMovesByOnePlace) {
  EXPECT_EQ(with_error(8.0, 0.00996), "8.000(10)");
  EXPECT_EQ(with_error(8.0, 0.0099), "8.0000(99)");
}

TEST(ShortNumber, IsShort) {
  EXPECT_EQ(short_number(11.0), "11");
  EXPECT_EQ(short_number(1.5e300, 3), "1.5e300");
  EXPECT_EQ(short_number(1e-7, 3), "1e-7");
  EXPECT_EQ(short_count(1234.0), "1234");
  EXPECT_EQ(short_count(3.21e6), "3.21e6");
}

TEST(HexNumber, RoundTrips) {
  for (const double x : {0.1, -3.0, 1e-300}) EXPECT_EQ(std::strtod(hex_number(x).c_str(), nullptr), x);
}

}  // namespace
}  // namespace vex
