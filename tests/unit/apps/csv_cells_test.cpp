#include "apps/common/csv_cells.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> found;
  CsvCells cells(line);
  while (const auto cell = cells.next()) found.emplace_back(*cell);
  return found;
}
using Cells = std::vector<std::string>;

TEST(CsvCells, AreWhatStandsBetweenCommas) {
  EXPECT_EQ(cells_of("a,b,c"), (Cells{"a", "b", "c"}));
  EXPECT_EQ(cells_of(" a\t, b ,c\r"), (Cells{"a", "b", "c"}));
  EXPECT_EQ(cells_of(""), (Cells{""}));
  EXPECT_EQ(cells_of(","), (Cells{"", ""}));
  EXPECT_EQ(cells_of("a,,"), (Cells{"a", "", ""}));
}

TEST(CsvCells, HoldCommasInQuotationMarks) {
  EXPECT_EQ(cells_of("\"box:1,2,3\",0"), (Cells{"box:1,2,3", "0"}));
  EXPECT_EQ(cells_of("0, \"a,b\" \r"), (Cells{"0", "a,b"}));
  EXPECT_EQ(cells_of("\"\",\" a \""), (Cells{"", " a "}));
  EXPECT_EQ(cells_of("\"say \"\"a,b\"\"\",c"), (Cells{"say \"a,b\"", "c"}));
  EXPECT_EQ(cells_of("\"\"\"\""), (Cells{"\""}));
  EXPECT_EQ(cells_of("a\"b,c"), (Cells{"a\"b", "c"})) << "a mark that does not begin the cell is a letter";
}

TEST(CsvCells, RefuseMarksThatDoNotEndOrAreNotAll) {
  for (const char* line : {"\"a", "\"a\"\"", "\"", "x,\"a,b"}) EXPECT_THROW(cells_of(line), InputError) << line;
  for (const char* line : {"\"a\"b", "\"a\" b,c", "\"a\"b\""}) EXPECT_THROW(cells_of(line), InputError) << line;
}

TEST(CsvCells, ComeBackAsTheyWereWritten) {
  for (const char* text : {"sphere:1", "box:1,2,3", "a \"b\"", "\"", " blanks ", "", ",", "tab\t"}) {
    EXPECT_EQ(cells_of(csv_cell(text) + ",1").at(0), text);
    EXPECT_EQ(cells_of("1," + csv_cell(text)).at(1), text);
  }
  EXPECT_EQ(csv_cell("sphere:1"), "sphere:1") << "no marks where none are needed";
}

}  // namespace
}  // namespace vex
