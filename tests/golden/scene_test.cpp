// vex_scene: its rows, its document, its summary; images, periodic boxes, what is undecided, threads.
#include "tests/golden/scene.h"

#include <csignal>
#include <set>

#include "tests/golden/pair.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

// Bodies 0, 1, 2 touch or overlap in a row, 3 is alone.
std::string four_cubes() {
  return kSceneHeader + upright("box:1,1,1", 0, 0, 0) + upright("box:1,1,1", 0.75, 0, 0) +
         upright("box:1,1,1", 1.75, 0, 0) + upright("box:1,1,1", 5, 0.25, 0);
}

// A stage settles what it saw, or the next one that has work sees it.
void expect_consistent(const json& stages, std::uint64_t undecided) {
  std::uint64_t seen = 0, settled = 0;
  std::set<std::string> names;
  for (const json& stage : stages) {
    EXPECT_LE(stage.at("settled").get<std::uint64_t>(), stage.at("seen").get<std::uint64_t>());
    seen = std::max(seen, stage.at("seen").get<std::uint64_t>());
    settled += stage.at("settled").get<std::uint64_t>();
    names.insert(stage.at("name").get<std::string>());
  }
  EXPECT_EQ(settled + undecided, seen);
  for (const char* name : {"unmoved", "joined", "balls", "cylinders", "bounds", "packets", "exact"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

// A referee cut a file within its last number, which was one still: another scene.
TEST_F(SceneTest, ALastLineWithoutItsEndIsWarnedOf) {
  for (const std::string end : {"", "\n\n", " "}) EXPECT_EQ(run_on(four_cubes() + end, {"--quiet"}).err, "");
  std::string open = four_cubes();
  open.pop_back();
  const Finished finished = run_on(open, {"--quiet"});
  EXPECT_EQ(finished.out, rows_of(four_cubes(), {}));
  EXPECT_NE(finished.err.find("scene.csv, line 5: the last line has no end - "), std::string::npos) << finished.err;
}

TEST_F(SceneTest, PairsOfAFile) {
  const std::string expected = kPairHeader + "0,1,0,0,0\n1,2,0,0,0\n";
  EXPECT_EQ(rows_of(four_cubes(), {}), expected);
  EXPECT_EQ(rows_of(four_cubes(), {"--csv", "--query", "pairs"}), expected);
  EXPECT_EQ(rows_of(four_cubes(), {"--jsonl"}),
            "{\"a\":0,\"b\":1,\"image\":[0,0,0],\"verdict\":\"overlap\"}\n"
            "{\"a\":1,\"b\":2,\"image\":[0,0,0],\"verdict\":\"overlap\"}\n");
  const Finished finished = run_on(four_cubes(), {});
  EXPECT_EQ(finished.out, expected);
  for (const char* part : {"vex_scene: 4 bodies of 1 shape in open space\n",
                           "2 pairs overlap, neighbours a body: 1; 0 pairs are undecided", "stage", "settled"}) {
    EXPECT_NE(finished.err.find(part), std::string::npos) << finished.err;
  }
}

TEST_F(SceneTest, MatricesByteOrderMarksAndLineEnds) {
  const std::string expected = kPairHeader + "0,1,0,0,0\n";
  EXPECT_EQ(rows_of("\xEF\xBB\xBF"
                    "body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33\r\n"
                    "\"box:1,1,1\",0,0,0,1,0,0,0,1,0,0,0,1\r\n"
                    "sphere:1, 0x1.8p0 ,\"0\",0,0,-1,0,1,0,0,0,0,1\r\n\r\n\n",
                    {}),
            expected);
  EXPECT_EQ(run_on(kSceneHeader + "sphere:1,0,0,0,2,0,0,0\nsphere:1,1,0,0,0,0,0,-1e-30", {"--quiet"}).out, expected)
      << "quaternions of any length, and no end of line, which is warned of";
}

TEST_F(SceneTest, NamesAndMeshes) {
  write_file("cube, from 0.obj", cube_obj());
  const std::string scene = kSceneHeader + "cube,0,0,0,1,0,0,0\n\"cube, from 0.obj\",1.5,0,0,1,0,0,0\n" +
                            "\"cube, from 0.obj\",1.25,0.5,0.5,1,0,0,0\n";
  EXPECT_EQ(rows_of(scene, {"--body", "cube=cube, from 0.obj"}), kPairHeader + "1,2,0,0,0\n");
  EXPECT_EQ(rows_of(scene, {"--body", "cube=box:3,3,3", "--body", "other=sphere:1"}),
            kPairHeader + "0,1,0,0,0\n0,2,0,0,0\n1,2,0,0,0\n");
  EXPECT_EQ(rows_of(scene, {"--body", "cube=rounded:1,box:1,1,1", "--scale", "0.5"}), kPairHeader + "1,2,0,0,0\n");
}

TEST_F(SceneTest, AnEmptySceneIsFine) {
  for (const char* query : {"pairs", "within", "any", "clusters", "counts"}) {
    Words words = {"--query", query, "--json", "result.json", "--gltf", "scene.glb", "--svg", "stages.svg"};
    if (std::string(query) == "within") words.insert(words.end(), {"--distance", "1"});
    run_on(kSceneHeader, words);
    const json document = json::parse(read_file("result.json"));
    EXPECT_EQ(document.at("bodies"), 0);
    EXPECT_EQ(document.at("complete"), true);
    EXPECT_EQ(Glb(read_file("scene.glb")).document.at("scenes").size(), 1u);
  }
  EXPECT_EQ(rows_of(kSceneHeader, {"--query", "any"}), "verdict\ndisjoint\n");
  EXPECT_EQ(rows_of(kSceneHeader, {"--query", "clusters", "--box", "3,3,3"}), "body,cluster\n");
}

TEST_F(SceneTest, Distances) {
  EXPECT_EQ(rows_of(four_cubes(), {"--query", "within", "--distance", "3"}),
            "a,b,image_x,image_y,image_z,distance\n0,1,0,0,0,0\n0,2,0,0,0,0.75\n1,2,0,0,0,0\n2,3,0,0,0,2.25\n");
  EXPECT_EQ(rows_of(four_cubes(), {"--query", "within", "--distance", "0", "--jsonl"}),
            "{\"a\":0,\"b\":1,\"image\":[0,0,0],\"distance\":0,\"verdict\":\"within\"}\n"
            "{\"a\":1,\"b\":2,\"image\":[0,0,0],\"distance\":0,\"verdict\":\"within\"}\n");
}

TEST_F(SceneTest, WhetherAnyTwoOverlap) {
  EXPECT_EQ(rows_of(four_cubes(), {"--query", "any"}), "verdict\noverlap\n");
  const std::string apart = kSceneHeader + upright("sphere:1", 0, 0, 0) + upright("sphere:1", 2.5, 0, 0);
  EXPECT_EQ(rows_of(apart, {"--query", "any", "--jsonl"}), "{\"verdict\":\"disjoint\"}\n");
  const Finished finished = run_on(four_cubes(), {"--query", "any", "--json", "result.json"});
  EXPECT_NE(finished.err.find("two bodies OVERLAP: bodies "), std::string::npos) << finished.err;
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("verdict"), "overlap");
  EXPECT_TRUE(document.at("pair").at("a") == 0 || document.at("pair").at("a") == 1);
  EXPECT_TRUE(document.at("pairs").is_null()) << "it ends at the first";
}

TEST_F(SceneTest, CountsAreAReportAlone) {
  const Finished finished = run_on(four_cubes(), {"--query", "counts", "--json", "result.json"});
  EXPECT_NE(finished.out.find("2 pairs overlap"), std::string::npos) << finished.out;
  EXPECT_EQ(finished.err, "");
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("pairs"), 2);
  EXPECT_FALSE(document.contains("results"));
  EXPECT_EQ(rows_of(four_cubes(), {"--query", "counts"}), "");
}

TEST_F(SceneTest, ClustersAndWhichWrap) {
  EXPECT_EQ(rows_of(four_cubes(), {"--query", "clusters"}), "body,cluster\n0,0\n1,0\n2,0\n3,1\n");
  std::string chain = kSceneHeader + upright("sphere:0.5", 2, 2, 2);
  for (int k = 0; k < 6; ++k) chain += upright("sphere:0.5", k - 2.5, 0, 0.25);
  const Finished finished = run_on(chain, {"--query", "clusters", "--box", "6,6,6", "--json", "result.json"});
  EXPECT_NE(finished.err.find("2 clusters; the largest is cluster 1, of 6 bodies; 1 wraps around the box: cluster 1 "
                              "along x"),
            std::string::npos)
      << finished.err;
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("clusters"), 2);
  EXPECT_EQ(document.at("largest_cluster"), (json{{"cluster", 1}, {"bodies", 6}, {"wraps", {true, false, false}}}));
  EXPECT_EQ(document.at("wrapping"), 1);
  EXPECT_EQ(document.at("wrapping_clusters").size(), 1u);
  EXPECT_NE(run_on(chain, {"--query", "clusters", "--box", "7,6,6"}).err.find("none wraps"), std::string::npos);
}

TEST_F(SceneTest, ImagesAreFromWhereTheFilePutsBodies) {
  // One at the left face, one at the right one, once in the box and once three boxes farther and two lower.
  const auto scene = [](double x, double z) {
    return kSceneHeader + upright("box:1,1,1", -4.75, 0, 0) + upright("box:1,1,1", x, 0, z);
  };
  EXPECT_EQ(rows_of(scene(4.75, 0), {"--box", "10,10,10"}), kPairHeader + "0,1,-1,0,0\n");
  EXPECT_EQ(rows_of(scene(34.75, -20), {"--box", "10,10,10"}), kPairHeader + "0,1,-4,0,2\n");
  EXPECT_EQ(rows_of(scene(34.75, -20), {}), kPairHeader);
  // Tilted by a quarter: a box higher is 2.5 farther.
  EXPECT_EQ(rows_of(scene(4.75 + 2.5, 10), {"--box", "10,10,10,0,0.25,0"}), kPairHeader + "0,1,-1,0,-1\n");
  EXPECT_EQ(rows_of(scene(4.75, 10), {"--box", "10,10,10,0,0.25,0"}), kPairHeader);
}

TEST_F(SceneTest, ABodyThatMeetsItself) {
  const std::string scene = kSceneHeader + upright("box:2.5,0.5,0.5", 7, 0, 0);
  EXPECT_EQ(rows_of(scene, {"--box", "2,2,2"}), kPairHeader + "0,0,1,0,0\n");
  EXPECT_EQ(rows_of(scene, {"--box", "3,2,2"}), kPairHeader);
}

TEST_F(SceneTest, WhatIsUndecidedIsListedAndSaid) {
  // Ellipsoids that touch in a point, which no finite precision proves; and two that overlap.
  const std::string body = "ellipsoid:1,2,3";
  const std::string scene = kSceneHeader + upright(body, 0, 0, 0) + upright(body, 2, 0, 0) + upright(body, 2.5, 0, 0);
  EXPECT_EQ(rows_of(scene, {}), "a,b,image_x,image_y,image_z,verdict\n0,1,0,0,0,undecided\n1,2,0,0,0,overlap\n");
  EXPECT_EQ(rows_of(scene, {"--jsonl"}),
            "{\"a\":0,\"b\":1,\"image\":[0,0,0],\"verdict\":\"undecided\"}\n"
            "{\"a\":1,\"b\":2,\"image\":[0,0,0],\"verdict\":\"overlap\"}\n");
  const Finished finished = run_on(scene, {"--json", "result.json"});
  EXPECT_NE(finished.err.find("1 pair overlaps"), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("1 pair is UNDECIDED"), std::string::npos) << finished.err;
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("pairs"), 1);
  EXPECT_EQ(document.at("undecided"), 1);
  EXPECT_EQ(document.at("undecided_pairs"), (json{{{"a", 0}, {"b", 1}, {"image", {0, 0, 0}}}}));
  expect_consistent(document.at("stages"), 1);
  const std::string touching = kSceneHeader + upright(body, 0, 0, 0) + upright(body, 2, 0, 0);
  EXPECT_EQ(rows_of(touching, {"--query", "any"}), "verdict\nundecided\n");
  EXPECT_NE(run_on(touching, {"--query", "any"}).err.find("UNDECIDED"), std::string::npos);
  // Of `any` their number is known where no pair overlaps, and then all of it; not where the search ended before.
  std::string row = kSceneHeader;
  for (int k = 0; k < 5; ++k) row += upright(body, 2 * k, 0, 0);
  for (const char* n_threads : {"1", "2", "8"}) {
    const Words any = {"--query", "any", "--threads", n_threads, "--json", "result.json"};
    EXPECT_NE(run_on(row, any).err.find("and 3 other pairs"), std::string::npos);
    EXPECT_EQ(json::parse(read_file("result.json")).at("undecided"), 4);
    run_on(row + upright(body, 9, 0, 0), any);
    EXPECT_EQ(json::parse(read_file("result.json")).at("verdict"), "overlap");
    EXPECT_TRUE(json::parse(read_file("result.json")).at("undecided").is_null());
  }
  run_on(scene, {"--query", "clusters", "--json", "result.json"});
  EXPECT_EQ(json::parse(read_file("result.json")).at("undecided"), 1);
  EXPECT_EQ(json::parse(read_file("result.json")).at("clusters"), 2) << "joined is only what is proven";
}

// Of one kind of body each stage sees what the one before it in the list has left, but for pairs that others have
// joined by the time the bounds are done with them.
TEST_F(SceneTest, StagesStandInTheOrderInWhichPairsComeToThem) {
  for (const char* query : {"pairs", "clusters"}) {
    const json stages =
        json::parse(run({"--random", "2000,box:1,1,1,0.7", "--query", query, "--json", "-"}).out).at("stages");
    EXPECT_EQ(stages.at(1).at("name"), "balls");
    EXPECT_EQ(stages.at(2).at("name"), "joined");
    EXPECT_EQ(stages.at(2).at("seen") > 0, std::string(query) == "clusters");
    std::int64_t left = -1, joined_later = 0, all_settled = 0;
    for (const json& stage : stages) {
      const std::int64_t seen = stage.at("seen"), settled = stage.at("settled");
      if (seen == 0) continue;
      all_settled += settled;
      const bool may_join =
          std::string(query) == "clusters" && (stage.at("name") == "bounds" || stage.at("name") == "packets");
      if (left != -1 && may_join) {
        joined_later += std::abs(left - seen);
      } else {
        EXPECT_TRUE(left == -1 || seen == left) << stage;
      }
      left = seen - settled;
    }
    EXPECT_EQ(left, 0);
    EXPECT_EQ(all_settled, stages.at(1).at("seen"));
    EXPECT_EQ(joined_later > 0, std::string(query) == "clusters");
  }
}

TEST_F(SceneTest, TheDocument) {
  const Finished finished = run_on(four_cubes(), {"--json", "-"});
  EXPECT_EQ(finished.err, "");
  const json document = json::parse(finished.out);
  for (const char* key : {"version", "stream_version", "command", "seed", "threads", "complete", "seconds", "bodies",
                          "box", "query", "pairs", "clusters", "undecided", "stages", "shapes", "results"}) {
    EXPECT_TRUE(document.contains(key)) << key;
  }
  EXPECT_EQ(document.at("complete"), true);
  EXPECT_EQ(document.at("bodies"), 4);
  EXPECT_EQ(document.at("pairs"), 2);
  EXPECT_EQ(document.at("undecided"), 0);
  EXPECT_TRUE(document.at("clusters").is_null());
  EXPECT_TRUE(document.at("box").is_null());
  EXPECT_EQ(document.at("shapes").at(0).at("kind"), "box");
  EXPECT_EQ(document.at("shapes").at(0).at("copies"), 4);
  expect_consistent(document.at("stages"), 0);
  EXPECT_EQ(document.at("results"), json(objects_of(rows_of(four_cubes(), {"--jsonl"}))));
  const json boxed = json::parse(run_on(four_cubes(), {"--json", "-", "--box", "9,9,9,0.5,0,0"}).out);
  EXPECT_EQ(boxed.at("box"), (json{9.0, 9.0, 9.0, 0.5, 0.0, 0.0}));
  const json many = json::parse(run({"--random", "2000,box:1,1,1,0.5", "--json", "-"}).out);
  EXPECT_TRUE(many.at("results").is_null()) << "more than a thousand are not listed";
  EXPECT_GT(many.at("pairs"), 1000);
  expect_consistent(many.at("stages"), 0);
}

TEST_F(SceneTest, TheBytesDoNotDependOnThreadsNorOnTheWay) {
  const Words scene = {"--random", "3000,rounded:0.1,box:1,1.5,0.5,0.3", "--quiet"};
  for (const Words& query : {Words{"--query", "pairs"}, Words{"--query", "within", "--distance", "0.2"},
                             Words{"--query", "clusters"}, Words{"--query", "any"}}) {
    const auto with = [&](const Words& more) {
      Words words = scene;
      words.insert(words.end(), query.begin(), query.end());
      words.insert(words.end(), more.begin(), more.end());
      const Finished finished = run(words);
      EXPECT_EQ(finished.exit_code, 0) << finished.err;
      return finished.out;
    };
    const std::string one = with({"--threads", "1"});
    for (const char* n : {"2", "8"}) EXPECT_EQ(with({"--threads", n}), one) << query.at(1) << " on " << n;
    EXPECT_EQ(with({"--broad-phase", "grid", "--isa", "scalar"}), one) << query.at(1);
    EXPECT_EQ(with({"--broad-phase", "tree"}), one) << query.at(1);
  }
}

TEST_F(SceneTest, StandardInput) {
  write_file("scene.csv", four_cubes());
  const Finished finished = shell("cat scene.csv | \"$VEX\" - --quiet");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.out, kPairHeader + "0,1,0,0,0\n1,2,0,0,0\n");
  EXPECT_EQ(shell("\"$VEX\" scene.csv > /dev/full").exit_code, 1);
  EXPECT_EQ(shell("\"$VEX\" scene.csv --json result.json > /dev/full").exit_code, 1);
  EXPECT_TRUE(json::accept(read_file("result.json")));
}

TEST_F(SceneTest, AnInterruptEndsIt) {
  // A million pairs of discs that all overlap: nothing is settled before whatever search comes last.
  const Words words = {"--random",   "20000,cylinder:10,0.5,60",
                       "--query",    "within",
                       "--distance", "0.1",
                       "--json",     "result.json",
                       "--threads",  "2"};
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const Finished finished = run_and_signal(words, signal, has_worker_threads);
    EXPECT_EQ(finished.exit_code, code) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_NE(finished.err.find("interrupted before there was"), std::string::npos) << finished.err;
    const json document = json::parse(read_file("result.json"), nullptr, false);
    ASSERT_TRUE(document.is_object());
    EXPECT_EQ(document.at("complete"), false);
    EXPECT_TRUE(document.at("pairs").is_null());
    EXPECT_EQ(document.at("bodies"), 20000);
    EXPECT_EQ(files(), std::vector<std::string>{"result.json"});
  }
}

}  // namespace
}  // namespace vex::golden
