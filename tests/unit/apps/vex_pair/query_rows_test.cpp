// Rows of every query: the keys of the contract, null for what is not there, and CSV that says what JSON says.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "apps/vex_pair/row_text.h"

namespace vex {
namespace {

using Format = RowLayout::Format;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string row(Format format, Query query, const Answer& answer) {
  std::string text;
  append_row(text, {format, false, false, query}, 3, answer);
  return text;
}

json json_row(Query query, const Answer& answer) { return json::parse(row(Format::jsonl, query, answer)); }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(0, line.size() - 1));
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (line[line.size() - 2] == ',') cells.emplace_back();
  return cells;
}

Answer with_points(Verdict verdict) {
  Answer answer;
  answer.verdict = verdict;
  answer.n_support_calls = 7;
  answer.value = 0.1;
  answer.lower = 0.09999999999999999;
  answer.upper = 0.10000000000000002;
  answer.normal = Vec3d{1.0, 0.0, 0.0};
  answer.point_a = Vec3d{1.0 / 3.0, 2.0, 3.0};
  answer.point_b = Vec3d{4.0, 1e-300, 6.0};
  return answer;
}

Answer apart() {
  Answer answer = with_points(Verdict::disjoint(DecidedBy::gjk));
  answer.signed_distance = 0.1;
  return answer;
}

Answer deep() {
  Answer answer = with_points(Verdict::overlap(DecidedBy::gjk));
  answer.signed_distance = -0.1;
  answer.contacts = {{{1, 2, 3}, {4, 5, 6}, -0.1, feature_of_vertex(3), feature_of_face(1)},
                     {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, -0.05, 9, 11}};
  return answer;
}

Answer missed() {
  Answer answer;
  answer.verdict = Verdict::disjoint(DecidedBy::outer_bound);
  answer.lower = answer.upper = kInfinity;
  return answer;
}

Answer grazed() {
  Answer answer;
  answer.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
  answer.lower = 2.5;
  answer.upper = kInfinity;
  return answer;
}

Answer hit(Answer::RayHit body) {
  Answer answer = with_points(Verdict::overlap(DecidedBy::exact));
  answer.ray_hit = body;
  (body == Answer::RayHit::a ? answer.point_b : answer.point_a).reset();
  return answer;
}

TEST(QueryRows, KeysOfDistanceAndDepth) {
  EXPECT_EQ(json_row(Query::distance, apart()), (json{{"index", 3},
                                                      {"verdict", "disjoint"},
                                                      {"decided_by", "gjk"},
                                                      {"distance", 0.1},
                                                      {"lower", 0.09999999999999999},
                                                      {"upper", 0.10000000000000002},
                                                      {"normal", {1.0, 0.0, 0.0}},
                                                      {"point_a", {1.0 / 3.0, 2.0, 3.0}},
                                                      {"point_b", {4.0, 1e-300, 6.0}},
                                                      {"iterations", 7}}));
  const json depth = json_row(Query::depth, deep());
  EXPECT_EQ(depth.at("depth"), 0.1);
  EXPECT_FALSE(depth.contains("distance"));
  EXPECT_FALSE(depth.contains("signed_distance"));
}

TEST(QueryRows, SignedIsDistanceOrDepthAsTheCaseIs) {
  for (const Query query : {Query::signed_distance, Query::manifold}) {
    const json distance = json_row(query, apart()), depth = json_row(query, deep());
    EXPECT_EQ(distance.at("distance"), 0.1);
    EXPECT_EQ(distance.at("signed_distance"), 0.1);
    EXPECT_FALSE(distance.contains("depth"));
    EXPECT_EQ(depth.at("depth"), 0.1);
    EXPECT_EQ(depth.at("signed_distance"), -0.1);
    EXPECT_FALSE(depth.contains("distance"));
  }
  Answer touching = grazed();
  touching.value = -1e-17;
  touching.signed_distance = -1e-17;
  const json undecided = json_row(Query::signed_distance, touching);
  EXPECT_EQ(undecided.at("undecided_reason"), "rounding");
  EXPECT_TRUE(undecided.at("decided_by").is_null());
  EXPECT_EQ(undecided.at("distance"), -1e-17) << "neither distance nor depth is proven";
}

TEST(QueryRows, KeysOfWhatMoves) {
  const json ray = json_row(Query::ray, hit(Answer::RayHit::b));
  EXPECT_EQ(ray.at("hit"), "b");
  EXPECT_EQ(ray.at("parameter"), 0.1);
  EXPECT_TRUE(ray.at("point_a").is_null());
  EXPECT_EQ(ray.at("point_b"), (json{4.0, 1e-300, 6.0}));
  EXPECT_EQ(json_row(Query::ray, hit(Answer::RayHit::a)).at("hit"), "a");
  EXPECT_EQ(json_row(Query::ray, hit(Answer::RayHit::either)).at("hit"), "either");
  EXPECT_TRUE(json_row(Query::ray, missed()).at("hit").is_null());
  EXPECT_EQ(json_row(Query::cast, hit(Answer::RayHit::nothing)).at("parameter"), 0.1);
  EXPECT_FALSE(json_row(Query::cast, missed()).contains("hit"));
  const json time = json_row(Query::time_of_impact, with_points(Verdict::overlap(DecidedBy::gjk)));
  EXPECT_EQ(time.at("time"), 0.1);
  EXPECT_FALSE(time.contains("parameter"));
  for (const char* key : {"time", "lower", "upper", "normal", "point_a", "point_b"}) {
    EXPECT_TRUE(json_row(Query::time_of_impact, missed()).at(key).is_null()) << "JSON has no infinity: " << key;
  }
  EXPECT_EQ(json_row(Query::cast, grazed()).at("lower"), 2.5);
  EXPECT_TRUE(json_row(Query::cast, grazed()).at("upper").is_null());
  EXPECT_TRUE(json_row(Query::cast, grazed()).at("parameter").is_null());
}

TEST(QueryRows, AManifoldListsItsContacts) {
  EXPECT_EQ(json_row(Query::manifold, apart()).at("contacts"), json::array());
  EXPECT_EQ(json_row(Query::manifold, deep()).at("contacts"), (json{{{"point_a", {1.0, 2.0, 3.0}},
                                                                     {"point_b", {4.0, 5.0, 6.0}},
                                                                     {"distance", -0.1},
                                                                     {"signed_distance", -0.1},
                                                                     {"feature_a", 3},
                                                                     {"feature_b", (std::uint64_t{2} << 50) + 1}},
                                                                    {{"point_a", {0.1, 0.2, 0.3}},
                                                                     {"point_b", {0.4, 0.5, 0.6}},
                                                                     {"distance", -0.05},
                                                                     {"signed_distance", -0.05},
                                                                     {"feature_a", 9},
                                                                     {"feature_b", 11}}}));
  const std::string csv = row(Format::csv, Query::manifold, deep());
  EXPECT_NE(csv.find(",2,1 2 3 4 5 6 -0.1 3 2251799813685249;0.1 0.2 0.3 0.4 0.5 0.6 -0.05 9 11,7\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(row(Format::csv, Query::manifold, apart()).find(",0,,7\n"), std::string::npos);
}

// A cell is what JSON has under the column's name; a vector is three of them.
TEST(QueryRows, CsvSaysWhatJsonSays) {
  std::size_t n_numbers = 0, n_empty = 0;
  for (const Query query : kQueries) {
    const std::vector<std::string> columns = cells_of(row_header({Format::csv, false, false, query}));
    for (const Answer& answer : {apart(), deep(), missed(), grazed(), hit(Answer::RayHit::a), hit(Answer::RayHit::b)}) {
      const json expected = json_row(query, answer).flatten();
      const std::vector<std::string> cells = cells_of(row(Format::csv, query, answer));
      ASSERT_EQ(cells.size(), columns.size()) << row(Format::csv, query, answer);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        SCOPED_TRACE(std::string(name_of(query)) + ", " + columns[k]);
        std::string key = "/" + columns[k];
        const std::size_t end = key.size();
        if (end > 2 && key[end - 2] == '_' && key.back() >= 'x') {
          key = key.substr(0, end - 2) + "/" + std::to_string(key.back() - 'x');
        }
        if (key.find("contacts") != std::string::npos) continue;
        const json value = expected.contains(key) ? expected.at(key) : json();
        if (value.is_null()) ++n_empty;
        if (value.is_number()) ++n_numbers;
        EXPECT_EQ(cells[k], value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
        if (value.is_number_float()) {
          EXPECT_EQ(std::stod(cells[k]), value.get<double>());
        }
      }
    }
  }
  EXPECT_GT(n_numbers, 100u) << "the keys are not those of the columns";
  EXPECT_GT(n_empty, 50u);
}

TEST(QueryRows, ARefusedRowHasAsManyCellsAsItsHeader) {
  for (const Query query : kQueries) {
    const RowLayout layout{Format::csv, false, true, query};
    std::string refused;
    append_refused_row(refused, layout, 5, "bad");
    EXPECT_EQ(cells_of(refused).size(), cells_of(row_header(layout)).size()) << name_of(query);
    EXPECT_EQ(refused.substr(refused.size() - 7), ",\"bad\"\n");
  }
}

TEST(QueryRows, TheScreenNamesTheValue) {
  EXPECT_EQ(row(Format::screen, Query::distance, apart()), "3 disjoint gjk distance 0.1\n");
  EXPECT_EQ(row(Format::screen, Query::signed_distance, deep()), "3 overlap gjk depth 0.1\n");
  EXPECT_EQ(row(Format::screen, Query::manifold, deep()), "3 overlap gjk depth 0.1 contacts 2\n");
  EXPECT_EQ(row(Format::screen, Query::ray, hit(Answer::RayHit::b)), "3 overlap exact parameter 0.1 hit b\n");
  EXPECT_EQ(row(Format::screen, Query::ray, hit(Answer::RayHit::either)), "3 overlap exact parameter 0.1 hit either\n");
  EXPECT_EQ(row(Format::screen, Query::ray, missed()), "3 disjoint outer_bound\n");
  EXPECT_EQ(row(Format::screen, Query::time_of_impact, grazed()), "3 undecided rounding\n");
}

TEST(QueryRows, TheRangeOfValuesDoesNotDependOnTheOrder) {
  Counts forth, back, all;
  forth.add(apart());
  forth.add(missed());
  back.add(deep());
  all.add(forth);
  all.add(back);
  EXPECT_EQ(all.smallest, -0.1);
  EXPECT_EQ(all.largest, 0.1);
  EXPECT_EQ(all.n_rows, 3u);
  EXPECT_EQ(all.n_disjoint, 2u);
  Counts none;
  none.add(missed());
  EXPECT_GT(none.smallest, none.largest) << "no value is none";
}

}  // namespace
}  // namespace vex
