#include "meshes/length_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>

#include "refusal.h"

namespace vex::tests {
namespace {

LengthUnit unit(const std::string& name) { return parse_length_unit(name).value(); }

PolygonSoup soup_in(const LengthUnit& its_unit, std::initializer_list<Vec3d> points) {
  PolygonSoup soup;
  soup.points = points;
  soup.unit = its_unit.name;
  soup.unit_metres = its_unit.metres;
  soup.digits.last_place = 0.5;
  return soup;
}

PolygonSoup converted(PolygonSoup soup, const std::string& to) {
  convert_unit(soup, unit(to));
  return soup;
}

TEST(LengthUnit, HasSeveralNames) {
  EXPECT_EQ(unit("mm").metres, 0.001);
  EXPECT_EQ(unit("Millimeter").name, "mm");
  EXPECT_EQ(unit("MICRON").name, "um");
  EXPECT_EQ(unit("\xC2\xB5m").name, "um");
  EXPECT_EQ(unit("in").metres, 0.0254);
  EXPECT_EQ(unit("foot").metres, 0.3048);
  for (const char* none : {"", " mm", "mmm", "parsec", "m m"}) EXPECT_FALSE(parse_length_unit(none)) << none;
}

TEST(LengthUnit, OfAFileIsTheOneOfThatSize) {
  EXPECT_EQ(stated_length_unit("centimeter", 0.01)->name, "cm");
  EXPECT_EQ(stated_length_unit("", 0.0254)->name, "in");
  const std::optional<LengthUnit> promoted = stated_length_unit("", double{0.01F});
  ASSERT_TRUE(promoted.has_value());
  EXPECT_EQ(promoted->name, "cm");
  EXPECT_EQ(promoted->metres, 0.01);
  EXPECT_EQ(stated_length_unit("yard", 0.9144)->name, "yard");
  EXPECT_EQ(stated_length_unit("yard", 0.9144)->metres, 0.9144);
  EXPECT_EQ(stated_length_unit("inch", 1.5)->name, "1.5 m");  // its name lies
  EXPECT_EQ(stated_length_unit("", 2.0)->name, "2 m");
  for (const double none : {0.0, -1.0, std::nan(""), HUGE_VAL}) EXPECT_FALSE(stated_length_unit("m", none)) << none;
}

TEST(ConvertUnit, KeepsEveryBitInTheSameUnit) {
  const PolygonSoup soup = soup_in(unit("mm"), {{-0.0, 0.1, 1e-310}, {1e300, 1.0 / 3.0, -7.0}});
  const PolygonSoup same = converted(soup, "mm");
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(norm(same.points[i] - soup.points[i]), 0.0);
  EXPECT_TRUE(std::signbit(same.points[0].x));
  EXPECT_EQ(same.digits.last_place, 0.5);
}

TEST(ConvertUnit, RoundsOnceWhereOneUnitIsAWholeMultipleOfTheOther) {
  for (int i = 1; i < 2000; ++i) {
    const double x = i;
    EXPECT_EQ(converted(soup_in(unit("mm"), {{x, 0, 0}}), "m").points[0].x, x / 1000);
    EXPECT_EQ(converted(soup_in(unit("um"), {{0, x, 0}}), "mm").points[0].y, x / 1000);
    EXPECT_EQ(converted(soup_in(unit("m"), {{0, 0, x / 1000}}), "nm").points[0].z, x / 1000 * 1e9);
    EXPECT_EQ(converted(soup_in(unit("ft"), {{x, 0, 0}}), "in").points[0].x, 12 * x);
    EXPECT_EQ(converted(soup_in(unit("in"), {{x, 0, 0}}), "mm").points[0].x, x * 25.4);
  }
}

TEST(ConvertUnit, ScalesTheLastPlaceAndNamesTheNewUnit) {
  const PolygonSoup soup = converted(soup_in({"yard", 0.9144}, {{1, 2, 3}}), "m");
  EXPECT_DOUBLE_EQ(soup.points[0].z, 3 * 0.9144);
  EXPECT_DOUBLE_EQ(soup.digits.last_place, 0.5 * 0.9144);
  EXPECT_EQ(soup.unit, "m");
  EXPECT_EQ(soup.unit_metres, 1.0);
}

TEST(ConvertUnit, RefusesASoupWithoutUnit) {
  PolygonSoup soup;
  EXPECT_TRUE(contains(refusal_of([&] { convert_unit(soup, unit("mm")); }), "states no unit"));
}

}  // namespace
}  // namespace vex::tests
