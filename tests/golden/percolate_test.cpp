// vex_percolate as users meet it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>

#include "tests/golden/sample_files.h"
#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Percolate : public ProgramTest {
 protected:
  Percolate() : ProgramTest(VEX_PERCOLATE_PROGRAM) {}

  Finished succeed(Words words) const {
    Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished;
  }
  void expect_refused(const Words& words, int code, const std::string& part) const {
    expect_refusal(run(words), code, part, "vex_percolate");
  }
};

const Words kSmall = {"box:1,1,1", "--sizes", "3,4,6", "--realisations", "60"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Percolate, TellsTheThresholdInEveryUnit) {
  const json found = json_of(kSmall);
  for (const char* key : {"bodies", "eta_c", "phi_c", "number_density_c", "b_c", "excluded_volume", "sizes", "pairs",
                          "seconds", "complete"}) {
    EXPECT_TRUE(found.contains(key)) << key;
  }
  const double eta = found["eta_c"]["value"], error = found["eta_c"]["std_error"];
  EXPECT_NEAR(eta, 0.24437, 5.0 * error);  // docs/percolation.md
  EXPECT_LT(error, 0.02);
  EXPECT_NEAR(found["phi_c"]["value"], 1.0 - std::exp(-eta), 1e-12);
  EXPECT_NEAR(found["b_c"]["value"], 11.0 * eta, 1e-9);
  EXPECT_EQ(found["excluded_volume"], 11.0);
  ASSERT_EQ(found["sizes"].size(), 3u);
  for (const json& size : found["sizes"]) {
    EXPECT_EQ(size["realisations"], 60);
    EXPECT_NEAR(size["box"], size["size"].get<double>() * std::sqrt(3.0), 1e-9);
    for (const char* criterion : {"x", "any", "all"}) EXPECT_GT(size["criteria"][criterion]["std_error"], 0.0);
  }
  const json& pairs = found["pairs"];
  EXPECT_EQ(pairs["seen"], pairs["skipped"].get<std::uint64_t>() + pairs["tested"].get<std::uint64_t>());
  EXPECT_GT(pairs["skipped"], 0);
  EXPECT_EQ(pairs["undecided"], 0);
}

TEST_F(Percolate, ThreadsAndSetsChangeNothing) {
  const auto numbers = [&](const Words& more) {
    succeed(with(with(kSmall, {"--quiet", "--csv", "out.csv"}), more));
    std::string text = read_file("out.csv");
    return text.substr(text.find("# counts"), text.find("# end") - text.find("# counts"));
  };
  const std::string wanted = numbers({"--threads", "1"});
  EXPECT_EQ(numbers({"--threads", "2"}), wanted);
  EXPECT_EQ(numbers({"--threads", "8"}), wanted);
  EXPECT_EQ(numbers({"--isa", "scalar"}).substr(wanted.find("size,")), wanted.substr(wanted.find("size,")));
  EXPECT_NE(numbers({"--seed", "2"}), wanted);
}

TEST_F(Percolate, AResumedRunIsThatOfOneRun) {
  const auto rows = [&](const std::string& file) {
    const std::string text = read_file(file);
    return text.substr(text.find("# counts"), text.find("# end") - text.find("# counts"));
  };
  succeed(with(kSmall, {"--quiet", "--csv", "whole.csv"}));
  Words part = kSmall;
  part.back() = "25";
  succeed(with(part, {"--quiet", "--checkpoint", "state.csv"}));
  EXPECT_NE(rows("state.csv"), rows("whole.csv"));
  // In the same file, as one does.
  succeed(with(kSmall, {"--quiet", "--checkpoint", "state.csv", "--resume", "state.csv"}));
  EXPECT_EQ(rows("state.csv"), rows("whole.csv"));
}

// Whether the error is reached is asked at the ends of rounds alone: from a state within one the run goes on to its
// end.
TEST_F(Percolate, ARunToAnErrorThatWasCutWithinARoundIsThatOfOneRun) {
  const auto rows = [&](const std::string& file) {
    const std::string text = read_file(file);
    return text.substr(text.find("size,"), text.find("# end") - text.find("size,"));
  };
  const Words system = {"box:1,1,1", "--sizes", "2,3", "--quiet"}, goal = {"--std-error", "0.006"};
  succeed(with(with(system, goal), {"--csv", "whole.csv"}));
  const auto n_rows = std::ranges::count(rows("whole.csv"), '\n') - 1;
  const std::string within = std::to_string(n_rows / 2 - 10);
  succeed(with(system, {"--realisations", within, "--checkpoint", "state.csv"}));
  succeed(with(with(system, goal), {"--resume", "state.csv", "--csv", "resumed.csv"}));
  EXPECT_EQ(rows("resumed.csv"), rows("whole.csv"));
}

TEST_F(Percolate, GoesOnFromNothingElse) {
  succeed(with(kSmall, {"--quiet", "--csv", "state.csv"}));
  expect_refused({"box:1,1,1.5", "--sizes", "3,4,6", "--resume", "state.csv"}, 3,
                 "state.csv, line 2: of another system");
  expect_refused(with(kSmall, {"--seed", "2", "--resume", "state.csv"}), 3, "of another system");
  expect_refused({"box:1,1,1", "--sizes", "3,4", "--resume", "state.csv"}, 3, "of another system");
  expect_refused(with(kSmall, {"--scale", "2", "--resume", "state.csv"}), 3, "of another system");
  expect_refused(with(kSmall, {"--orientations", "aligned", "--resume", "state.csv"}), 3, "of another system");
  expect_refused(with(kSmall, {"--resume", "missing.csv"}), 3, "missing.csv");
  expect_refused({"box:1,1,1", "--sizes", "3,4,6", "--realisations", "59", "--resume", "state.csv"}, 3,
                 "more realisations than the run may have (state.csv: 60 of 59)");
  const std::string whole = read_file("state.csv");
  const auto broken = [&](const std::string& content, const std::string& part) {
    write_file("broken.csv", content);
    expect_refused(with(kSmall, {"--resume", "broken.csv"}), 3, part);
  };
  const std::size_t end = whole.find("# end");
  broken(whole.substr(0, end), "the file is cut off");
  broken(whole.substr(0, end - 2), "the file is cut off");
  broken(whole.substr(0, end + 5), "the checksum");
  broken(whole.substr(0, whole.size() - 2), "the checksum");
  broken("", "line 0: of another system");
  std::string changed = whole;
  changed.replace(changed.find("\n0,3,"), 5, "\n0,4,");
  broken(changed, "realisation 4 where 3 is due");
  changed = whole;
  changed.replace(changed.find("\n0,3,") + 5, 1, "x");
  broken(changed, "not five whole numbers");
}

// Bodies of equal V, S, M and radii that only turn or mirror, and another version.
TEST_F(Percolate, AStateTellsBodiesAndVersionsApart) {
  const Words rest = {"--sizes", "3", "--realisations", "5", "--quiet"};
  for (const auto& [body, other] :
       {std::pair{"superellipsoid:1,2,3,2,1.5", "superellipsoid:2,1,3,2,1.5"}, std::pair{"egg:1,0.5,1", "egg:1,1,0.5"},
        std::pair{"box:1,2,3", "box:2,1,3"}, std::pair{"rounded:0.1,box:1,2,3", "rounded:0.1,box:1,3,2"}}) {
    succeed(with({body}, with(rest, {"--csv", "s"})));
    expect_refused(with({other}, with(rest, {"--resume", "s"})), 3, "s, line 2: of another system");
    succeed(with({body}, with(rest, {"--resume", "s"})));
  }
  std::string text = read_file("s");
  EXPECT_NE(text.find("\n# body: rounded"), std::string::npos);
  EXPECT_NE(text.find(", geometry "), std::string::npos);
  const std::string version = "# vex_percolate 0.1.0: realisations, stream ";
  ASSERT_TRUE(text.starts_with(version)) << text.substr(0, 80);
  text.replace(0, version.size(), "# vex_percolate 0.1.1: realisations, stream ");
  write_file("s", text);
  expect_refused(with({"rounded:0.1,box:1,2,3"}, with(rest, {"--resume", "s"})), 3, "s, line 1: of another system");
}

TEST_F(Percolate, AnInterruptedRunReportsWhatWasDone) {
  const Finished finished = run_and_signal({"box:1,1,1", "--sizes", "3,5", "--realisations", "1e7", "--json", "r.json",
                                            "--checkpoint", "state.csv", "--threads", "3"},
                                           SIGINT, has_worker_threads);
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  EXPECT_LT(finished.seconds, 20.0);
  EXPECT_NE(finished.out.find("INTERRUPTED"), std::string::npos);
  const json found = json::parse(read_file("r.json"));
  EXPECT_EQ(found["complete"], false);
  EXPECT_NE(read_file("state.csv").find("# end, crc32 "), std::string::npos);
}

TEST_F(Percolate, DrawsAndShowsASample) {
  const Finished finished = succeed(with(kSmall, {"--plot", "p.svg", "--gltf", "sample.glb"}));
  EXPECT_NE(finished.out.find("eta_c"), std::string::npos);
  const std::string picture = read_file("p.svg");
  EXPECT_NE(picture.find("wrapping probability R"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
  const Glb glb(read_file("sample.glb"));
  EXPECT_EQ(glb.fault, "");
  const std::string names = glb.document.dump();
  EXPECT_NE(names.find("stands out"), std::string::npos);
}

TEST_F(Percolate, FlatBodiesHaveADensityAndNoVolume) {
  const json found = json_of({"disc:1", "--sizes", "3,5", "--realisations", "200"});
  EXPECT_TRUE(found["eta_c"].is_null());
  EXPECT_TRUE(found["phi_c"].is_null());
  EXPECT_NEAR(found["b_c"]["value"], 2.302, 5.0 * found["b_c"]["std_error"].get<double>());
  expect_refused({"disc:1", "--std-error", "1e-3"}, 2, "eta of flat bodies is 0");
}

TEST_F(Percolate, AShellIsARoundedBody) {
  const Words stop = {"--sizes", "3,4", "--realisations", "30", "--quiet"};
  succeed(with(with({"box:1,1,1", "--shell", "0.2", "--csv", "shell.csv"}, stop), {}));
  succeed(with(with({"rounded:0.1,box:1,1,1", "--csv", "rounded.csv"}, stop), {}));
  const auto rows = [&](const std::string& file) {
    const std::string text = read_file(file);
    return text.substr(text.find("size,"), text.find("# end") - text.find("size,"));
  };
  EXPECT_EQ(rows("shell.csv"), rows("rounded.csv"));
}

TEST_F(Percolate, AWrongTestHasAnotherThreshold) {
  const Words stop = {"--sizes", "4,6", "--realisations", "1500"};
  const json right = json_of(with({"box:1,1,1"}, stop));
  const json wrong = json_of(with({"box:1,1,1", "--backend", "one-sided-edges"}, stop));
  const double off = wrong["eta_c"]["value"].get<double>() - right["eta_c"]["value"].get<double>();
  const double error = std::hypot(wrong["eta_c"]["std_error"].get<double>(), right["eta_c"]["std_error"].get<double>());
  EXPECT_GT(off, 5.0 * error);
  EXPECT_NEAR(off, 0.0085, 5.0 * error);  // docs/percolation.md
  expect_refused({"sphere:1", "--backend", "one-sided-edges"}, 2, "one-sided-edges has no shape for sphere:1");
}

TEST_F(Percolate, MixturesHaveFractions) {
  const json found =
      json_of({"sphere:0.5:0.25", "rounded:0.1,box:0.5,0.5,0.5:0.75", "--sizes", "3,4", "--realisations", "20"});
  EXPECT_EQ(found["bodies"][0]["fraction"], 0.25);
  EXPECT_EQ(found["bodies"][1]["source"], "rounded:0.1,box:0.5,0.5,0.5");
  EXPECT_NEAR(found["mean_volume"],
              0.25 * found["bodies"][0]["volume"].get<double>() + 0.75 * found["bodies"][1]["volume"].get<double>(),
              1e-12);
  expect_refused({"sphere:1:0.5", "sphere:2"}, 2, "some bodies have a fraction and others have none");
  expect_refused({"sphere:1:0"}, 2, "a fraction that is not above 0");
}

TEST_F(Percolate, FilesOfDifferentUnitsDoNotMeetByTheirNumbersAlone) {
  write_file("metres.gltf", tetrahedron_gltf("body.bin"));
  write_file("body.bin", tetrahedron_buffer());
  write_file("centimetres.dae", tetrahedron_dae("centimeter", "0.01"));
  const Words both = {"metres.gltf", "centimetres.dae", "--sizes", "3,4", "--realisations", "5"};
  expect_refused(both, 3, "two files of different units (metres.gltf in m, centimetres.dae in cm)");
  const json found = json_of(with(both, {"--unit", "cm"}));
  EXPECT_NEAR(found["bodies"][0]["volume"].get<double>() / found["bodies"][1]["volume"].get<double>(), 1e6, 1.0);
}

TEST_F(Percolate, RefusesWhatMakesNoSense) {
  expect_refused({"cube:1"}, 2, "did you mean box:A,B,C?");
  expect_refused({"sphere:1", "--sizes", "1"}, 2, "less than two extents");
  expect_refused({"sphere:1", "--sizes", "3,3"}, 2, "a size is given twice");
  expect_refused({"sphere:1", "--sizes", "3,"}, 2, "--sizes");
  expect_refused({"sphere:1", "--sizes", "1e4"}, 3, "give a smaller one");
  expect_refused({"sphere:1", "--realisations", "1"}, 2, "out of range");
  expect_refused({"sphere:1", "--orientations", "fixed:1,0,0,0"}, 2, "about two bodies");
  expect_refused({"sphere:1", "--shell", "-1"}, 2, "a shell below 0");
  expect_refused({"sphere:1", "--gltf", "a.obj"}, 2, "let it end in .glb");
  expect_refused({"sphere:1", "--checkpoint", "-"}, 2, "name a file");
  expect_refused({"needle:1"}, 3, "bodies that never overlap");
  expect_refused({"disc:1", "--orientations", "aligned", "--sizes", "2,3", "--realisations", "2"}, 3,
                 "bodies that never overlap with orientations aligned");
  expect_refused({"box:1,1,2", "--orientations", "aligned", "--sizes", "4"}, 2, "one size says nothing");
  expect_refused({"sphere:1", "--orientations", "bogus"}, 2,
                 "cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE, uniform-angle");
  expect_refused({"sphere:1:1.7e308", "sphere:2:1.7e308"}, 2, "a fraction out of range");
}

// Universal values were once taken for any law.
TEST_F(Percolate, SystemsThatAreNotIsotropicAreToldApart) {
  const Words words = {"box:3,3,1", "--orientations", "aligned", "--sizes", "2,3,5", "--realisations", "400"};
  const json found = json_of(words);
  EXPECT_EQ(found["isotropic"], false);
  EXPECT_EQ(found["threshold_by"], "crossing");
  EXPECT_NEAR(found["eta_c"]["value"], 0.324766, 5.0 * found["eta_c"]["std_error"].get<double>());
  for (const char* axis : {"x", "y", "z"}) {
    EXPECT_TRUE(found["extrapolation"]["probabilities"].contains(axis));
    for (const json& size : found["sizes"]) EXPECT_GT(size["criteria"][axis]["std_error"], 0.0);
  }
  const Finished finished = succeed(with(words, {"--plot", "p.svg"}));
  EXPECT_NE(finished.out.find("are not isotropic, and universal values of R do not hold"), std::string::npos);
  EXPECT_NE(read_file("p.svg").find("fitted values"), std::string::npos);
  EXPECT_EQ(json_of(kSmall)["threshold_by"], "universal-probabilities");
  EXPECT_EQ(json_of({"box:1,1,1", "--orientations", "aligned", "--sizes", "4", "--realisations", "60"})["isotropic"],
            true);
}

// The covariance of a few realisations was inverted, which ended the program or gave errors of no meaning.
TEST_F(Percolate, FewRealisationsAreWrittenAndTellNoThreshold) {
  for (const char* n : {"2", "3", "49"}) {
    const json found = json_of({"box:1,1,1", "--sizes", "2,3,4", "--realisations", n, "--csv", "few.csv"});
    EXPECT_TRUE(found["eta_c"].is_null());
    EXPECT_NE(found["no_threshold_reason"].get<std::string>().find("it takes 50 realisations"), std::string::npos);
    EXPECT_NE(read_file("few.csv").find("# end, crc32 "), std::string::npos);
  }
  EXPECT_FALSE(json_of({"box:1,1,1", "--sizes", "2,3,4", "--realisations", "50"})["eta_c"].is_null());
  // Too short for the largest cube.
  const Finished finished =
      succeed({"sphere:0.5", "--sizes", "4,6,40", "--seconds", "0.1", "--json", "r.json", "--csv", "few.csv"});
  EXPECT_NE(finished.out.find("The threshold is not known"), std::string::npos);
  EXPECT_EQ(json::parse(read_file("r.json"))["complete"], true);
}

// <V_ex> of a law was found after the run, by a clock of its own: five seconds that nothing counted, and an interrupt
// in them left "complete": true.
TEST_F(Percolate, TheTimeAskedForIsThatOfAllOfIt) {
  const Words words = {"cone:2,1", "--orientations", "cone:30", "--sizes", "2,4"};
  const auto start = std::chrono::steady_clock::now();
  const json found = json_of(with(words, {"--seconds", "0.5"}));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20.0);
  EXPECT_GT(found["excluded_volume"], 0.0);
  const Words few = with(words, {"--realisations", "60"});
  EXPECT_EQ(json_of(with(few, {"--threads", "1"}))["excluded_volume"],
            json_of(with(few, {"--threads", "3"}))["excluded_volume"]);
  const Finished finished = run_and_signal(with(words, {"--realisations", "1e7", "--json", "r.json", "--threads", "3"}),
                                           SIGTERM, has_worker_threads);
  EXPECT_EQ(finished.exit_code, 143) << finished.err;
  EXPECT_EQ(json::parse(read_file("r.json"))["complete"], false);
}

// Discs within a degree of each other meet a sixtieth as often as isotropic ones: the limit of bodies took no notice.
TEST_F(Percolate, TheLimitOfBodiesIsByTheLaw) {
  const json found =
      json_of({"disc:1", "--orientations", "cone:3", "--sizes", "2,2.5", "--realisations", "2", "--csv", "c.csv"});
  for (const json& size : found["sizes"]) EXPECT_EQ(size["realisations"], 2);
}

TEST_F(Percolate, DamagedFilesAreRefused) {
  succeed(with(kSmall, {"--quiet", "--csv", "state.csv"}));
  const std::string whole = read_file("state.csv");
  const auto broken = [&](const std::string& content, const std::string& part) {
    write_file("broken.csv", content);
    expect_refused(with(kSmall, {"--resume", "broken.csv"}), 3, part);
  };
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string text = whole;
    return text.replace(text.find(what), what.size(), by);
  };
  const std::size_t row = whole.find("\n1,7,") + 5, comma = whole.find(',', row);
  std::string changed = whole;
  changed[comma - 1] = changed[comma - 1] == '5' ? '6' : '5';
  broken(changed, "the checksum");
  broken(whole + whole, "something stands behind the end");
  broken(whole + "\n", "something stands behind the end");
  broken(whole + "garbage", "something stands behind the end");
  const std::size_t first_of_2 = whole.find("\n2,0,"), end = whole.find("\n# end");
  broken(whole.substr(0, first_of_2) + whole.substr(end), "the checksum");
  const std::size_t seconds = whole.find("# seconds: "), line = whole.find('\n', seconds);
  broken(replaced(whole.substr(seconds, line - seconds), "# seconds: 5abc"), "# seconds: ");
  broken(replaced("# counts: ", "# counts: 9"), "the checksum");
}

TEST_F(Percolate, StandardInputHasAFractionByItsName) {
  expect_refused({"-:0.5", "sphere:0.3:0.5"}, 2, "write /dev/stdin:FRACTION, and its --format");
  write_file("body.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const Finished finished = shell(
      "\"$VEX\" /dev/stdin:0.5 sphere:0.3:0.5 --format off --sizes 2,3 --realisations 2 --quiet --json r.json < "
      "body.off");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(read_file("r.json"))["bodies"][0]["fraction"], 0.5);
}

}  // namespace
}  // namespace vex::golden
