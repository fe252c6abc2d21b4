// vex_pair in pipes: streams that come slowly, end early, hold bad rows, or are interrupted.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "tests/golden/pair.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

TEST_F(PairStream, StandardInputIsAnsweredQuickly) {
  write_file("poses.csv", matrix_file(random_poses(100000)));
  const Finished finished = shell("cat poses.csv | \"$VEX\" box:1,1,1 box:1,1,1 --poses - --jsonl --quiet | tail -n 1");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out).at("index"), 99999);
  EXPECT_EQ(finished.out, lines_of(cubes({"--poses", "poses.csv", "--jsonl"}).out).back() + "\n");
}

TEST_F(PairStream, AWriterThatWaitsForItsAnswersGetsThem) {
  const Finished finished = shell(
      "mkfifo in out; \"$VEX\" box:1,1,1 box:1,1,1 --poses - --quiet --csv <in >out & exec 3>in 4<out\n"
      "echo tx,ty,tz,qw,qx,qy,qz >&3; read header <&4\n"
      "for x in 0.5 2 0.25; do echo $x,0,0,1,0,0,0 >&3; read answer <&4; echo \"$answer\" | cut -d, -f 1,2; done\n"
      "exec 3>&-; wait $!");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.out, "0,overlap\n1,disjoint\n2,overlap\n");
}

// What is left of a number may be one: 1.5 of 1.55.
TEST_F(PairStream, ALastLineWithoutItsEndIsWarnedOf) {
  const std::string file = "tx,ty,tz,qw,qx,qy,qz\n0.5,0,0,1,0,0,0\n";
  for (const std::string end : {"", "2,0,0,1,0,0,0\n", "\n", " "}) {
    write_file("poses.csv", file + end);
    EXPECT_EQ(cubes({"--poses", "poses.csv", "--csv", "--quiet"}).err, "") << end;
  }
  write_file("poses.csv", file + "2,0,0,1,0,0,0");
  const Finished open = cubes({"--poses", "poses.csv", "--csv", "--quiet"});
  EXPECT_EQ(open.exit_code, 0);
  EXPECT_EQ(lines_of(open.out).size(), 3u) << open.out;
  EXPECT_NE(open.err.find("poses.csv, line 3: the last line has no end - "), std::string::npos) << open.err;
}

TEST_F(PairStream, AReaderThatGoesAwayEndsTheRun) {
  write_file("poses.csv", quaternion_file(random_poses(100000)));
  const Finished head = shell("{ \"$VEX\" box:1,1,1 box:1,1,1 --poses poses.csv; echo $? > code; } | head -n 1");
  EXPECT_EQ(head.out.rfind("0 ", 0), 0u) << head.out;
  EXPECT_EQ(lines_of(head.out).size(), 1u);
  EXPECT_EQ(read_file("code"), "1\n") << "and not a death by signal";
  EXPECT_EQ(std::count(head.err.begin(), head.err.end(), '\n'), 1) << head.err;
  EXPECT_NE(head.err.find("standard output cannot be written"), std::string::npos) << head.err;
  // An endless stream ends, too.
  EXPECT_EQ(shell("{ echo tx,ty,tz,qw,qx,qy,qz; yes 0,0,0,1,0,0,0; } 2>/dev/null | \"$VEX\" box:1,1,1 box:1,1,1 "
                  "--poses - 2>/dev/null | head -n 1")
                .out.rfind("0 overlap", 0),
            0u);
  // The document is written all the same.
  shell("\"$VEX\" box:1,1,1 box:1,1,1 --poses poses.csv --json result.json 2>&1 | true");
  EXPECT_EQ(json::parse(read_file("result.json")).at("rows"), 100000);
}

TEST_F(PairStream, ABadRowEndsTheRunBehindTheRowsBeforeIt) {
  write_file("poses.csv", kQuaternionHeader + "0.5,0,0,1,0,0,0\n3,0,0,1,0,0,0\n3,0,0,1,0,zero,0\n0,0,0,1,0,0,0\n");
  const Finished finished = cubes({"--poses", "poses.csv", "--jsonl", "--json", "result.json"});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_EQ(objects_of(finished.out).size(), 2u) << finished.out;
  EXPECT_EQ(finished.err,
            "vex_pair: poses.csv, line 4, index 2: not a number (\"zero\" for qy) - write it like 0.5, 1e-3 or "
            "0x1.8p-3\n");
  EXPECT_EQ(files(), std::vector<std::string>{"poses.csv"}) << "no partial document";
  const Finished piped = shell("\"$VEX\" box:1,1,1 box:1,1,1 --poses - < poses.csv");
  EXPECT_NE(piped.err.find("standard input, line 4, index 2:"), std::string::npos) << piped.err;
}

TEST_F(PairStream, KeepGoingAnswersWhatIsBehindABadRow) {
  write_file("poses.csv", kQuaternionHeader + "0.5,0,0,1,0,0,0\n0,0,0,0,0,0,0\n\n1,2\n3,0,0,1,0,0,0\n" +
                              std::string(100000, '1') + "\n0,0,0,1,0,0,0\n");
  const Finished finished = cubes({"--poses", "poses.csv", "--jsonl", "--keep-going", "--json", "result.json"});
  EXPECT_EQ(finished.exit_code, 3);
  const std::vector<json> rows = objects_of(finished.out);
  ASSERT_EQ(rows.size(), 7u) << finished.out;
  const std::vector<std::string> expected = {"",
                                             "line 3: a quaternion of length 0",
                                             "line 4: an empty row",
                                             "line 5: wrong number of columns (2)",
                                             "",
                                             "line 7: too long a row",
                                             ""};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].at("index"), k);
    EXPECT_EQ(rows[k].contains("error"), !expected[k].empty()) << rows[k].dump();
    if (!expected[k].empty()) {
      EXPECT_EQ(rows[k].at("error").get<std::string>().rfind(expected[k], 0), 0u) << rows[k].dump();
    }
  }
  EXPECT_EQ(rows[4].at("verdict"), "disjoint");
  EXPECT_NE(finished.err.find("4 of 7 rows were refused - the first: poses.csv, line 3, index 1:"), std::string::npos)
      << finished.err;
  const json document = json::parse(read_file("result.json"));
  EXPECT_EQ(document.at("refused"), 4);
  EXPECT_EQ(document.at("results"), json(rows));
  const std::vector<std::string> csv = lines_of(cubes({"--poses", "poses.csv", "--csv", "--keep-going"}).out);
  ASSERT_EQ(csv.size(), 8u);
  EXPECT_EQ(csv[0], "index,verdict,decided_by,undecided_reason,lower,upper,iterations,error");
  EXPECT_EQ(csv[2].rfind("1,,,,,,,\"line 3: a quaternion", 0), 0u) << csv[2];
  EXPECT_EQ(csv[1].back(), ',');
}

TEST_F(PairStream, BytesThatAreNotUtf8DoNotPass) {
  write_file("poses.csv", kQuaternionHeader + "\xff,0,0,1,0,0,0\n");
  const std::string problem = "not a number (\"\xef\xbf\xbd\" for tx)";
  for (const char* form : {"--csv", "--jsonl", "--quiet"}) {
    const Finished finished = cubes({"--poses", "poses.csv", "--keep-going", form});
    EXPECT_EQ(finished.exit_code, 3);
    EXPECT_EQ((finished.out + finished.err).find('\xff'), std::string::npos) << form;
    EXPECT_NE(finished.err.find(problem), std::string::npos) << finished.err;
  }
}

TEST_F(PairStream, AnInterruptEndsTheWaitForMorePoses) {
  ASSERT_EQ(mkfifo(path("in").c_str(), 0600), 0);
  const int in = open(path("in").c_str(), O_RDWR);  // stays open, so that the stream has no end
  ASSERT_GE(in, 0);
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    SCOPED_TRACE(signal);
    const std::string poses = kQuaternionHeader + "0,0,0,1,0,0,0\n3,0,0,1,0,0,0\n3,0";
    ASSERT_EQ(write(in, poses.data(), poses.size()), static_cast<ssize_t>(poses.size()));
    const Finished finished = run_and_signal(
        {"box:1,1,1", "sphere:1", "--poses", "in", "--json", "result.json", "--jsonl"}, signal, has_answered());
    EXPECT_EQ(finished.exit_code, code) << finished.err;
    EXPECT_LT(finished.seconds, 10.0);
    EXPECT_EQ(objects_of(finished.out).size(), 2u) << finished.out;
    EXPECT_NE(finished.err.find("interrupted"), std::string::npos) << finished.err;
    const json document = json::parse(read_file("result.json"), nullptr, false);
    ASSERT_TRUE(document.is_object());
    EXPECT_EQ(document.at("complete"), false);
    EXPECT_EQ(document.at("rows"), 2);
    std::filesystem::remove(folder() / "result.json");
  }
  close(in);
}

TEST_F(PairStream, AnInterruptedComputationLeavesTheFirstRows) {
  write_file("sphere.obj", sphere_obj(60, 90));
  std::string poses = kQuaternionHeader;
  constexpr std::size_t kRows = 1000000;  // minutes
  for (std::size_t k = 0; k < kRows; ++k) poses += "1.9,0.1,0.2,1,2,3,4\n";
  write_file("poses.csv", poses);
  const Finished finished =
      run_and_signal({"sphere.obj", "sphere.obj", "--poses", "poses.csv", "--threads", "2"}, SIGINT, has_answered());
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, 10.0);
  const std::vector<std::string> rows = lines_of(finished.out);
  EXPECT_LT(rows.size(), kRows);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_EQ(rows[k].rfind(std::to_string(k) + " ", 0), 0u) << "rows are missing before this one";
  }
}

}  // namespace
}  // namespace vex::golden
