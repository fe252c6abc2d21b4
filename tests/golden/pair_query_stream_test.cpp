// vex_pair: every query of a file of poses: its forms agree, on any number of threads, and bad rows are told by line.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "tests/golden/pair.h"

namespace vex::golden {
namespace {

using nlohmann::json;

// The words of every query, its own option included.
const std::vector<Words> kAllQueries = {{"--query", "overlap"},
                                        {"--query", "overlap", "--margin", "0.1"},
                                        {"--query", "distance"},
                                        {"--query", "depth"},
                                        {"--query", "signed"},
                                        {"--query", "ray", "--ray", "-3,0.1,0.2,1,0,0.05"},
                                        {"--query", "cast", "--cast", "1,0.5,-0.25"},
                                        {"--query", "toi", "--toi", "1,0.5,-0.25,10,20,90"},
                                        {"--query", "manifold", "--margin", "0.1"}};

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Of a line without quotation marks.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) c == ',' ? cells.emplace_back() : (cells.back() += c, cells.back());
  return cells;
}

// The cells of a row by the names of the columns.
std::map<std::string, std::string> by_name(const std::string& header, const std::string& line) {
  const std::vector<std::string> names = cells_of(header), cells = cells_of(line);
  EXPECT_EQ(names.size(), cells.size()) << line;
  std::map<std::string, std::string> named;
  for (std::size_t k = 0; k < std::min(names.size(), cells.size()); ++k) named[names[k]] = cells[k];
  return named;
}

TEST_F(PairQuery, AllFormsSayTheSame) {
  write_file("poses.csv", quaternion_file(random_poses(60)));
  for (const Words& query : kAllQueries) {
    SCOPED_TRACE(testing::PrintToString(query));
    const Words words = query + Words{"--poses", "poses.csv"};
    const Finished lines = cubes(words + Words{"--jsonl", "--json", "result.json"});
    ASSERT_EQ(lines.exit_code, 0) << lines.err;
    EXPECT_EQ(lines.err.rfind("vex_pair: 60 poses: ", 0), 0u) << lines.err;
    const std::vector<json> rows = objects_of(lines.out);
    ASSERT_EQ(rows.size(), 60u);
    EXPECT_EQ(json::parse(read_file("result.json")).at("results"), json(rows));
    const std::vector<std::string> csv = lines_of(cubes(words + Words{"--csv", "--quiet"}).out);
    const std::vector<std::string> screen = lines_of(cubes(words).out);
    ASSERT_EQ(csv.size(), 61u);
    ASSERT_EQ(screen.size(), 60u);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      std::map<std::string, std::string> cells = by_name(csv[0], csv[k + 1]);
      const std::string verdict = rows[k].at("verdict");
      EXPECT_EQ(screen[k].rfind(std::to_string(k) + " " + verdict + " ", 0), 0u) << screen[k];
      std::size_t n_compared = 0;
      for (const auto& [key, value] : rows[k].items()) {
        SCOPED_TRACE(key);
        if (key == "contacts") {
          EXPECT_EQ(cells.at("n_contacts"), std::to_string(value.size()));
        } else if (value.is_array()) {
          for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(std::strtod(cells.at(key + "_" + "xyz"[i]).c_str(), nullptr), value.at(i).get<double>());
          }
        } else if (value.is_number()) {
          EXPECT_EQ(std::strtod(cells.at(key).c_str(), nullptr), value.get<double>());
        } else if (value.is_string()) {
          EXPECT_EQ(cells.at(key), value.get<std::string>());
        } else if (cells.contains(key)) {
          EXPECT_EQ(cells.at(key), "") << "null";
        }
        ++n_compared;
      }
      EXPECT_GE(n_compared, 6u);
    }
  }
}

TEST_F(PairQuery, TheQueriesAgree) {
  write_file("poses.csv", quaternion_file(random_poses(500)));
  const auto rows = [this](const Words& query) {
    const Finished finished = cubes(query + Words{"--poses", "poses.csv", "--jsonl", "--quiet"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return objects_of(finished.out);
  };
  const auto overlaps = rows({}), distances = rows({"--query", "distance"}), depths = rows({"--query", "depth"}),
             both = rows({"--query", "signed"}), near = rows({"--margin", "0.1"});
  ASSERT_EQ(overlaps.size(), 500u);
  std::size_t n_apart = 0, n_near = 0;
  for (std::size_t k = 0; k < overlaps.size(); ++k) {
    const json &distance = distances[k], &depth = depths[k];
    SCOPED_TRACE(both[k].dump());
    for (const json* row : {&distance, &depth, &both[k]}) EXPECT_EQ(row->at("verdict"), overlaps[k].at("verdict"));
    const bool is_apart = overlaps[k].at("verdict") == "disjoint";
    EXPECT_EQ(distance.at("distance") > 0.0, is_apart);
    EXPECT_EQ(depth.at("depth") > 0.0, !is_apart);
    const json& one = is_apart ? distance : depth;
    const char* const key = is_apart ? "distance" : "depth";
    EXPECT_NEAR(both[k].at(key).get<double>(), one.at(key).get<double>(), 1e-11);
    for (const json* row : {&one, &both[k]}) {
      EXPECT_LE(row->at("lower").get<double>(), row->at(key).get<double>());
      EXPECT_GE(row->at("upper").get<double>(), row->at(key).get<double>());
    }
    if (is_apart) ++n_apart;
    if (std::fabs(distance.at("distance").get<double>() - 0.1) < 1e-9) continue;
    EXPECT_EQ(near[k].at("verdict") == "overlap", distance.at("distance") < 0.1);
    if (is_apart && near[k].at("verdict") == "overlap") ++n_near;
  }
  EXPECT_GT(n_apart, 100u) << "the sample is one-sided";
  EXPECT_LT(n_apart, 400u);
  EXPECT_GT(n_near, 5u) << "the margin tells nothing apart";
}

TEST_F(PairQuery, TheBytesDoNotDependOnThreads) {
  write_file("poses.csv", quaternion_file(random_poses(1500)) + "bad\n" + "0,0,0,1,0,0,0\n");
  for (const Words& query : kAllQueries) {
    SCOPED_TRACE(testing::PrintToString(query));
    const auto with_threads = [&](const char* n) {
      return cubes(query + Words{"--poses", "poses.csv", "--jsonl", "--keep-going", "--quiet", "--threads", n});
    };
    const Finished one = with_threads("1");
    EXPECT_EQ(one.exit_code, 3);
    EXPECT_EQ(lines_of(one.out).size(), 1502u);
    for (const char* n : {"2", "7"}) EXPECT_EQ(with_threads(n).out, one.out) << n;
  }
}

TEST_F(PairQuery, BadRowsAreToldByTheirLine) {
  write_file("poses.csv", kQuaternionHeader + "3,0,0,1,0,0,0\n0,0,0,0,0,0,0\n3,0,0,1,0,0,0\n");
  for (const Words& query : kAllQueries) {
    SCOPED_TRACE(testing::PrintToString(query));
    const Words words = query + Words{"--poses", "poses.csv"};
    const Finished stopped = cubes(words + Words{"--jsonl"});
    EXPECT_EQ(stopped.exit_code, 3);
    EXPECT_EQ(objects_of(stopped.out).size(), 1u);
    EXPECT_NE(stopped.err.find("poses.csv, line 3, index 1: a quaternion of length 0"), std::string::npos)
        << stopped.err;
    const Finished going = cubes(words + Words{"--jsonl", "--keep-going"});
    EXPECT_EQ(going.exit_code, 3);
    const std::vector<json> rows = objects_of(going.out);
    ASSERT_EQ(rows.size(), 3u) << going.out;
    EXPECT_EQ(rows[1].at("error").get<std::string>().rfind("line 3: ", 0), 0u);
    json first = rows[0], last = rows[2];
    EXPECT_EQ(last.at("index"), 2);
    first.erase("index");
    last.erase("index");
    EXPECT_EQ(first, last) << "the same pose";
    const std::vector<std::string> csv = lines_of(cubes(words + Words{"--csv", "--keep-going"}).out);
    ASSERT_EQ(csv.size(), 4u);
    EXPECT_EQ(cells_of(csv[1]).size(), cells_of(csv[0]).size());
    EXPECT_NE(csv[2].find(",,\"line 3: a quaternion"), std::string::npos) << csv[2];
  }
}

TEST_F(PairQuery, TheSummaryIsOfItsQuery) {
  write_file("poses.csv", kQuaternionHeader + "1.5,0,0,1,0,0,0\n3,0,0,1,0,0,0\n0.75,0,0,1,0,0,0\n");
  const auto summary = [this](const Words& query) { return cubes(query + Words{"--poses", "poses.csv"}).err; };
  const auto expect_parts = [](const std::string& text, const std::string& begin, const std::string& part) {
    EXPECT_EQ(text.rfind("vex_pair: 3 poses: " + begin, 0), 0u) << text;
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_parts(summary({"--query", "distance"}), "2 disjoint, 1 overlap, 0 undecided; ", "; distance 0 to 2; ");
  expect_parts(summary({"--query", "signed"}), "2 disjoint, 1 overlap, 0 undecided; ",
               "; signed distance -0.25 to 2; ");
  expect_parts(summary({"--query", "ray", "--ray", "-1,5,0,1,0,0"}), "3 missed, 0 hit, 0 undecided; ", "; decided by ");
  expect_parts(summary({"--query", "cast", "--cast", "-1,0,0"}), "0 never meet, 3 meet, 0 undecided; ",
               "; parameter 0 to 2; ");
}

}  // namespace
}  // namespace vex::golden
