// Answers as rows: JSON that parses and reads back to the last bit, CSV with as many cells as its header.
#include "apps/vex_pair/row_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace vex {
namespace {

using Format = RowLayout::Format;
using nlohmann::json;

Answer disjoint_answer() {
  Answer answer;
  answer.verdict = Verdict::disjoint(DecidedBy::exact);
  answer.certificate.separating_dir = {0.1, -1.0 / 3.0, 1e-300};
  answer.certificate.separating_dir_low = {0x1p-60, 0.0, -0x1p-1074};
  answer.n_support_calls = 7;
  answer.check = CertificateCheck{true, ""};
  return answer;
}

Answer overlap_answer() {
  Answer answer;
  answer.verdict = Verdict::overlap(DecidedBy::double_double);
  answer.certificate.n_witnesses = 2;
  answer.certificate.witnesses[0] = {{1, 2, 3}, {4, 5, 6}, {10, 11, 12}, {13, 14, 15}, {7, 8, 9}, {0.1, 0.2, 0.3}};
  answer.certificate.witnesses[1] = {{-1, -2, -3},    {-4, -5, -6}, {-10, -11, -12},
                                     {-13, -14, -15}, {-7, -8, -9}, {-0.1, -0.2, -0.3}};
  answer.check = CertificateCheck{false, "a \"fault\""};
  return answer;
}

Answer undecided_answer() {
  Answer answer;
  answer.verdict = Verdict::undecided(DecidedBy::double_double, UndecidedReason::rounding);
  answer.lower = -0x1p-52;
  return answer;
}

std::string row(const RowLayout& layout, const Answer& answer, std::uint64_t index = 3) {
  std::string text;
  append_row(text, layout, index, answer);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.back(), '\n');
  return text;
}

std::size_t n_cells(const std::string& row) {
  return static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1;
}

TEST(RowText, JsonHasTheKeysOfTheContract) {
  const json disjoint = json::parse(row({Format::jsonl}, disjoint_answer(), 18446744073709551615u));
  EXPECT_EQ(disjoint, (json{{"index", 18446744073709551615u},
                            {"verdict", "disjoint"},
                            {"decided_by", "exact"},
                            {"lower", nullptr},
                            {"upper", nullptr},
                            {"iterations", 7}}));
  const json undecided = json::parse(row({Format::jsonl}, undecided_answer()));
  EXPECT_EQ(undecided.at("verdict"), "undecided");
  EXPECT_TRUE(undecided.at("decided_by").is_null()) << "nothing decided it";
  EXPECT_EQ(undecided.at("undecided_reason"), "rounding");
  EXPECT_EQ(undecided.at("lower"), -0x1p-52);
  EXPECT_TRUE(undecided.at("upper").is_null()) << "JSON has no infinity";
}

TEST(RowText, JsonHasTheCertificateToTheLastBit) {
  const RowLayout layout{Format::jsonl, true};
  const json disjoint = json::parse(row(layout, disjoint_answer()));
  EXPECT_EQ(disjoint.at("reproven"), true);
  EXPECT_EQ(disjoint.at("certificate"), (json{{"separating_direction", {0.1, -1.0 / 3.0, 1e-300}},
                                              {"separating_direction_low", {0x1p-60, 0.0, -0x1p-1074}}}));
  const json overlap = json::parse(row(layout, overlap_answer()));
  EXPECT_EQ(overlap.at("reproven"), false);
  EXPECT_EQ(overlap.at("not_reproven_reason"), "a \"fault\"");
  EXPECT_EQ(overlap.at("certificate"), (json{{"witnesses",
                                              {{{"direction", {1.0, 2.0, 3.0}},
                                                {"direction_low", {4.0, 5.0, 6.0}},
                                                {"direction_b", {10.0, 11.0, 12.0}},
                                                {"direction_b_low", {13.0, 14.0, 15.0}},
                                                {"point_a", {7.0, 8.0, 9.0}},
                                                {"point_b", {0.1, 0.2, 0.3}}},
                                               {{"direction", {-1.0, -2.0, -3.0}},
                                                {"direction_low", {-4.0, -5.0, -6.0}},
                                                {"direction_b", {-10.0, -11.0, -12.0}},
                                                {"direction_b_low", {-13.0, -14.0, -15.0}},
                                                {"point_a", {-7.0, -8.0, -9.0}},
                                                {"point_b", {-0.1, -0.2, -0.3}}}}}}));
  const json undecided = json::parse(row(layout, undecided_answer()));
  EXPECT_TRUE(undecided.at("certificate").is_null());
  EXPECT_TRUE(undecided.at("reproven").is_null());
  Answer by_witnesses = disjoint_answer();
  by_witnesses.certificate.n_witnesses = 1;
  EXPECT_EQ(json::parse(row(layout, by_witnesses)).at("certificate").at("witnesses").size(), 1u)
      << "of disjoint bodies they are the proof where the direction is zero";
}

TEST(RowText, CsvHasAsManyCellsAsItsHeader) {
  for (const bool with_certificate : {false, true}) {
    for (const bool with_error : {false, true}) {
      const RowLayout layout{Format::csv, with_certificate, with_error};
      const std::size_t expected = n_cells(row_header(layout));
      EXPECT_EQ(expected, 7u + (with_certificate ? 6u + 6 * 18 + 1 : 0u) + (with_error ? 1u : 0u));
      for (const Answer& answer : {disjoint_answer(), overlap_answer(), undecided_answer()}) {
        EXPECT_EQ(n_cells(row(layout, answer)), expected) << row(layout, answer);
      }
      if (!with_error) continue;
      std::string refused;
      append_refused_row(refused, layout, 5, "bad");
      EXPECT_EQ(n_cells(refused), expected) << refused;
    }
  }
  EXPECT_EQ(row({Format::csv}, disjoint_answer()), "3,disjoint,exact,,,,7\n");
  EXPECT_EQ(row({Format::csv}, undecided_answer()), "3,undecided,,rounding,-2.220446049250313e-16,,0\n");
}

TEST(RowText, ARefusedRowSaysWhy) {
  const std::string problem = "line 5: not a number (\"x\x1b\" for tx) - write it";
  std::string text;
  append_refused_row(text, {Format::jsonl}, 3, problem);
  EXPECT_EQ(json::parse(text), (json{{"index", 3}, {"error", "line 5: not a number (\"x\\x1b\" for tx) - write it"}}));
  text.clear();
  append_refused_row(text, {Format::jsonl}, 3, "\xFF");
  EXPECT_TRUE(json::accept(text)) << "bytes that are no UTF-8";
  text.clear();
  append_refused_row(text, {Format::csv, false, true}, 3, problem);
  EXPECT_EQ(text, "3,,,,,,,\"line 5: not a number (\"\"x\\x1b\"\" for tx) - write it\"\n");
  text.clear();
  append_refused_row(text, {Format::screen}, 3, problem);
  EXPECT_EQ(text, "3 error line 5: not a number (\"x\\x1b\" for tx) - write it\n");
}

TEST(RowText, TheScreenHasOneLineAPose) {
  EXPECT_EQ(row({Format::screen}, disjoint_answer()), "3 disjoint exact\n");
  EXPECT_EQ(row({Format::screen}, undecided_answer()), "3 undecided rounding\n");
  EXPECT_EQ(row({Format::screen, true}, overlap_answer()), "3 overlap double_double not_reproven\n");
  EXPECT_EQ(row_header({Format::screen}), "");
}

// Bytes that are not UTF-8, of others' files, become the same in every form.
TEST(RowText, ARefusedRowIsUtf8) {
  const std::string bad = "\xff \xc3\xa9 \xe2\x82 \xed\xa0\x80 \xc0\xaf \xf0\x9f\x98\x80 \xf4\x90\x80\x80";
  const std::string r = "\xef\xbf\xbd";
  const std::string expected =
      r + " \xc3\xa9 " + r + r + " " + r + r + r + " " + r + r + " \xf0\x9f\x98\x80 " + r + r + r + r;
  const auto refused = [&](Format format) {
    std::string text;
    append_refused_row(text, {format, false, true, Query::overlap}, 0, bad);
    return text;
  };
  EXPECT_EQ(json::parse(refused(Format::jsonl)).at("error"), expected);
  EXPECT_EQ(refused(Format::csv), "0,,,,,,,\"" + expected + "\"\n");
  EXPECT_EQ(refused(Format::screen), "0 error " + expected + "\n");
}

}  // namespace
}  // namespace vex
