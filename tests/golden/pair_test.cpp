// vex_pair: one pose and files of them, its three kinds of rows, its document, its certificates.
#include "tests/golden/pair.h"

#include <algorithm>
#include <map>
#include <set>

#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

TEST_F(Pair, OnePoseIsAnsweredInWords) {
  const Finished overlapping = run({"box:1,1,1", "sphere:0.5", "--translation", "0.9,0,0"});
  EXPECT_EQ(overlapping.exit_code, 0) << overlapping.err;
  EXPECT_EQ(overlapping.err, "");
  for (const char* part : {"A box:1,1,1 and B sphere:0.5 OVERLAP", "proven by", "support calls"}) {
    EXPECT_NE(overlapping.out.find(part), std::string::npos) << overlapping.out;
  }
  const Finished apart = run({"box:1,1,1", "sphere:0.5", "--translation", "1.1,0,0"});
  EXPECT_EQ(apart.exit_code, 0) << apart.err;
  EXPECT_NE(apart.out.find("are DISJOINT"), std::string::npos) << apart.out;
  const Finished certified = run({"box:1,1,1", "sphere:0.5", "--translation", "1.1,0,0", "--certificate"});
  EXPECT_NE(certified.out.find("separating direction"), std::string::npos) << certified.out;
  EXPECT_NE(certified.out.find("proven again from these"), std::string::npos) << certified.out;
  const Finished quiet = cubes({"--translation", "0.5,0,0", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Pair, TheWaysToGiveAPoseAgree) {
  const auto row = [this](Words words) {
    words.push_back("--jsonl");
    const Finished finished = cubes(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished.out;
  };
  // A quarter turn about z would leave the cubes apart at this distance along x; an eighth makes them meet.
  const std::string eighth = "0.92387953251128674,0,0,0.38268343236508977";
  const std::string expected = row({"--rotation", eighth, "--translation", "1.15,0,0"});
  EXPECT_EQ(json::parse(expected).at("verdict"), "overlap");
  EXPECT_EQ(row({"--rotation", "9.2387953251128674e150,0,0,3.8268343236508977e150", "--translation", "1.15,0,0"}),
            expected);
  EXPECT_EQ(row({"--rotation=-0.92387953251128674,0,0,-0.38268343236508977", "--translation=1.15,0,0"}), expected);
  const std::string eighth_matrix =
      "0.70710678118654757,-0.70710678118654757,0,0.70710678118654757,"
      "0.70710678118654757,0,0,0,1,0x1.2666666666666p0,0,0";
  EXPECT_EQ(json::parse(row({"--matrix", eighth_matrix})).at("verdict"), "overlap") << "another last digit, perhaps";
  EXPECT_EQ(json::parse(row({"--translation", "1.15,0,0"})).at("verdict"), "disjoint");
  EXPECT_EQ(json::parse(row({"--rotation", eighth})).at("verdict"), "overlap");
  EXPECT_EQ(row({"--translation", "-1.15,0,0", "--rotation", "0,1,0,0"}),
            row({"--matrix", "1,0,0,0,-1,0,0,0,-1,-1.15,0,0"}));
}

TEST_F(Pair, BothFormatsOfFilesGiveTheSameAnswers) {
  const auto poses = random_poses(5000);
  write_file("q.csv", quaternion_file(poses));
  write_file("m.csv", matrix_file(poses));
  for (const char* format : {"--jsonl", "--csv"}) {
    const Finished quaternions = cubes({"--poses", "q.csv", format, "--certificate", "--quiet"});
    EXPECT_EQ(quaternions.exit_code, 0) << quaternions.err;
    EXPECT_EQ(quaternions.err, "");
    EXPECT_EQ(quaternions.out, cubes({"--poses", "m.csv", format, "--certificate", "--quiet"}).out);
  }
  std::map<std::string, std::uint64_t> verdicts;
  std::uint64_t index = 0;
  for (const json& row : objects_of(cubes({"--poses", "q.csv", "--jsonl"}).out)) {
    EXPECT_EQ(row.at("index"), index++);
    ++verdicts[row.at("verdict")];
  }
  EXPECT_EQ(index, 5000u);
  EXPECT_GT(verdicts["overlap"], 1500u) << "the sample is one-sided";
  EXPECT_GT(verdicts["disjoint"], 1500u);
  EXPECT_EQ(verdicts["undecided"], 0u) << "random cubes";
}

TEST_F(Pair, TheBytesDoNotDependOnThreads) {
  write_file("poses.csv", quaternion_file(random_poses(20000)) + "bad\n" + "0,0,0,1,0,0,0\n");
  for (const char* format : {"--jsonl", "--csv"}) {
    const Words words = {"--poses", "poses.csv", format, "--keep-going", "--quiet", "--threads"};
    const auto with_threads = [&](const char* n) {
      Words all = words;
      all.emplace_back(n);
      return cubes(all);
    };
    const Finished one = with_threads("1");
    EXPECT_EQ(lines_of(one.out).size(), std::string(format) == "--csv" ? 20003u : 20002u);
    for (const char* n : {"2", "7"}) {
      EXPECT_EQ(with_threads(n).out, one.out) << n;
    }
  }
  const Finished stopped = cubes({"--poses", "poses.csv", "--threads", "5"});
  EXPECT_EQ(lines_of(stopped.out).size(), 20000u);
  EXPECT_EQ(stopped.exit_code, 3);
}

TEST_F(Pair, ARowAPoseAndASummary) {
  write_file("poses.csv", kQuaternionHeader + "0.5,0,0,1,0,0,0\n3,0,0,1,0,0,0\n");
  const Finished finished = cubes({"--poses", "poses.csv"});
  EXPECT_EQ(finished.exit_code, 0);
  const std::vector<std::string> rows = lines_of(finished.out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].rfind("0 overlap ", 0), 0u) << rows[0];
  EXPECT_EQ(rows[1].rfind("1 disjoint ", 0), 0u) << rows[1];
  EXPECT_EQ(finished.err.rfind("vex_pair: 2 poses: 1 disjoint, 1 overlap, 0 undecided; decided by ", 0), 0u)
      << finished.err;
  const Finished quiet = cubes({"--poses", "poses.csv", "--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  const Finished csv = cubes({"--poses", "poses.csv", "--csv", "--quiet"});
  EXPECT_EQ(lines_of(csv.out).at(0), "index,verdict,decided_by,undecided_reason,lower,upper,iterations");
  EXPECT_EQ(lines_of(csv.out).at(1).rfind("0,overlap,", 0), 0u);
}

TEST_F(Pair, AFileWithoutRowsHasNoAnswers) {
  write_file("poses.csv", kQuaternionHeader);
  const Finished finished = cubes({"--poses", "poses.csv", "--jsonl", "--json", "result.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.out, "");
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("rows"), 0);
  EXPECT_EQ(document.at("results"), json::array());
}

TEST_F(Pair, TheDocument) {
  const json one = json::parse(cubes({"--translation", "0.5,0,0", "--json", "-", "--certificate"}).out);
  for (const char* key : {"version", "stream_version", "command", "seed", "threads", "complete", "seconds", "bodies",
                          "query", "pose", "rows", "verdicts", "decided_by", "results"}) {
    EXPECT_TRUE(one.contains(key)) << key;
  }
  EXPECT_EQ(one.at("query"), "overlap");
  EXPECT_EQ(one.at("complete"), true);
  EXPECT_EQ(one.at("pose"), (json{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0}));
  ASSERT_EQ(one.at("results").size(), 1u);
  EXPECT_EQ(one.at("results").at(0).at("verdict"), "overlap");
  EXPECT_TRUE(one.at("results").at(0).at("certificate").contains("witnesses"));
  EXPECT_TRUE(one.at("results").at(0).at("reproven").is_boolean());
  EXPECT_EQ(one.at("bodies").at(0).at("kind"), "box");

  const auto poses = random_poses(1001);
  write_file("many.csv", quaternion_file(poses));
  write_file("listed.csv", quaternion_file({poses.begin(), poses.end() - 1}));
  const Finished rows = cubes({"--poses", "listed.csv", "--jsonl", "--json", "listed.json"});
  const json listed = json::parse(read_file("listed.json"));
  EXPECT_EQ(listed.at("results"), json(objects_of(rows.out)));
  const json many = json::parse(cubes({"--poses", "many.csv", "--json", "-"}).out);
  EXPECT_TRUE(many.at("results").is_null()) << "more than a thousand are not listed";
  for (const json* document : {&listed, &many}) {
    std::uint64_t n = 0;
    for (const json& count : document->at("decided_by")) n += count.get<std::uint64_t>();
    EXPECT_EQ(n + document->at("verdicts").at("undecided").get<std::uint64_t>(), document->at("rows"));
    n = 0;
    for (const json& count : document->at("verdicts")) n += count.get<std::uint64_t>();
    EXPECT_EQ(n, document->at("rows"));
  }
  EXPECT_EQ(many.at("rows"), 1001);
}

TEST_F(Pair, ACertificateForEveryVerdict) {
  write_file("poses.csv", quaternion_file(random_poses(300)));
  const Finished finished = run({"cylinder:1,0.5", "icosahedron:1", "--poses", "poses.csv", "--jsonl", "--certificate",
                                 "--json", "result.json", "--quiet"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  std::set<std::string> verdicts;
  for (const json& row : objects_of(finished.out)) {
    verdicts.insert(row.at("verdict"));
    ASSERT_EQ(row.at("reproven"), true) << row.dump();
    EXPECT_EQ(row.at("certificate").contains("separating_direction"), row.at("verdict") == "disjoint");
    if (row.at("verdict") == "disjoint") {
      const auto dir = row.at("certificate").at("separating_direction").get<std::vector<double>>();
      EXPECT_TRUE(std::ranges::any_of(dir, [](double d) { return d != 0.0; })) << row.dump();
    } else {
      EXPECT_GE(row.at("certificate").at("witnesses").size(), 4u);
    }
  }
  EXPECT_EQ(verdicts, (std::set<std::string>{"disjoint", "overlap"}));
  const json certificates = json::parse(read_file("result.json")).at("certificates");
  EXPECT_EQ(certificates.at("reproven"), 300);
  EXPECT_EQ(certificates.at("not_reproven"), 0);
}

TEST_F(Pair, TouchingBodiesOverlapAndAreProvenTo) {
  for (const Words& words :
       {Words{"box:1,1,1", "box:1,1,1", "--translation", "1,0,0"},
        Words{"box:1,1,1", "sphere:0.5", "--translation", "1,0,0"},
        Words{"sphere:1", "sphere:1", "--translation", "2,0,0"}, Words{"needle:1", "needle:1", "--rotation", "1,0,1,0"},
        Words{"box:1e150,1e150,1e150", "needle:1e-150", "--translation", "0.5e150,0,0"}}) {
    Words all = words;
    all.insert(all.end(), {"--jsonl", "--certificate"});
    const json row = json::parse(run(all).out);
    EXPECT_EQ(row.at("verdict"), "overlap") << row.dump();
    EXPECT_EQ(row.at("decided_by"), "exact");
    EXPECT_EQ(row.at("reproven"), true);
  }
}

TEST_F(Pair, MeshesAreBodiesToo) {
  write_file("cube.obj", cube_obj());  // from the origin to (1, 1, 1)
  const auto verdict = [this](const Words& words) {
    Words all = words;
    all.push_back("--jsonl");
    const Finished finished = run(all);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return json::parse(finished.out).at("verdict").get<std::string>();
  };
  EXPECT_EQ(verdict({"cube.obj", "box:1,1,1", "--translation", "1.4,0.5,0.5"}), "overlap");
  EXPECT_EQ(verdict({"cube.obj", "box:1,1,1", "--translation", "1.6,0.5,0.5"}), "disjoint");
  EXPECT_EQ(verdict({"cube.obj", "cube.obj", "--translation", "-1.1,0,0"}), "disjoint");
  EXPECT_EQ(verdict({"cube.obj", "cube.obj", "--translation", "-1.1,0,0", "--scale", "1.2"}), "overlap");
  EXPECT_EQ(verdict({"rounded:0.2,cube.obj", "cube.obj", "--translation", "-1.1,0,0"}), "overlap");
  const Finished listed = run({"cube.obj", "sphere:1", "--translation", "9,0,0", "--dump-vertices"});
  EXPECT_NE(listed.out.find("vertices, exactly"), std::string::npos) << listed.out;
  write_file("two.obj", cube_obj() + "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 9 10 11\n");
  expect_refusal(run({"two.obj", "sphere:1", "--translation", "9,0,0"}), 3, "--hull", "vex_pair");
  EXPECT_EQ(verdict({"two.obj", "sphere:1", "--translation", "3,3,3", "--hull"}), "overlap");
  expect_refusal(run({"missing.obj", "sphere:1", "--translation", "9,0,0"}), 3, "missing.obj", "vex_pair");
}

}  // namespace
}  // namespace vex::golden
