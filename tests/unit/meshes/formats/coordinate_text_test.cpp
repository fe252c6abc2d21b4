#include "meshes/formats/coordinate_text.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace vex::tests {
namespace {

using Kind = CoordinateDigits::Kind;

std::string printed(char kind, int precision, double value) {
  std::array<char, 400> text{};
  switch (kind) {
    case 'f': std::snprintf(text.data(), text.size(), "%.*f", precision, value); break;
    case 'e': std::snprintf(text.data(), text.size(), "%.*e", precision, value); break;
    default: std::snprintf(text.data(), text.size(), "%.*g", precision, value);
  }
  return text.data();
}

CoordinateDigits digits_of(const std::vector<std::string>& tokens) {
  WrittenDigits written;
  for (const std::string& token : tokens) EXPECT_TRUE(written.parse(token).has_value()) << token;
  return written.digits();
}

/// Of numbers of many sizes below 100, printed so.
CoordinateDigits digits_of_random(char kind, int precision, bool are_floats = false) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  std::vector<std::string> tokens;
  for (int i = 0; i < 60; ++i) {
    const double value = std::pow(10.0, uniform(random)) * (uniform(random) < 0.0 ? -1.0 : 1.0);
    tokens.push_back(printed(kind, precision, are_floats ? static_cast<double>(static_cast<float>(value)) : value));
  }
  tokens.push_back(printed(kind, precision, are_floats ? static_cast<double>(97.3210987654F) : 97.3210987654321));
  return digits_of(tokens);
}

TEST(CoordinateText, ReadsEveryWayOfWritingANumber) {
  for (const auto& [token, value] :
       std::vector<std::pair<const char*, double>>{{"0", 0.0},
                                                   {"12", 12.0},
                                                   {"-12", -12.0},
                                                   {"+12", 12.0},
                                                   {"1.", 1.0},
                                                   {".5", 0.5},
                                                   {"-.5", -0.5},
                                                   {"+.5e+3", 500},
                                                   {"5.e-1", 0.5},
                                                   {"1e3", 1000.0},
                                                   {"1E+03", 1000.0},
                                                   {"2e-2", 0.02},
                                                   {"007.50", 7.5},
                                                   {"1e22", 1e22},
                                                   {"1e23", 1e23},
                                                   {"0.1", 0.1},
                                                   {"00000.1", 0.1},
                                                   {"1e-5", 1e-5},
                                                   {"0e999999", 0.0},
                                                   {"0.3e1", 3.0},
                                                   {"1e308", 1e308},
                                                   {"4.9e-324", 4.9e-324},
                                                   {"1e-400", 0.0},
                                                   {"2.4e-324", 0.0},
                                                   {"2.5e-324", 4.9e-324},
                                                   {"1e-310", 1e-310},
                                                   {"9007199254740993", 9007199254740992.0},
                                                   {"9007199254740993.0000000000000000001", 9007199254740994.0},
                                                   {"1e-99999999999999999999", 0.0},
                                                   {"0e99999999999999999999", 0.0},
                                                   {"2.2250738585072011e-308", 2.2250738585072011e-308},
                                                   {"1.7976931348623157e308", std::numeric_limits<double>::max()}}) {
    const std::optional<double> read = parse_decimal(token);
    ASSERT_TRUE(read.has_value()) << token;
    EXPECT_EQ(*read, value) << token;
  }
  EXPECT_TRUE(std::signbit(*parse_decimal("-0.0")));
  EXPECT_TRUE(std::signbit(*parse_decimal("-1e-400")));
  // A long way round to 1: the exponent makes up for the zeros.
  EXPECT_EQ(parse_decimal("0." + std::string(1000, '0') + "1e1001"), 1.0);
  EXPECT_EQ(parse_decimal("1" + std::string(1000, '0') + "e-1000"), 1.0);
}

TEST(CoordinateText, RefusesWhatIsNoFiniteDecimalNumber) {
  for (const char* token : {"",
                            ".",
                            "-",
                            "+",
                            "-.",
                            "e5",
                            ".e5",
                            "1e",
                            "1e+",
                            "1e-",
                            "1E",
                            "1.0D+01",
                            "1d0",
                            "1x",
                            "x1",
                            "0x10",
                            "0x1p3",
                            "1,5",
                            "1'000",
                            "1_0",
                            "1 ",
                            " 1",
                            "--1",
                            "+-1",
                            "-+1",
                            "++1",
                            "1.2.3",
                            "1e5.5",
                            "1e5e5",
                            "nan",
                            "NaN",
                            "-nan",
                            "inf",
                            "-inf",
                            "Infinity",
                            "1e400",
                            "-1e400",
                            "1.7976931348623159e308",
                            "1e99999999999999999999",
                            "1f",
                            "1.0f",
                            "½",
                            "١",
                            "1\t",
                            "1\r",
                            "1#"}) {
    EXPECT_FALSE(parse_decimal(token).has_value()) << "'" << token << "'";
  }
  EXPECT_FALSE(parse_decimal(std::string_view("1\0", 2)).has_value());
}

TEST(CoordinateText, RoundsCorrectly) {
  std::mt19937_64 random(1);
  const auto below = [&random](std::uint64_t n) { return random() % n; };
  for (int i = 0; i < 300'000; ++i) {
    std::string token;
    if (i % 3 == 0) {  // of doubles, and of what lies halfway between two of them, cut anywhere
      double value = std::bit_cast<double>(random());
      while (!std::isfinite(value)) value = std::bit_cast<double>(random());
      if (i % 2 == 0) value = std::ldexp(static_cast<double>(random() >> 11U), static_cast<int>(below(90)) - 100);
      std::array<char, 120> text{};
      std::snprintf(text.data(), text.size(), "%.*e", static_cast<int>(below(60)), value);
      token = text.data();
      if (i % 2 == 0) {
        const long double half = static_cast<long double>(2 * (random() >> 11U) + 1) / 0x1p60L;
        std::snprintf(text.data(), text.size(), "%.*Lf", static_cast<int>(15 + below(50)), half);
        token = text.data();
      }
    } else {
      for (std::uint64_t n = below(25); n > 0; --n) token += static_cast<char>('0' + below(10));
      token += '.';
      for (std::uint64_t n = 1 + below(25); n > 0; --n) token += static_cast<char>('0' + below(10));
      if (below(2) == 0) token += "e" + std::to_string(static_cast<int>(below(60)) - 30);
    }
    const double expected = std::strtod(token.c_str(), nullptr);  // no test changes the C locale
    const std::optional<double> read = parse_decimal(token);
    ASSERT_TRUE(read.has_value()) << token;
    ASSERT_EQ(*read, expected) << token;
  }
}

TEST(WrittenDigits, KnowsAFixedNumberOfDecimals) {
  const CoordinateDigits digits = digits_of_random('f', 4);
  EXPECT_EQ(digits.kind, Kind::decimals);
  EXPECT_EQ(digits.n_digits, 6);  // 97.3211
  EXPECT_DOUBLE_EQ(digits.last_place, 1e-4);
  EXPECT_DOUBLE_EQ(digits_of({"0.0012", "-0.0030"}).last_place, 1e-4);
}

TEST(WrittenDigits, KnowsAFixedNumberOfSignificantDigits) {
  for (int n = 2; n <= 14; ++n) {
    if (n == 8 || n == 9) continue;  // as fine as floats are: see below
    for (const char kind : {'g', 'e'}) {
      const int n_printed = kind == 'e' ? n - 1 : n;
      const CoordinateDigits digits = digits_of_random(kind, n_printed);
      EXPECT_EQ(digits.kind, Kind::decimals) << n << kind;
      EXPECT_EQ(digits.n_digits, n) << n << kind;
      EXPECT_NEAR(digits.last_place, std::pow(10.0, 2 - n), 1e-9 * digits.last_place) << n << kind;
    }
  }
  EXPECT_EQ(digits_of({"1.23457e+08", "-3.2e+07", "0"}).last_place, 1000.0);
  EXPECT_DOUBLE_EQ(digits_of({"1.23457e-20", "-3.2e-21"}).last_place, 1e-25);
}

// A prism of one-digit numbers had a last place of 1, and corners that were so near to each other were joined.
TEST(WrittenDigits, TakesAFewShortNumbersAtTheirDecimals) {
  EXPECT_EQ(digits_of({"1", "2", "3", "5e-17"}).kind, Kind::doubles);
  EXPECT_DOUBLE_EQ(digits_of({"0.1", "9", "1", "0"}).last_place, 0.1);
  EXPECT_DOUBLE_EQ(digits_of({"12.3", "0.0123"}).last_place, 1e-4);
}

TEST(WrittenDigits, KnowsDoublesByTheirLastDigits) {
  const CoordinateDigits digits = digits_of_random('g', 17);
  EXPECT_EQ(digits.kind, Kind::doubles);
  EXPECT_EQ(digits.last_place, 0x1p-46);  // of 97
}

TEST(WrittenDigits, KnowsFloatsInTextThatIsFinerThanThey) {
  for (const auto& [kind, precision] :
       std::vector<std::pair<char, int>>{{'g', 9}, {'g', 12}, {'g', 17}, {'f', 10}, {'f', 20}}) {
    const CoordinateDigits digits = digits_of_random(kind, precision, true);
    EXPECT_EQ(digits.kind, Kind::floats) << kind << precision;
    EXPECT_EQ(digits.last_place, 0x1p-17) << kind << precision;  // of 97
  }
  EXPECT_EQ(digits_of_random('g', 6, true).kind, Kind::decimals);  // coarser than they
  EXPECT_EQ(digits_of_random('f', 4, true).kind, Kind::decimals);
}

TEST(WrittenDigits, SeesNoRoundingInNumbersThatAreDoublesExactly) {
  for (const std::vector<std::string>& tokens : std::vector<std::vector<std::string>>{{"0.5", "12", "-0.375"},
                                                                                      {"0.5000", "12.000", "-0.375000"},
                                                                                      {"100", "200", "-7"},
                                                                                      {"1e3", "2.5e2"},
                                                                                      {"0.50000000000000000000000000"},
                                                                                      {"0", "0.0", "0.000000"}}) {
    EXPECT_EQ(digits_of(tokens).kind, Kind::doubles) << tokens[0];
  }
  EXPECT_EQ(digits_of({"0.5", "12", "0.1"}).kind, Kind::decimals);
  EXPECT_NE(digits_of({"0.50000000000000000000000001"}).kind, Kind::decimals);  // finer than any
  EXPECT_EQ(digits_of({"1", "0"}).last_place, 0x1p-52);
}

TEST(WrittenDigits, TakesWholeNumbersOfSixDigitsForRoundedOnesUnlessOthersTell) {
  // %g prints 123456.7 so, and a shorter number beside it is whole by chance one time in ten.
  EXPECT_EQ(digits_of({"123457", "-500001", "0"}).last_place, 1.0);
  EXPECT_EQ(digits_of({"123457", "-500001", "98765", "0"}).kind, Kind::decimals);
  EXPECT_EQ(digits_of({"1234567", "-5000001"}).kind, Kind::decimals);
  EXPECT_EQ(digits_of({"123457", "-500001", "12", "7", "100"}).kind, Kind::doubles);
  EXPECT_EQ(digits_of({"100000", "-500000", "100000", "0"}).kind, Kind::doubles);
  EXPECT_EQ(digits_of(std::vector<std::string>(50, "-98765")).kind, Kind::doubles);
  std::vector<std::string> tokens(50, "98765");  // told once, however often it comes
  tokens.emplace_back("123457");
  EXPECT_EQ(digits_of(tokens).kind, Kind::decimals);
  tokens.clear();
  for (int i = 0; i < 2000; ++i) tokens.push_back(std::to_string(100'000 + 2417 * i % 900'000));
  EXPECT_EQ(digits_of(tokens).kind, Kind::decimals);
  for (std::string& token : tokens) token.resize(5);
  EXPECT_EQ(digits_of(tokens).kind, Kind::doubles);
}

TEST(WrittenDigits, StaysWithinNumbersAtEitherEndOfThem) {
  EXPECT_EQ(double_digits(0.0).last_place, 0x1p-1074);
  EXPECT_EQ(double_digits(std::numeric_limits<double>::max()).last_place, 0x1p971);
  EXPECT_EQ(float_digits(std::numeric_limits<float>::max()).last_place, 0x1p104);
  EXPECT_EQ(float_digits(1.0).last_place, 0x1p-23);
  EXPECT_EQ(float_digits(0.0).last_place, 0x1p-149);
  EXPECT_TRUE(std::isfinite(digits_of({"1.7976931348623157e308", "1e-400", "-1.1e308"}).last_place));
  EXPECT_TRUE(std::isfinite(digits_of({"1.1e308"}).last_place));
  EXPECT_GT(digits_of({"1.1e-320"}).last_place, 0.0);
  EXPECT_TRUE(std::isfinite(digits_of({"0." + std::string(10'000, '1')}).last_place));
}

TEST(WrittenDigits, NotesWhatWasParsedElsewhere) {
  WrittenDigits written;
  written.note("0.1235", 0.1235);
  written.note("-4.5", -4.5);
  EXPECT_EQ(written.digits().n_digits, 4);
  EXPECT_FALSE(written.parse("x").has_value());
  EXPECT_EQ(written.digits().n_digits, 4);
}

}  // namespace
}  // namespace vex::tests
