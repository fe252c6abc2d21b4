// vex_merge: ranges of trials in any order are one run; what is no whole of them is refused.
#include <algorithm>
#include <random>

#include "tests/golden/program.h"
#include "tests/golden/run_documents.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Merge : public ProgramTest {
 protected:
  Merge() {
    setenv("MERGE", VEX_MERGE_PROGRAM, 1);
    setenv("PERCOLATE", VEX_PERCOLATE_PROGRAM, 1);
    setenv("VIRIAL", VEX_VIRIAL_PROGRAM, 1);
  }

  void make_range(const Words& of, const std::string& name, std::uint64_t first, std::uint64_t n) const {
    Words words = of;
    words.insert(words.end(), {"--quiet", "--first-trial", std::to_string(first), "--trials", std::to_string(n),
                               "--threads", std::to_string(1 + first % 3), "--json", name});
    const Finished finished = run(words);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
  }
  Finished merge(const std::string& arguments) const { return shell("\"$MERGE\" " + arguments); }
  void expect_refused(const std::string& arguments, int exit_code, const std::string& part) const {
    expect_refusal(merge(arguments), exit_code, part, "vex_merge");
  }
};

TEST_F(Merge, RangesInAnyOrderAreOneRun) {
  std::mt19937_64 random(24);
  const std::vector<Words> runs = {
      {"box:1,1,2", "capsule:1,0.3"},
      {"box:1,1,2", "capsule:1,0.3", "--estimator", "hit-or-miss"},
      {"box:1,1,2", "capsule:1,0.3", "--estimator", "hit-or-miss-fitted", "--sequence", "sobol"},
      {"box:1,1,2", "capsule:1,0.3", "--estimator", "stratified", "--cross-check"},
      {"box:1,1,2", "capsule:1,0.3", "--orientations", "onsager:2", "--estimator", "mixed-volume"},
      {"sphere:1", "--estimator", "hit-or-miss", "--domain", "ball"}};
  for (const Words& of : runs) {
    constexpr std::uint64_t kRange = 320, kLast = 77;
    std::vector<std::string> names;
    for (std::uint64_t k = 0; k < 5; ++k) {
      names.push_back(std::to_string(k) + ".json");
      make_range(of, names.back(), k * kRange, k < 4 ? kRange : kLast);
    }
    std::shuffle(names.begin(), names.end(), random);
    std::string arguments = "--quiet --json all.json --max-z 20";
    for (const std::string& name : names) arguments += " " + name;
    const Finished merged = merge(arguments);
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    Words whole = of;
    whole.insert(whole.end(), {"--trials", std::to_string(4 * kRange + kLast)});
    EXPECT_EQ(without_times(json::parse(read_file("all.json"))), without_times(json_of(whole))) << of.back();
  }
}

// Programs but vex_mesh that make parts of runs, as variables of the shell, and their words for them.
struct Parted {
  std::string run, first, number;
};
const std::string kVirial = "\"$VIRIAL\" --quiet ", kPercolate = "\"$PERCOLATE\" --quiet ";
const std::vector<Parted> kParted = {
    {kVirial + "box:1,1,2 --order 6", "--first-trial", "--trials"},
    {kVirial + "ellipsoid:1,1,1.00001 --order 4", "--first-trial", "--trials"},
    {kVirial + "sphere:0.5 box:1,1,1", "--first-trial", "--trials"},
    {kVirial + "disc:1 --order 3", "--first-trial", "--trials"},
    {kVirial + "cylinder:3,0.5 --orientations onsager:4 --only 4", "--first-trial", "--trials"},
    {kVirial + "box:1,1,1 --orientations aligned", "--first-trial", "--trials"},
    {kPercolate + "box:1,1,1 --sizes 3,4", "--first-realisation", "--realisations"},
    {kPercolate + "disc:1 box:1,1,1 --sizes 3,4 --orientations onsager:2", "--first-realisation", "--realisations"}};

TEST_F(Merge, RangesOfOtherProgramsInAnyOrderAreOneRun) {
  std::mt19937_64 random(26);
  for (const Parted& one : alike(kParted)) {
    const auto make = [&](std::uint64_t first, std::uint64_t n, const std::string& name) {
      const Finished finished =
          shell(one.run + " " + one.first + " " + std::to_string(first) + " " + one.number + " " + std::to_string(n) +
                " --threads " + std::to_string(1 + first % 3) + " --json " + name);
      EXPECT_EQ(finished.exit_code, 0) << finished.err;
    };
    const std::vector<std::uint64_t> ends = {0, 30, 40, 75, 80};  // of which the first ones have no threshold
    std::vector<std::string> names;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      names.push_back(std::to_string(k) + ".json");
      make(ends[k], ends[k + 1] - ends[k], names.back());
    }
    make(0, ends.back(), "whole.json");
    std::shuffle(names.begin(), names.end(), random);
    std::string all;
    for (const std::string& name : names) all += " " + name;
    const Finished merged = merge("--json all.json --quiet --trials 80" + all);
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    const json whole = json::parse(read_file("whole.json"));
    EXPECT_EQ(without_times(json::parse(read_file("all.json"))), without_times(whole)) << one.run;
    // Parts of parts, and what is no whole.
    ASSERT_EQ(merge("3.json 1.json 2.json --part --quiet --json high.json").exit_code, 0);
    ASSERT_EQ(merge("high.json 0.json --quiet --json again.json").exit_code, 0);
    EXPECT_EQ(without_times(json::parse(read_file("again.json"))), without_times(whole)) << one.run;
    expect_refused("0.json 1.json 3.json", 3, "are in no document (trials 40 ... 74)");
    expect_refused("1.json 2.json 3.json", 3, "are in no document (trials 0 ... 29)");
    expect_refused("0.json 1.json --trials 41", 3, "(trial 40)");
    expect_refused("0.json 1.json --trials 39", 3, "than asked for (40, and --trials 39)");
    expect_refused("0.json whole.json", 3, "trials 0 ... 29");
    const Finished other = shell(one.run + " --seed 2 " + one.first + " 30 " + one.number + " 10 --json other.json");
    ASSERT_EQ(other.exit_code, 0) << other.err;
    expect_refused("0.json other.json", 3, "documents of unlike runs (other.json has \"");
    make_range({"box:1,1,1"}, "mesh.json", 0, 320);
    expect_refused("0.json mesh.json", 3, "documents of unlike programs (0.json is of vex_");
    // Damaged ones.
    const std::string text = read_file("1.json");
    const std::size_t tally = text.find("\"tally\"");
    for (int k = 0; k < 4; ++k) {
      std::string changed = text;
      const std::size_t at = k % 2 == 0 ? random() % text.size() : tally + random() % (text.size() - tally);
      changed[at] = "0123456789{}[],:\"x-"[random() % 19];
      write_file("x.json", changed);
      const Finished finished = merge("0.json x.json --quiet");
      EXPECT_TRUE(finished.exit_code == 0 || finished.exit_code == 3) << at << ": " << finished.err;
    }
    for (const std::string& name : files()) std::filesystem::remove(path(name));
  }
}

TEST_F(Merge, ADocumentWithoutSizesOrCoefficientsIsRefused) {
  ASSERT_EQ(shell(kPercolate + "box:1,1,1 --sizes 3 --first-realisation 0 --realisations 5 --json p.json").exit_code,
            0);
  json changed = json::parse(read_file("p.json"));
  changed["sizes"] = json::array();
  json& lines = changed["tally"]["state"];
  for (std::size_t k = lines.size(); k-- > 0;) {
    const std::string line = lines[k];
    if (line.starts_with("0,") || line.starts_with("# counts") || line.starts_with("# end")) lines.erase(k);
  }
  write_file("x.json", changed.dump());
  expect_refused("x.json", 3, "without sizes (x.json)");
  ASSERT_EQ(shell(kVirial + "box:1,1,1 --trials 5 --json v.json").exit_code, 0);
  changed = json::parse(read_file("v.json"));
  changed["coefficients"] = json::array();
  write_file("x.json", changed.dump());
  expect_refused("x.json", 3, "without coefficients (x.json)");
  changed = json::parse(read_file("v.json"));
  changed["coefficients"][0]["n"] = 900;
  write_file("x.json", changed.dump());
  expect_refused("x.json", 3, "a coefficient that is none");
}

TEST_F(Merge, PartsEndByTheirNumberAlone) {
  ASSERT_EQ(shell(kVirial + "box:1,1,1 --rel-error 1e-2 --json error.json").exit_code, 0);
  expect_refused("error.json", 3, "ended by \"rel-error\"");
  ASSERT_EQ(shell(kPercolate + "box:1,1,1 --sizes 3 --realisations 5 --json plain.json").exit_code, 0);
  expect_refused("plain.json", 3, "without its realisations (plain.json) - run it with --first-realisation");
  EXPECT_EQ(shell(kVirial + "box:1,1,1 --first-trial 5").exit_code, 2);
  EXPECT_EQ(shell(kVirial + "box:1,1,1 --first-trial 5 --trials 5 --seconds 1").exit_code, 2);
  EXPECT_EQ(shell(kPercolate + "box:1,1,1 --sizes 3 --first-realisation 5").exit_code, 2);
  EXPECT_EQ(shell(kPercolate + "box:1,1,1 --sizes 3 --first-realisation 5 --realisations 5 --std-error 1").exit_code,
            2);
  // A remainder of one is a part as well.
  const auto part = [](int first, int n) {
    return kPercolate + "box:1,1,1 --sizes 3 --first-realisation " + std::to_string(first) + " --realisations " +
           std::to_string(n) + " --json " + std::to_string(n) + ".json";
  };
  for (const auto& [first, n] : {std::pair{0, 5}, {5, 1}, {0, 6}}) ASSERT_EQ(shell(part(first, n)).exit_code, 0);
  ASSERT_EQ(merge("1.json 5.json --quiet --json all.json").exit_code, 0);
  EXPECT_EQ(without_times(json::parse(read_file("all.json"))), without_times(json::parse(read_file("6.json"))));
  // A part's state is of that part.
  ASSERT_EQ(shell(kPercolate + "box:1,1,1 --sizes 3 --first-realisation 5 --realisations 5 --checkpoint s").exit_code,
            0);
  const Finished finished = shell(kPercolate + "box:1,1,1 --sizes 3 --realisations 9 --resume s");
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_NE(finished.err.find("of another part of the run"), std::string::npos) << finished.err;
}

TEST_F(Merge, PartsOfPartsAreAdded) {
  const Words of = {"box:1,1,1", "--estimator", "hit-or-miss"};
  for (std::uint64_t k = 0; k < 4; ++k) make_range(of, std::to_string(k) + ".json", 1000 * k, 1000);
  ASSERT_EQ(merge("3.json 2.json --part --quiet --json high.json").exit_code, 0);
  ASSERT_EQ(merge("0.json 1.json --quiet --json low.json").exit_code, 0);
  const Finished all = merge("high.json low.json --trials 4000 --json -");
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(without_times(json::parse(all.out)),
            without_times(json_of({"box:1,1,1", "--estimator", "hit-or-miss", "--trials", "4000"})));
  EXPECT_NE(merge("high.json low.json").out.find("2 documents, trials 0 ... 3999, hit-or-miss"), std::string::npos);
}

TEST_F(Merge, WhatIsNoWholeIsRefused) {
  const Words of = {"box:1,1,1", "--estimator", "hit-or-miss"};
  for (std::uint64_t k = 0; k < 4; ++k) make_range(of, std::to_string(k) + ".json", 1000 * k, 1000);
  expect_refused("0.json 1.json 3.json", 3, "trials are in no document (trials 2000 ... 2999)");
  expect_refused("1.json 2.json", 3, "trials are in no document (trials 0 ... 999)");
  expect_refused("3.json 1.json", 3, "(trials 0 ... 999, trials 2000 ... 2999)");
  expect_refused("0.json 1.json --trials 2001", 3, "(trial 2000)");
  expect_refused("0.json 1.json --trials 1999", 3, "more trials than asked for");
  expect_refused("0.json 1.json 0.json", 3, "trials 0 ... 999 are in two documents");
  make_range(of, "over.json", 1500, 1000);
  expect_refused("0.json 1.json over.json", 3, "trials 1500 ... 1999 are in two documents (1.json and over.json)");
  make_range({"box:1,1,2", "--estimator", "hit-or-miss"}, "other.json", 1000, 1000);
  expect_refused("0.json other.json", 3, "documents of unlike runs (other.json has \"A: box");
  make_range({"box:1,1,1", "--estimator", "hit-or-miss", "--seed", "2"}, "seed.json", 1000, 1000);
  expect_refused("0.json seed.json", 3, "has \"seed: 2\", and 0.json \"seed: 1\"");
  json changed = json::parse(read_file("1.json"));
  changed["seed"] = 7;
  write_file("seed.json", changed.dump());
  expect_refused("0.json seed.json", 3, "has \"seed: 7\", and 0.json \"seed: 1\"");
  make_range({"box:1,1,1", "--estimator", "hit-or-miss-fitted"}, "fitted.json", 1000, 1000);
  expect_refused("0.json fitted.json", 3, "documents of unlike runs");
  ASSERT_EQ(run({"box:1,1,1", "--rel-error", "1e-2", "--quiet", "--json", "error.json"}).exit_code, 0);
  expect_refused("error.json", 3, "ended by \"rel-error\"");
  expect_refused("0.json missing.json", 3, "missing.json: No such file");
  expect_refused("0.json --json 0.json", 2, "the output file is an input");
  expect_refused("", 2, "FILES");
}

TEST_F(Merge, DamagedDocumentsAreRefused) {
  const Words of = {"box:1,1,1", "--estimator", "radial"};
  make_range(of, "0.json", 0, 320);
  const std::string whole = read_file("0.json");
  for (const std::string text : {"", "{", "[]", "7", "{\"estimate\": 7}", "{\"estimate\": {}}",
                                 "{\"estimate\": {}, \"tally\": {\"state\": [7]}}"}) {
    write_file("x.json", text);
    expect_refused("x.json", 3, "document");
  }
  std::mt19937_64 random(5);
  const std::size_t tally = whole.find("\"tally\"");
  for (int k = 0; k < 30; ++k) {
    std::string changed = whole;
    const std::size_t at = k % 2 == 0 ? random() % whole.size() : tally + random() % (whole.size() - tally);
    changed[at] = "0123456789{}[],:\"x-"[random() % 19];
    write_file("x.json", changed);
    const Finished finished = merge("x.json --quiet");
    EXPECT_TRUE(finished.exit_code == 0 || finished.exit_code == 3 || finished.exit_code == 4)
        << at << ": " << finished.err;
  }
}

}  // namespace
}  // namespace vex::golden
