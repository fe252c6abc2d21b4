// Poses as text: what is read, to the last bit, and what is refused, with what is said of it.
#include "apps/vex_pair/pose_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

const std::string kMatrixHeader = "r11,r12,r13,r21,r22,r23,r31,r32,r33,tx,ty,tz";
const std::string kQuaternionHeader = "tx,ty,tz,qw,qx,qy,qz";

// What an Error of this kind says; a failure where there is none.
template <class Refusal, class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const Refusal& error) {
    return error.what();
  }
  ADD_FAILURE() << "not refused";
  return "";
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is missing in \"" << text << "\"";
  EXPECT_NE(text.find(" - "), std::string::npos) << "what to do is missing in \"" << text << "\"";
}

void expect_row_refused(const std::string& row, PoseFormat format, const std::string& part) {
  SCOPED_TRACE(row);
  expect_part(refusal_of<InputError>([&] { pose_of_row(row, format); }), part);
}

TEST(PoseText, BothHeadersAreKnown) {
  EXPECT_EQ(format_of_header(kMatrixHeader), PoseFormat::matrix);
  EXPECT_EQ(format_of_header(kQuaternionHeader), PoseFormat::quaternion);
  EXPECT_EQ(format_of_header(" tx , ty,\ttz,qw,qx,qy,qz \r"), PoseFormat::quaternion);
}

TEST(PoseText, AMistypedHeaderIsRefusedWithTheColumn) {
  const auto expect_refused = [](const std::string& line, const std::string& part) {
    SCOPED_TRACE(line);
    const std::string message = refusal_of<InputError>([&] { format_of_header(line); });
    expect_part(message, part);
    expect_part(message, kMatrixHeader);
    expect_part(message, kQuaternionHeader);
  };
  expect_refused("r11,r12,r13,r14,r22,r23,r31,r32,r33,tx,ty,tz", "\"r14\" where r21 is expected");
  expect_refused("r11,r12,r13", "nothing where r21 is expected");
  expect_refused(kMatrixHeader + ",id", "a further column \"id\"");
  expect_refused(kQuaternionHeader + ",", "a further column \"\"");
  expect_refused("qw,qx,qy,qz,tx,ty,tz", "\"qw\" where tx is expected");
  expect_refused("tx,ty,tz,qx,qy,qz,qw", "\"qx\" where qw is expected");
  expect_refused("TX,TY,TZ,QW,QX,QY,QZ", "\"TX\" where tx is expected");
  expect_refused("tx;ty;tz;qw;qx;qy;qz", "where tx is expected");
  expect_refused("tx ty tz qw qx qy qz", "where tx is expected");
  expect_refused("", "\"\" where tx is expected");
  expect_refused("0,0,0,1,0,0,0", "the header is missing");
  expect_refused("0x1p0,0,0,0,1,0,0,0,1,0,0,0", "the header is missing");
  expect_refused(std::string(5000, 'x'), "...\" where tx is expected");
}

TEST(PoseText, AMatrixIsTakenAsItIs) {
  const Transformd pose = pose_of_row("1,0,0,0,1,1e-7,0,0,1,0.1,-2,3e5", PoseFormat::matrix);
  EXPECT_EQ(twelve_numbers(pose), (std::vector<double>{1, 0, 0, 0, 1, 1e-7, 0, 0, 1, 0.1, -2, 3e5}));
}

TEST(PoseText, HexadecimalNumbersAreExact) {
  const std::vector<double> numbers = {-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.1, -1.0 / 3.0, 0x1p-1074};
  std::string row;
  for (const double number : numbers) row += (row.empty() ? "" : ",") + hex_number(number);
  EXPECT_EQ(twelve_numbers(pose_of_row(row, PoseFormat::matrix)), numbers);
  for (const double number : {0.1, -0.1, 0x1.fffffffffffffp1023, 0x1p-1022, 0x0.fffffffffffffp-1022, 0x1p-1074}) {
    EXPECT_EQ(pose_number(hex_number(number), "t"), number) << hex_number(number);
  }
  EXPECT_EQ(pose_number("0X1.8P-3", "t"), 0.1875);
  EXPECT_EQ(pose_number("-0x10", "t"), -16.0);
}

TEST(PoseText, NumbersAsSpreadsheetsAndPrintfWriteThem) {
  for (const auto& [text, number] :
       std::vector<std::pair<std::string, double>>{{"1", 1.0},
                                                   {" 1.5 ", 1.5},
                                                   {"\t-2.", -2.0},
                                                   {"+3", 3.0},
                                                   {".5", 0.5},
                                                   {"1E3", 1000.0},
                                                   {"1e+03", 1000.0},
                                                   {"-0", 0.0},
                                                   {"5e-324", 0x1p-1074},
                                                   {"0.1000000000000000055511151", 0.1},
                                                   {"1.7976931348623157e308", 0x1.fffffffffffffp1023}}) {
    EXPECT_EQ(pose_number(text, "t"), number) << text;
  }
  EXPECT_TRUE(std::signbit(pose_number("-0.0", "t")));
}

TEST(PoseText, WhatIsNoNumberIsRefused) {
  for (const char* text : {"",   " ",  "x",   "1x",    "1 2",   "--1",  "+-1", "-+1", "0x", "0xg", "0x-1", "-0x-1",
                           "1e", "e5", "1,5", "\"1\"", "1.2.3", "0x1p", "one", ".",   "-",  "1d0", "NULL"}) {
    SCOPED_TRACE(text);
    expect_part(refusal_of<UsageError>([&] { pose_number(text, "--matrix"); }), "for --matrix)");
  }
  for (const char* text : {"nan", "inf", "-inf", "NaN", "Infinity", "-nan", "nan(1)"}) {
    expect_part(refusal_of<InputError>([&] { pose_number(text, "tx"); }), "not finite");
  }
  for (const char* text : {"1e400", "-1e400", "1e-400", "0x1p2000"}) {
    expect_part(refusal_of<InputError>([&] { pose_number(text, "tx"); }), "out of the range of doubles");
  }
}

TEST(PoseText, ARowThatIsBadIsRefusedWithTheColumn) {
  using enum PoseFormat;
  expect_row_refused("", matrix, "an empty row");
  expect_row_refused("  \t", quaternion, "an empty row");
  expect_row_refused("1,0,0,0,1,0,0,0,1,0,0", matrix, "wrong number of columns (11)");
  expect_row_refused("1,0,0,0,1,0,0,0,1,0,0,0,0", matrix, "wrong number of columns (13)");
  expect_row_refused("1,0,0,0,1,0,0,0,1,0,0,0,", matrix, "wrong number of columns (13)");
  expect_row_refused("0,0,0,1,0,0,0", matrix, "wrong number of columns (7) - the header has 12");
  expect_row_refused("0;0;0;1;0;0;0", quaternion, "wrong number of columns (1)");
  expect_row_refused("0,0,0,1,0,,0", quaternion, "not a number (\"\" for qy)");
  expect_row_refused("0,zero,0,1,0,0,0", quaternion, "not a number (\"zero\" for ty)");
  expect_row_refused("0,0,0,1,0,0,0#", quaternion, "not a number (\"0#\" for qz)");
  expect_row_refused("nan,0,0,1,0,0,0", quaternion, "not finite (\"nan\" for tx)");
  expect_row_refused("0,0,0,inf,0,0,0", quaternion, "not finite (\"inf\" for qw)");
  expect_row_refused("0,0,0,1e999,0,0,0", quaternion, "out of the range of doubles (\"1e999\" for qw)");
  expect_row_refused("0,0,0,0,-0,0.0,0", quaternion, "a quaternion of length 0");
  expect_row_refused("1,0,0,0,1,0,0,0,-1,0,0,0", matrix, "a reflection is no pose");
  expect_row_refused("2,0,0,0,2,0,0,0,2,0,0,0", matrix, "not a rotation (max|R^T R - 1| = 3,");
  expect_row_refused("0,0,0,0,0,0,0,0,0,0,0,0", matrix, "not a rotation");
  expect_row_refused("1e200,0,0,0,1,0,0,0,1,0,0,0", matrix, "not a rotation (max|R^T R - 1| = inf,");
  expect_row_refused("1e308,1e308,0,-1e308,1e308,0,0,0,1,0,0,0", matrix, "not a rotation");
  expect_row_refused(std::string("0,0,\0,1,0,0,0", 13), quaternion, "(\"\\x00\" for tz)");
  expect_row_refused("0,0,0,1,0,0," + std::string(5000, '9') + "x", quaternion, "999...\" for qz)");
  expect_row_refused("0,\xff,0,1,0,0,0", quaternion, "(\"\xef\xbf\xbd\" for ty)");
  expect_row_refused("0,0,0,1,0,0," + std::string(39, '9') + "\xc3\xa9", quaternion, "999...\" for qz)");
}

TEST(PoseText, ARotationIsOneToWithinAMillionth) {
  const auto with_shear = [](double shear) {
    return std::array<double, 12>{1.0, shear, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  };
  const auto with_stretch = [](double stretch) {
    return std::array<double, 12>{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 + stretch, 0.0, 0.0, 0.0};
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(pose_of_matrix(with_shear(sign * 0.999e-6)).row_x.y, sign * 0.999e-6);
    EXPECT_EQ(pose_of_matrix(with_stretch(sign * 0.499e-6)).row_z.z, 1.0 + sign * 0.499e-6);
    refusal_of<InputError>([&] { pose_of_matrix(with_shear(sign * 1.001e-6)); });
    refusal_of<InputError>([&] { pose_of_matrix(with_stretch(sign * 0.501e-6)); });
  }
}

TEST(PoseText, AQuaternionOfAnyLengthIsTheSameRotation) {
  Transformd expected = rotation_from_quaternion(1.0, 2.0, 3.0, 4.0);
  expected.translation = {5.0, 6.0, 7.0};
  for (const char* row :
       {"5,6,7,1,2,3,4", "5,6,7,0x1p-1074,0x1p-1073,0x1.8p-1073,0x1p-1072", "5,6,7,-4e0,-8,-12,-16"}) {
    EXPECT_EQ(twelve_numbers(pose_of_row(row, PoseFormat::quaternion)), twelve_numbers(expected)) << row;
  }
}

TEST(PoseText, TheNumbersOfAnOption) {
  std::array<double, 3> numbers{};
  read_numbers(" 1, -2 ,0x1p-1", "--translation", numbers);
  EXPECT_EQ(numbers, (std::array<double, 3>{1.0, -2.0, 0.5}));
  const auto refused = [&](const char* text) {
    return refusal_of<UsageError>([&] { read_numbers(text, "--translation", numbers); });
  };
  expect_part(refused("1,2"), "wrong number of numbers (2 for --translation) - give 3");
  expect_part(refused("1,2,3,4"), "wrong number of numbers (4");
  expect_part(refused("1 2 3"), "wrong number of numbers (1");
  expect_part(refused("1,,3"), "not a number (\"\" for --translation)");
}

}  // namespace
}  // namespace vex
