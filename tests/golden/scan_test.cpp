// vex_scan as users meet it.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <set>
#include <sstream>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class ScanProgram : public ProgramTest {
 protected:
  ScanProgram() : ProgramTest(VEX_SCAN_PROGRAM) {}

  void expect_refused(const Words& words, int code, const std::string& part) const {
    SCOPED_TRACE(testing::PrintToString(words));
    expect_refusal(run(words), code, part, "vex_scan");
  }

  std::vector<json> rows(const std::string& name) const {
    std::vector<json> found;
    std::istringstream lines(read_file(name));
    for (std::string line; std::getline(lines, line);) found.push_back(json::parse(line));
    return found;
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) found.push_back(line);
  return found;
}

TEST_F(ScanProgram, WritesARowForEachValueWithTheFormulasBeside) {
  const Finished finished = run({"capsule:{L},0.5", "--for", "L=1:3:0.5", "--trials", "4096", "--csv", "rows.csv",
                                 "--jsonl", "rows.jsonl", "--json", "all.json", "--plot", "rows.svg"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  EXPECT_NE(finished.out.find("capsule:1.5,0.5"), std::string::npos);
  const std::vector<std::string> csv = lines_of(read_file("rows.csv"));
  ASSERT_EQ(csv.size(), 6u);
  EXPECT_EQ(csv[0], "L,a,b,excluded_volume,std_error,reference,z,b2,reduced,seconds,error,input");
  EXPECT_EQ(csv[2].find("1.5,\"capsule:1.5,0.5\",\"capsule:1.5,0.5\","), 0u) << csv[2];
  const std::vector<json> found = rows("rows.jsonl");
  ASSERT_EQ(found.size(), 5u);
  std::set<std::uint64_t> seeds;
  for (const json& row : found) {
    const double length = row["L"], pi = std::acos(-1.0);
    const double truth = 4.0 / 3.0 * pi + 2.0 * pi * length + 0.5 * pi * length * length;
    EXPECT_NEAR(row["reference"], truth, 1e-12 * truth);
    EXPECT_LT(std::fabs(row["excluded_volume"].get<double>() - truth), 5.0 * row["std_error"].get<double>());
    EXPECT_EQ(row["b2"], row["excluded_volume"].get<double>() / 2.0);
    EXPECT_TRUE(row["error"].is_null());
    EXPECT_EQ(row["trials"], 4096);
    seeds.insert(row["seed"].get<std::uint64_t>());
  }
  EXPECT_EQ(seeds.size(), 5u);
  EXPECT_EQ(json::parse(read_file("all.json"))["rows"].size(), 5u);
  const std::string picture = read_file("rows.svg");
  EXPECT_NE(picture.find("excluded volume"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST_F(ScanProgram, ACaseIsVexMeshWithItsSeed) {
  ASSERT_EQ(run({"box:1,1,{C}", "--for", "C=1:2:1", "--trials", "4096", "--jsonl", "rows.jsonl", "--quiet"}).exit_code,
            0);
  const json row = rows("rows.jsonl").at(1);
  const std::string mesh = VEX_MESH_PROGRAM;
  const Finished alone = shell("'" + mesh + "' box:1,1,2 --trials 4096 --json - --seed " + row["seed"].dump());
  const json document = json::parse(alone.out);
  EXPECT_EQ(document["estimate"]["excluded_volume"], row["excluded_volume"]);
  EXPECT_EQ(document["z"], row["z"]);
}

TEST_F(ScanProgram, OtherCasesChangeNoCase) {
  const Words few = {"sphere:{R}", "--for", "R=1:3:1", "--trials", "2048", "--jsonl", "few.jsonl", "--quiet"};
  const Words many = {"box:1,1,{R}", "sphere:{R}", "--for",      "R=0.5:3:0.5", "--trials",
                      "2048",        "--jsonl",    "many.jsonl", "--quiet"};
  ASSERT_EQ(run(few).exit_code, 0);
  ASSERT_EQ(run(many).exit_code, 0);
  std::map<std::string, json> by_body;
  for (const json& row : rows("many.jsonl")) by_body[row["a"]] = row;
  for (const json& row : rows("few.jsonl")) {
    EXPECT_EQ(row["excluded_volume"], by_body.at(row["a"])["excluded_volume"]);
    EXPECT_EQ(row["seed"], by_body.at(row["a"])["seed"]);
  }
  Words other = few;
  other.insert(other.end(), {"--seed", "2", "--jsonl=other.jsonl"});
  std::erase(other, "--jsonl");
  std::erase(other, "few.jsonl");
  ASSERT_EQ(run(other).exit_code, 0);
  EXPECT_NE(rows("other.jsonl")[0]["seed"], rows("few.jsonl")[0]["seed"]);
}

TEST_F(ScanProgram, AnglesHaveTheirExactValue) {
  const auto rows_at = [&](const Words& bodies, const std::string& angles) {
    Words words = bodies;
    words.insert(words.end(), {"--angle", angles, "--trials", "2048", "--jsonl", "rows.jsonl", "--quiet"});
    EXPECT_EQ(run(words).exit_code, 0);
    std::vector<json> found = rows("rows.jsonl");
    for (const json& row : found) {
      EXPECT_EQ(row["reference_kind"], "exact");
      EXPECT_EQ(row["orientations"], "angle:" + std::to_string(row["angle"].get<int>()));
      EXPECT_LT(std::fabs(row["z"].get<double>()), 5.0);
    }
    return found;
  };
  EXPECT_EQ(rows_at({"cylinder:1,0.5", "box:1,2,1", "--pairs"}, "30:30:1").size(), 3u);
  const std::vector<json> found = rows_at({"cylinder:5,0.5"}, "0:90:45");
  ASSERT_EQ(found.size(), 3u);
  // Parallel cylinders: 8 V.
  EXPECT_NEAR(found[0]["reference"], 10.0 * std::acos(-1.0), 1e-9);
}

TEST_F(ScanProgram, ARefusedCaseIsARowAndTheOthersAreDone) {
  write_file("cube.obj", "v 0 0 0\n");
  const Finished finished = run({"sphere:1", "cube.obj", "missing.obj", "cube:1", "box:1,1,1", "--trials", "1024",
                                 "--csv", "rows.csv", "--jsonl", "rows.jsonl", "--plot", "rows.svg"});
  EXPECT_EQ(finished.exit_code, 3);
  const std::vector<json> found = rows("rows.jsonl");
  ASSERT_EQ(found.size(), 5u);
  EXPECT_TRUE(found[0]["error"].is_null());
  for (const std::size_t k : {1u, 2u, 3u}) {
    EXPECT_TRUE(found[k]["excluded_volume"].is_null());
    EXPECT_NE(found[k]["error"].get<std::string>().find(" - "), std::string::npos);
  }
  EXPECT_NE(found[3]["error"].get<std::string>().find("did you mean box:A,B,C?"), std::string::npos);
  EXPECT_TRUE(found[4]["error"].is_null());
  EXPECT_NE(finished.err.find("vex_scan: missing.obj: cannot read"), std::string::npos);
  EXPECT_EQ(lines_of(finished.err).size(), 3u);
  EXPECT_EQ(lines_of(read_file("rows.csv")).size(), 6u);
}

TEST_F(ScanProgram, RowsOfAnEarlierFileAreKept) {
  const auto scan = [&](const std::string& range, const Words& more) {
    Words words = {"capsule:{L},0.5", "--for", range, "--trials", "2048", "--json", "all.json", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).exit_code, 0);
    return json::parse(read_file("all.json"))["kept"].get<int>();
  };
  for (const Words& file : {Words{"--csv", "rows.csv"}, Words{"--jsonl", "rows.jsonl"}}) {
    EXPECT_EQ(scan("L=1:3:1", file), 0);
    const std::string before = read_file(file[1]);
    EXPECT_EQ(scan("L=1:3:1", file), 3);
    EXPECT_EQ(read_file(file[1]), before) << "seconds too: nothing was run";
    EXPECT_EQ(scan("L=1:3:0.5", file), 3);
    const auto with = [&](Words more) {
      more.insert(more.begin(), file.begin(), file.end());
      return more;
    };
    EXPECT_EQ(scan("L=1:3:1", with({"--scale", "2"})), 0);
    EXPECT_EQ(scan("L=1:3:1", with({"--seed", "2"})), 0);
    EXPECT_EQ(scan("L=1:3:1", with({"--seed", "2", "--isa", "scalar", "--threads", "2"})), 3);
  }
  // A line that was cut off is run again.
  EXPECT_EQ(scan("L=1:3:1", {"--csv", "rows.csv"}), 0);
  const std::string whole = read_file("rows.csv");
  write_file("rows.csv", whole.substr(0, whole.size() - 5));
  EXPECT_EQ(scan("L=1:3:1", {"--csv", "rows.csv"}), 2);
}

TEST_F(ScanProgram, AChangedMeshIsRunAgain) {
  const auto kept = [&] {
    EXPECT_EQ(run({"body.obj", "--trials", "1024", "--csv", "r.csv", "--json", "a.json", "--quiet"}).exit_code, 0);
    return json::parse(read_file("a.json"))["kept"].get<int>();
  };
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  write_file("body.obj", tetrahedron);
  EXPECT_EQ(kept(), 0);
  EXPECT_EQ(kept(), 1);
  write_file("body.obj", "v 0 0 0\nv 2 0 0\n" + tetrahedron.substr(tetrahedron.find("v 0 1")));
  EXPECT_EQ(kept(), 0);
}

TEST_F(ScanProgram, AnInterruptKeepsTheRowsThatWereDone) {
  const Words words = {"box:1,1,{C}", "--for",  "C=1:500:1", "--trials",  "2e5", "--estimator", "hit-or-miss", "--csv",
                       "rows.csv",    "--json", "all.json",  "--threads", "3"};
  const Finished finished = run_and_signal(words, SIGINT, [this](pid_t process) {
    std::error_code none_yet;
    const std::uintmax_t size = std::filesystem::file_size(path("rows.csv"), none_yet);
    return has_worker_threads(process) && !none_yet && size > 0;
  });
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_NE(finished.out.find("INTERRUPTED"), std::string::npos);
  const json document = json::parse(read_file("all.json"));
  EXPECT_EQ(document["complete"], false);
  const std::size_t n = document["rows"].size();
  EXPECT_GT(n, 0u);
  EXPECT_LT(n, 500u);
  EXPECT_EQ(lines_of(read_file("rows.csv")).size(), n + 1);
  for (const json& row : document["rows"]) EXPECT_EQ(row["trials"], 200000);
}

TEST_F(ScanProgram, OfTwoThatLiveOneHasTheFile) {
  const Finished finished = shell(
      "\"$VEX\" box:1,1,1 box:1,1,2 --trials 1e12 --estimator hit-or-miss --csv rows --jsonl lines --quiet & "
      "until [ -e rows ] && [ -e lines ]; do sleep 0.02; done; sleep 0.2; for files in '--csv rows' '--jsonl lines' "
      "'--csv other --jsonl lines'; do \"$VEX\" sphere:1 --quiet $files || echo refused $?; done; "
      "kill -TERM $!; wait $!");
  EXPECT_EQ(finished.exit_code, 143) << finished.err;
  EXPECT_EQ(finished.out, "refused 2\nrefused 2\nrefused 2\n");
  EXPECT_NE(finished.err.find("another run that lives saves itself in this file (rows for --csv) - wait for its end, "
                              "or name another file"),
            std::string::npos)
      << finished.err;
  EXPECT_FALSE(std::filesystem::exists(path("other")));
  // The lock goes with the process, however that ends.
  EXPECT_EQ(run({"sphere:1", "--quiet", "--csv", "rows", "--jsonl", "lines"}).exit_code, 0);
  EXPECT_EQ(lines_of(read_file("rows")).size(), 2U);
}

TEST_F(ScanProgram, EachWithOneBodyAndVariablesInOptions) {
  ASSERT_EQ(run({"sphere:{R}", "--with", "box:1,1,1", "--for", "R=1:2:1", "--for", "D=30:60:30", "--orientations",
                 "cone:{D}", "--trials", "512", "--jsonl", "rows.jsonl", "--quiet"})
                .exit_code,
            0);
  const std::vector<json> found = rows("rows.jsonl");
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[3]["a"], "sphere:2");
  EXPECT_EQ(found[3]["b"], "box:1,1,1");
  EXPECT_EQ(found[3]["orientations"], "cone:60");
  EXPECT_GT(found[3]["order_parameter"], 0.0);
}

TEST_F(ScanProgram, RefusesWhatMakesNoSense) {
  expect_refused({}, 2, "no body is given");
  expect_refused({"cube:1"}, 2, "did you mean box:A,B,C?");
  expect_refused({"sphere:{R}"}, 2, "no --for gives its values ({R} in sphere:{R}) - add --for R=");
  expect_refused({"sphere:1", "--for", "R=1:2:1"}, 2, "a variable that fills nothing (R for --for)");
  expect_refused({"sphere:{R}", "--for", "R=1:2"}, 2, "not a range (\"1:2\" for --for)");
  expect_refused({"sphere:{R}", "--for", "R=1:2:0"}, 2, "a step of 0");
  expect_refused({"sphere:{R}", "--for", "R=1:2:-1"}, 2, "leads away from the end");
  expect_refused({"sphere:{R}", "--for", "1:2:1"}, 2, "not a variable with its range");
  expect_refused({"sphere:{z}", "--for", "z=1:2:1"}, 2, "the name of a column (z for --for)");
  expect_refused({"sphere:{R}", "--for", "R=1:2:1", "--for", "R=1:3:1"}, 2, "given twice");
  expect_refused({"box:{X},{Y},1", "--for", "X=1:1000:1", "--for", "Y=1:1000:1"}, 2, "too many cases");
  expect_refused({"sphere:1", "--angle", "0:190:10"}, 2, "not an angle between two axes (190");
  expect_refused({"sphere:1", "--angle", "0:90:10", "--orientations", "aligned"}, 2, "leave out one of them");
  expect_refused({"sphere:1", "--pairs", "--with", "sphere:2"}, 2, "leave out one of them");
  expect_refused({"-", "--format", "stl"}, 2, "standard input can be read only once");
  expect_refused({"sphere:1", "--dump-vertices"}, 2, "a scan lists no vertices");
  expect_refused({"sphere:1", "--trials", "0"}, 2, "--trials");
  expect_refused({"sphere:1", "--orientations", "bogus"}, 2, "there are isotropic");
  expect_refused({"sphere:1", "--trails", "10"}, 2, "did you mean --trials?");
  expect_refused({"sphere:1", "--plots", "x"}, 2, "did you mean --plot?");
  expect_refused({"sphere:1", "--csv", "a.obj"}, 2, "a.obj");
  expect_refused({"sphere:1", "--csv", "a.csv", "--jsonl", "a.csv"}, 2, "one file for two outputs");
  EXPECT_TRUE(files().empty());
}

TEST_F(ScanProgram, ReplacesNoFileThatIsNoTableOfItsOwn) {
  const Words scan = {"sphere:1", "--trials", "512", "--quiet"};
  const auto with = [&](const std::string& option, const std::string& file) {
    Words words = scan;
    words.insert(words.end(), {option, file});
    return words;
  };
  for (const std::string text : {"x,y\n1,2\n", "my thesis\n", "{\"a\": 1}\n", "a,b,excluded_volume\n", "[1]\n"}) {
    for (const char* const option : {"--csv", "--jsonl"}) {
      write_file("data.txt", text);
      expect_refused(with(option, "data.txt"), 2, "a file that is no table of a scan");
      EXPECT_EQ(read_file("data.txt"), text);
    }
  }
  for (const char* const option : {"--csv", "--jsonl"}) {
    write_file("rows.txt", "");
    EXPECT_EQ(run(with(option, "rows.txt")).exit_code, 0) << "an empty file holds nothing";
    EXPECT_EQ(run(with(option, "rows.txt")).exit_code, 0) << "its own";
    EXPECT_EQ(run(with(option, "/dev/null")).exit_code, 0);
  }
  // A table of its own with anything in it that is no row.
  for (const char* const option : {"--csv", "--jsonl"}) {
    write_file("rows.txt", "");
    ASSERT_EQ(run(with(option, "rows.txt")).exit_code, 0);
    const std::string own = read_file("rows.txt");
    const std::string header = own.substr(0, own.find('\n') + 1);
    std::vector<std::string> more = {own + "my note\n", own + "1,2,3\n", own + "\n" + own, own + "{\"a\":1}\n",
                                     own + "[]\n"};
    if (option == std::string("--csv")) more.push_back(own + header);
    for (const std::string& text : more) {
      write_file("rows.txt", text);
      expect_refused(with(option, "rows.txt"), 2, "or has more in it");
      EXPECT_EQ(read_file("rows.txt"), text);
    }
    const std::string row = own.substr(own.rfind('\n', own.size() - 2) + 1);
    write_file("rows.txt", own + row.substr(0, row.size() - 5));
    EXPECT_EQ(run(with(option, "rows.txt")).exit_code, 0) << "a line that was cut off";
    EXPECT_TRUE(read_file("rows.txt").ends_with('\n'));
  }
  // Rows of another scan: of other variables, and of other cases.
  const auto over = [&](const char* values, const char* option, const char* file) {
    return run({"sphere:{R}", "--for", values, "--trials", "512", option, file, "--quiet"});
  };
  for (const auto& [option, file] : {std::pair{"--csv", "own.csv"}, {"--jsonl", "own.jsonl"}}) {
    ASSERT_EQ(over("R=1:3:1", option, file).exit_code, 0);
    const std::string text = read_file(file);
    expect_refused(with(option, file), 2, "no table of a scan over these variables");
    EXPECT_EQ(read_file(file), text);
    const Finished other = over("R=3:4:1", option, file);
    EXPECT_EQ(other.exit_code, 0);
    EXPECT_NE(other.err.find("2 rows of an earlier scan in the same file are of no case of this one, and not kept"),
              std::string::npos)
        << other.err;
    EXPECT_EQ(over("R=3:5:1", option, file).err, "");
  }
}

TEST_F(ScanProgram, LawsOfEachBodyAxesAndTablesMakeCases) {
  write_file("density.txt", "# cos density\n-1 3\n0 0.5\n1 3\n");
  const auto scan = [&] {
    EXPECT_EQ(run({"box:{L},1,1", "--with", "box:1,1,3", "--for", "L=2:3:1", "--orientations", "table:density.txt",
                   "--orientations-b", "maier-saupe:2", "--axis-a", "x", "--trials", "2048", "--jsonl", "rows.jsonl",
                   "--json", "all.json", "--quiet"})
                  .exit_code,
              0);
    return json::parse(read_file("all.json"))["kept"].get<int>();
  };
  EXPECT_EQ(scan(), 0);
  for (const json& row : rows("rows.jsonl")) {
    EXPECT_LT(std::fabs(row["z"].get<double>()), 5.0);
    EXPECT_EQ(row["orientations"].get<std::string>().find("A table:"), 0u);
    EXPECT_TRUE(row["order_parameter"].is_null());
  }
  EXPECT_EQ(scan(), 2);
  write_file("density.txt", "-1 3\n0 0.25\n1 3\n");  // the same name, another density
  EXPECT_EQ(scan(), 0);
  expect_refused({"sphere:1", "--orientations", "table:rows.txt", "--trials", "10", "--csv", "rows.txt"}, 2,
                 "the output file is an input");
}

// A resumed scan that was stopped wrote its own rows alone, and those of the file were lost.
TEST_F(ScanProgram, AStoppedScanLosesNoRowsOfAnEarlierOne) {
  ASSERT_EQ(shell("\"$VEX\" 'box:1,1,{L}' --for L=31:34:1 --trials 1000 --csv s.csv --quiet").exit_code, 0);
  const std::string before = read_file("s.csv");
  shell(
      "timeout -s INT 1 \"$VEX\" 'box:1,1,{L}' --for L=1:34:1 --trials 1e11 --estimator hit-or-miss --csv s.csv "
      "--quiet");
  const std::string after = read_file("s.csv");
  EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), std::count(before.begin(), before.end(), '\n')) << after;
  EXPECT_NE(after.find("\n31,"), std::string::npos) << after;
}

}  // namespace
}  // namespace vex::golden
