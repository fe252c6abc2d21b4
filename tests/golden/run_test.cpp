// Runs: what fixes the hits, when they stop, and what the estimate is worth.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/numeric/instruction_set.h"
#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Run : public ProgramTest {
 protected:
  json estimate_of(const Words& words) const { return json_of(words).at("estimate"); }
};

TEST_F(Run, TheSeedFixesTheHitsForAnyNumberOfThreads) {
  for (const Words& stop : {Words{"--trials", "30001"}, Words{"--rel-error", "1e-2"}, Words{"--max-trials", "12345"}}) {
    Words words = {"ellipsoid:1,2,3", "box:1,1,2", "--seed", "11"};
    words.insert(words.end(), stop.begin(), stop.end());
    json first;
    for (const char* threads : {"1", "2", "7"}) {
      Words all = words;
      all.insert(all.end(), {"--threads", threads});
      json estimate = estimate_of(all);
      for (const char* time : {"seconds", "trials_per_second"}) estimate.erase(time);
      if (first.is_null()) first = estimate;
      EXPECT_EQ(estimate, first) << threads << " threads";
    }
  }
}

TEST_F(Run, WhatIsPrintedDoesNotChangeTheHits) {
  const Words words = {"box:1,1,2", "--trials", "5000", "--estimator", "hit-or-miss"};
  const json plain = estimate_of(words);
  for (const Words& more : {Words{"--quiet"}, Words{"--cross-check"}, Words{"--max-z", "3"}}) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(estimate_of(all).at("hits"), plain.at("hits")) << more[0];
  }
  EXPECT_EQ(
      run({"box:1,1,2", "--trials", "5000", "--quiet", "--json", "result.json", "--estimator", "hit-or-miss"}).out, "");
  EXPECT_EQ(json::parse(read_file("result.json")).at("estimate").at("hits"), plain.at("hits"));
  const Finished screen = run(words);
  EXPECT_NE(screen.out.find(std::to_string(plain.at("hits").get<int>()) + " / 5000"), std::string::npos) << screen.out;
}

TEST_F(Run, AnotherSeedGivesOtherHits) {
  const Words words = {"box:1,1,1", "--trials", "100000", "--estimator", "hit-or-miss"};
  const auto hits = [&](const char* seed) {
    return estimate_of({"box:1,1,1", "--trials", "100000", "--seed", seed, "--estimator", "hit-or-miss"})
        .at("hits")
        .get<int>();
  };
  EXPECT_EQ(hits("1"), estimate_of(words).at("hits")) << "the default";
  EXPECT_NE(hits("1"), hits("2"));
  EXPECT_NE(hits("2"), hits("18446744073709551615"));
  EXPECT_NE(hits("0"), hits("1"));
}

// One integer for one seed, on every machine. Where these change, stream_version must.
TEST_F(Run, StreamVersionTwoGivesTheseHits) {
  const json document = json_of({"box:1,1,1", "--trials", "1e5", "--estimator", "hit-or-miss"});
  ASSERT_EQ(document.at("stream_version"), 2);
  EXPECT_EQ(document.at("estimate").at("domain"), "box");
  EXPECT_EQ(document.at("estimate").at("hits"), 53834);
  EXPECT_EQ(
      estimate_of({"ellipsoid:1,2,3", "capsule:1,0.25", "--trials", "1e5", "--estimator", "hit-or-miss"}).at("hits"),
      37972);
  EXPECT_EQ(estimate_of({"box:1,1,1", "--orientations", "aligned", "--trials", "1e5", "--estimator", "hit-or-miss"})
                .at("hits"),
            39258);
}

TEST_F(Run, NoInstructionSetChangesAHit) {
  for (const Words& bodies : {Words{"box:1,2,0.3"}, Words{"ellipsoid:1,2,3", "capsule:1,0.25"}, Words{"cone:1,0.5"},
                              Words{sample("icosahedron.obj"), "needle:2"}}) {
    for (const std::string& law : alike<std::string>({"isotropic", "aligned", "cone:20", "onsager:4"})) {
      Words words = bodies;
      words.insert(words.end(), {"--trials", "10000", "--orientations", law, "--no-quick-verdicts", "--isa", "scalar"});
      const json plain = estimate_of(words);
      EXPECT_EQ(plain.at("isa"), "scalar");
      for (const InstructionSet set : instruction_sets()) {
        words.back() = name_of(set);
        const json other = estimate_of(words);
        EXPECT_EQ(other.at("isa"), words.back());
        EXPECT_EQ(other.at("hits"), plain.at("hits")) << bodies[0] << " " << law << " " << words.back();
        EXPECT_EQ(other.at("decided_by"), plain.at("decided_by")) << bodies[0] << " " << law << " " << words.back();
      }
      words.back() = "best";
      EXPECT_EQ(estimate_of(words).at("isa"), name_of(best_instruction_set()));
    }
  }
}

TEST_F(Run, QuickVerdictsChangeNoVerdict) {
  for (const Words& bodies : {Words{"box:1,1,1"}, Words{"ellipsoid:1,2,3", "capsule:1,0.25"}, Words{"sphere:1"},
                              Words{sample("icosahedron.obj"), "box:2,2,2"}}) {
    for (const char* domain : {"ball", "box"}) {
      Words words = bodies;
      words.insert(words.end(), {"--trials", "20000", "--domain", domain});
      const json with = estimate_of(words);
      words.push_back("--no-quick-verdicts");
      const json without = estimate_of(words);
      EXPECT_EQ(without.at("hits"), with.at("hits")) << bodies[0];
      EXPECT_EQ(without.at("decided_by").at("outer_bound"), 0);
      EXPECT_EQ(without.at("decided_by").at("inner_bound"), 0);
      EXPECT_GT(with.at("decided_by").at("inner_bound"), 0);
    }
  }
}

TEST_F(Run, PeersAnswerEveryPoseThemselves) {
  const json ours = estimate_of({"box:1,1,1", "--trials", "20000", "--estimator", "hit-or-miss"});
  const std::vector<std::string> backends = backends_of_this_build();
  for (const std::string& name : backends) {
    const json estimate =
        estimate_of({"box:1,1,1", "--trials", "20000", "--backend", name, "--estimator", "hit-or-miss"});
    EXPECT_EQ(estimate.at("backend"), name);
    if (name != "gjk") {
      EXPECT_EQ(estimate.at("decided_by").at("peer").get<int>() + estimate.at("undecided").get<int>(), 20000);
    }
    EXPECT_NEAR(estimate.at("hits").get<double>(), ours.at("hits").get<double>(), 5.0) << "same poses, " << name;
  }
  for (const char* name : {"ccd-gjk", "ccd-mpr", "ccd", "fcl"}) {
    const Words words = {"box:1,1,1", "--trials", "10", "--backend", name};
    const bool is_built = std::ranges::find(backends, std::string(name) == "ccd" ? "ccd-mpr" : name) != backends.end();
    if (is_built) {
      EXPECT_EQ(run(words).exit_code, 0) << name;
    } else {
      expect_refusal(run(words), 2, "this build is without");
    }
  }
}

TEST_F(Run, APeerWithoutSuchAShapeSaysSoAndStaysOutOfACrossCheck) {
  const std::vector<std::string> backends = backends_of_this_build();
  const bool has_fcl = std::ranges::find(backends, "fcl") != backends.end();
  const json document = json_of({"hemisphere:1", "--trials", "500", "--cross-check"});
  EXPECT_EQ(document.at("cross_check").size() + document.at("cross_check_left_out").size(), backends.size());
  EXPECT_EQ(document.at("cross_check_left_out").size(), has_fcl ? 2u : 1u);
  expect_refusal(run({"hemisphere:1", "--backend", "specialised"}), 2, "specialised has no shape for hemisphere:1");
  expect_refusal(run({"box:1,1,1", "capsule:1,1", "--backend", "specialised"}), 2,
                 "specialised has no test of box and capsule");
  if (has_fcl) {
    expect_refusal(run({"hemisphere:1", "--backend", "fcl"}), 2, "fcl has no shape for hemisphere:1");
    EXPECT_NE(run({"box:1,1,1", "hemisphere:1", "--trials", "500", "--cross-check"}).out.find("left out: fcl"),
              std::string::npos);
  }
}

TEST_F(Run, AProgramThatWasCopiedAloneSaysThatFclIsMissing) {
  const std::vector<std::string> backends = backends_of_this_build();
  if (std::ranges::find(backends, "fcl") == backends.end()) GTEST_SKIP() << "built without FCL";
  std::filesystem::create_directory(path("bin"));
  std::filesystem::copy_file(VEX_MESH_PROGRAM, path("bin/vex_mesh"));
  EXPECT_EQ(shell("bin/vex_mesh box:1,1,1 --trials 1000").exit_code, 0);
  expect_refusal(shell("bin/vex_mesh box:1,1,1 --trials 1000 --backend fcl"), 3, "lib/vex");
}

TEST_F(Run, APairThatExcludesNoVolumeIsReportedWithoutARun) {
  for (const Words& words : {Words{"needle:1", "needle:2"}, Words{"plate:1,2", "disc:1", "--orientations", "aligned"},
                             Words{"needle:1", "--orientations", "aligned", "--trials", "1e10"}}) {
    const json document = json_of(words);
    EXPECT_EQ(document.at("complete"), true);
    EXPECT_EQ(document.at("estimate").at("excluded_volume"), 0.0);
    EXPECT_EQ(document.at("estimate").at("trials"), 0);
    EXPECT_TRUE(document.at("z").is_null());
    EXPECT_NE(document.at("z_reason").get<std::string>().find("no volume"), std::string::npos);
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_NE(finished.out.find("no run: "), std::string::npos) << finished.out;
  }
  EXPECT_GT(estimate_of({"plate:1,2", "needle:1", "--orientations", "aligned", "--trials", "2000", "--estimator",
                         "hit-or-miss"})
                .at("hits"),
            0)
      << "a needle across a plate does";
}

TEST_F(Run, FlatAndRoundedBodiesAgreeWithTheFormula) {
  for (const Words& bodies :
       {Words{"plate:1,2"}, Words{"disc:1", "needle:2"}, Words{"rounded:0.3,plate:1,2"},
        Words{"rounded:0.2," + sample("gem.obj"), "disc:3"}, Words{"cone:1,1", "frustum:1,2,1"}}) {
    Words words = bodies;
    words.insert(words.end(), {"--rel-error", "3e-3"});
    EXPECT_LT(std::fabs(json_of(words).at("z").get<double>()), 4.0) << bodies[0];
  }
  EXPECT_TRUE(json_of({"plate:1,2", "box:1,1,1", "--trials", "100"}).at("formula").at("reduced").is_null());
}

TEST_F(Run, BothDomainsAgreeWithTheFormula) {
  for (const Words& bodies : {Words{"box:1,1,1"}, Words{"ellipsoid:1,2,3"}, Words{"capsule:1,0.25"},
                              Words{"sphere:0.6203504908994", "box:1,1,1"}, Words{sample("gem.obj")}}) {
    for (const char* domain : {"ball", "box", "best"}) {
      Words words = bodies;
      words.insert(words.end(), {"--rel-error", "3e-3", "--domain", domain});
      const json document = json_of(words);
      EXPECT_LT(std::fabs(document.at("z").get<double>()), 4.0) << bodies[0] << " " << domain;
      if (std::string(domain) != "best") {
        EXPECT_EQ(document.at("estimate").at("domain"), domain);
      }
    }
  }
}

TEST_F(Run, StopsAtExactlyTheTrialsAskedFor) {
  for (const char* trials : {"1", "63", "4097", "1e4", "2.5e3"}) {
    const json document = json_of({"box:1,1,1", "--trials", trials});
    EXPECT_EQ(document.at("estimate").at("trials").get<double>(), std::stod(trials));
    EXPECT_EQ(document.at("complete"), true);
  }
}

TEST_F(Run, StopsAtTheRelativeErrorAskedFor) {
  const json estimate = estimate_of({"box:1,1,1", "--rel-error", "1e-2", "--estimator", "hit-or-miss"});
  const double reached = estimate.at("std_error").get<double>() / estimate.at("excluded_volume").get<double>();
  EXPECT_LE(reached, 1e-2);
  EXPECT_GT(reached, 0.8e-2) << "and not much later";
  const auto error_without_rule = [&](const Words& words) {
    const json by_default = estimate_of(words);
    return by_default.at("std_error").get<double>() / by_default.at("excluded_volume").get<double>();
  };
  const Words of_hits = {"box:1,1,1", "--estimator", "hit-or-miss"};
  EXPECT_GT(error_without_rule(of_hits), 0.9e-3);
  for (const Words& words :
       {of_hits, Words{"box:1,1,1"}, Words{sample("gem.obj")}, Words{"box:1,1,1", "--estimator", "radial"},
        Words{"box:1,1,1", "--estimator", "mixed-volume"}}) {
    const double error = error_without_rule(words);
    EXPECT_LE(error, 1e-3) << words.back();
    EXPECT_GT(error, 1e-4) << words.back();
  }
}

TEST_F(Run, TheDefaultEstimatorRunsGjkAndSaysWhatOthersCost) {
  const json document = json_of({"box:1,1,1", "capsule:1,0.25"});
  const json& estimate = document.at("estimate");
  EXPECT_EQ(estimate.at("estimator"), "radial");
  EXPECT_EQ(estimate.at("sequence"), "sobol");
  EXPECT_EQ(estimate.at("backend"), "gjk");
  EXPECT_TRUE(estimate.at("hits").is_null());
  EXPECT_TRUE(estimate.at("sampling_volume").is_null());
  EXPECT_TRUE(estimate.at("domain").is_null());
  EXPECT_EQ(estimate.at("decided_by").at("gjk"), estimate.at("trials"));
  EXPECT_LE(std::fabs(document.at("z").get<double>()), 5.0);
  // Student's t of 31 degrees of freedom.
  const double value = estimate.at("excluded_volume"), error = estimate.at("std_error");
  EXPECT_NEAR(estimate.at("ci95")[0].get<double>(), value - 2.0395134464 * error, 1e-9 * value);
  EXPECT_NEAR(estimate.at("ci95")[1].get<double>(), value + 2.0395134464 * error, 1e-9 * value);
  std::vector<std::string> names;
  for (const json& candidate : document.at("pilot")) {
    names.push_back(candidate.at("estimator"));
    const bool shares_geometry = names.back() == "mixed-volume" || names.back() == "mean-width";
    EXPECT_EQ(candidate.at("runs_gjk"), !shares_geometry);
    EXPECT_GT(candidate.at("seconds_per_trial"), 0.0);
    EXPECT_GT(candidate.at("relative_error"), 0.0);
    EXPECT_GT(candidate.at("seconds_to_this_error"), 0.0);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"radial", "hit-or-miss-fitted", "hit-or-miss", "stratified",
                                             "mixed-volume", "mean-width"}));
  const Finished screen = run({"box:1,1,1", "capsule:1,0.25"});
  EXPECT_NE(screen.out.find("radial, Sobol' points, isotropic orientations, gjk"), std::string::npos) << screen.out;
  EXPECT_NE(screen.out.find("hit-or-miss would have"), std::string::npos) << screen.out;
  EXPECT_NE(screen.out.find("with the formula's geometry"), std::string::npos) << screen.out;
  EXPECT_FALSE(json_of({"box:1,1,1", "--estimator", "radial", "--trials", "4096"}).contains("pilot"));
}

TEST_F(Run, WhatIsAboutPosesIsHitOrMiss) {
  for (const Words& about : {Words{"--verify"}, Words{"--cross-check"}, Words{"--no-quick-verdicts"},
                             Words{"--domain", "ball"}, Words{"--backend", "specialised"}}) {
    Words words = {"box:1,1,1", "--trials", "500"};
    words.insert(words.end(), about.begin(), about.end());
    const json document = json_of(words);
    EXPECT_EQ(document.at("estimate").at("estimator"), "hit-or-miss") << about[0];
    EXPECT_FALSE(document.contains("pilot")) << about[0];
  }
}

// Each by the sequence it has without asking, and by the other one; on one thread and on three.
TEST_F(Run, EveryEstimatorAgreesWithTheFormulaOnAnyNumberOfThreads) {
  for (const char* estimator :
       {"hit-or-miss", "hit-or-miss-fitted", "stratified", "radial", "mixed-volume", "mean-width"}) {
    for (const char* sequence : {"random", "sobol"}) {
      const Words words = {"box:1,2,3",  "cone:1,1", "--estimator", estimator,
                           "--sequence", sequence,   "--trials",    "20000"};
      const json document = json_of(words);
      const json& estimate = document.at("estimate");
      EXPECT_EQ(estimate.at("estimator"), estimator);
      EXPECT_EQ(estimate.at("sequence"), sequence);
      EXPECT_EQ(estimate.at("trials"), 20000);
      EXPECT_LE(std::fabs(document.at("z").get<double>()), 5.0) << estimator << " " << sequence;
      EXPECT_LE(estimate.at("std_error").get<double>(), 0.03 * estimate.at("excluded_volume").get<double>());
      Words again = words;
      again.insert(again.end(), {"--threads", "3"});
      const json other = estimate_of(again);
      for (const char* key : {"excluded_volume", "std_error", "hits", "undecided", "decided_by"}) {
        EXPECT_EQ(other.at(key), estimate.at(key)) << estimator << " " << sequence << " " << key;
      }
    }
  }
}

TEST_F(Run, EveryEstimatorKeepsToTheOrientationsAskedFor) {
  for (const std::string& law : alike<std::string>({"aligned", "fixed:1,2,3,4", "cone:20", "onsager:5"})) {
    for (const char* estimator : {"hit-or-miss-fitted", "stratified", "radial", "mixed-volume"}) {
      const json document = json_of(
          {"capsule:2,0.5", "ellipsoid:1,1,2", "--orientations", law, "--estimator", estimator, "--trials", "30000"});
      if (!document.at("z").is_null()) {
        EXPECT_LE(std::fabs(document.at("z").get<double>()), 5.0) << law << " " << estimator;
      }
    }
  }
  expect_refusal(run({"box:1,2,3", "--estimator", "mean-width", "--orientations", "cone:20"}), 2,
                 "mean widths are of random orientations, not of cone:20 ones");
}

TEST_F(Run, AControlVariateIsNamedAndMakesTheErrorSmaller) {
  const Words words = {"rounded:0.1,box:1,1,1", "--estimator", "radial", "--trials", "65536"};
  Words controlled = words;
  controlled.insert(controlled.end(), {"--control-variate", "box:1,1,1"});
  const json document = json_of(controlled);
  const json& estimate = document.at("estimate");
  EXPECT_LE(std::fabs(document.at("z").get<double>()), 5.0);
  EXPECT_LT(estimate.at("std_error").get<double>(), 0.6 * estimate_of(words).at("std_error").get<double>());
  EXPECT_EQ(estimate.at("control_variate").at("bodies"), json({"box:1,1,1", "box:1,1,1"}));
  EXPECT_NEAR(estimate.at("control_variate").at("excluded_volume").get<double>(), 11.0, 1e-13);
  EXPECT_NE(run(controlled).out.find("control variate                   box:1,1,1, <V_ex> = 11 by the formula"),
            std::string::npos);
  EXPECT_EQ(estimate_of({"box:1,1,1", "--control-variate", "box:1,1,0.9", "--trials", "100"}).at("estimator"),
            "radial");
  expect_refusal(run({"box:1,1,1", "--control-variate", "sphere:1", "--estimator", "hit-or-miss"}), 2,
                 "hits and misses have no control variate");
  expect_refusal(run({"box:1,1,1", "--control-variate", "sphere:1", "--orientations", "aligned"}), 2,
                 "holds for random orientations");
  expect_refusal(run({"box:1,1,1", "--control-variate", "sphere:1", "--control-variate", "sphere:2",
                      "--control-variate", "sphere:3"}),
                 2, "at most two");
  expect_refusal(run({"box:1,1,1", "--control-variate", "missing.obj"}), 3, "missing.obj");
}

TEST_F(Run, AnErrorBelowAnEstimatorsRoundingEndsIncomplete) {
  const Finished finished = run({"sphere:1", "--estimator", "radial", "--rel-error", "1e-12", "--json", "r.json"});
  const json document = json::parse(read_file("r.json"));
  EXPECT_EQ(document.at("complete"), false);
  EXPECT_EQ(document.at("estimate").at("stopped_by"), "rounding");
  const json& estimate = document.at("estimate");
  EXPECT_LE(estimate.at("std_error").get<double>(), 3e-7 * estimate.at("excluded_volume").get<double>())
      << "not before rounding is most of the error";
  EXPECT_NE(finished.out.find("rounding alone"), std::string::npos) << finished.out;
}

TEST_F(Run, FewerTrialsThanScramblingsClaimNoErrorAndNoAgreement) {
  for (const char* estimator : {"radial", "mixed-volume", "mean-width"}) {
    for (const char* trials : {"1", "2", "31"}) {
      const json document = json_of({"box:1,2,3", "--estimator", estimator, "--trials", trials});
      EXPECT_TRUE(document.at("estimate").at("std_error").is_null()) << estimator << " " << trials;
      EXPECT_TRUE(document.at("z").is_null());
      EXPECT_TRUE(document.at("z_reason").is_string());
    }
  }
  const Finished one = run({"box:1,2,3", "--estimator", "radial", "--sequence", "random", "--trials", "1"});
  EXPECT_NE(one.out.find("no error is known"), std::string::npos) << one.out;
}

TEST_F(Run, WhatRunsNoGjkDoesNotSayThatItDoes) {
  const json estimate = estimate_of({"box:1,1,1", "--estimator", "mean-width", "--trials", "2048"});
  EXPECT_EQ(estimate.at("backend"), "none");
  EXPECT_EQ(estimate.at("decided_by").at("gjk"), 0);
  EXPECT_EQ(estimate.at("decided_by").at("support_values"), 2048);
}

TEST_F(Run, RaysThatDoublePrecisionDoesNotTellApartAreRefused) {
  expect_refusal(run({"capsule:1,1e-8", "--estimator", "radial"}), 2, "thinner than 2^-22 of its length");
  EXPECT_NE(estimate_of({"capsule:1,1e-8", "--trials", "1000"}).at("estimator"), "radial");
  EXPECT_EQ(run({"disc:1", "needle:1", "--trials", "1000", "--estimator", "radial"}).exit_code, 0)
      << "not thin together";
  expect_refusal(run({"sphere:1", "sphere:2", "--estimator", "stratified"}), 2, "there is nothing");
}

TEST_F(Run, DoesNotTrustARelativeErrorOfFewHitsOrFewMisses) {
  const json rare_hits = estimate_of({"box:1,1e-3,1e-3", "--domain", "ball", "--rel-error", "1"});
  EXPECT_GE(rare_hits.at("hits"), 100);
  EXPECT_GT(rare_hits.at("trials"), 4096);
  const json rare_misses = estimate_of({"ellipsoid:1,1,0.999", "--domain", "ball", "--rel-error", "1"});
  EXPECT_GE(rare_misses.at("trials").get<int>() - rare_misses.at("hits").get<int>(), 100);
  EXPECT_GT(rare_misses.at("trials"), 4096);
}

TEST_F(Run, StopsAfterTheTimeAskedFor) {
  const json document = json_of({"box:1,1,1", "--seconds", "0.3"});
  EXPECT_EQ(document.at("complete"), true);
  EXPECT_GE(document.at("seconds"), 0.3);
  EXPECT_LT(document.at("seconds"), 5.0);
  EXPECT_GT(estimate_of({"box:1,1,1", "--seconds", "1e-9"}).at("trials"), 0) << "at least one block";
}

TEST_F(Run, WhicheverRuleComesFirstStopsIt) {
  const json by_trials = json_of({"box:1,1,1", "--trials", "3000", "--rel-error", "1e-9", "--seconds", "1000"});
  EXPECT_EQ(by_trials.at("estimate").at("trials"), 3000);
  EXPECT_EQ(by_trials.at("estimate").at("stopped_by"), "trials");
  const json by_error = json_of({"box:1,1,1", "--trials", "1e10", "--rel-error", "0.05", "--seconds", "1000"});
  EXPECT_EQ(by_error.at("estimate").at("stopped_by"), "rel-error");
  const json by_time = json_of({"box:1,1,1", "--trials", "1e11", "--rel-error", "1e-9", "--seconds", "0.1"});
  EXPECT_EQ(by_time.at("estimate").at("stopped_by"), "seconds");
  for (const json& document : {by_trials, by_error, by_time}) EXPECT_EQ(document.at("complete"), true);
}

TEST_F(Run, MaxTrialsEndsItIncomplete) {
  for (const Words& rule :
       {Words{"--rel-error", "1e-9"}, Words{"--trials", "1e6"}, Words{"--seconds", "1000"}, Words{}}) {
    Words words = {"box:1,1,1", "--max-trials", "5000", "--estimator", "hit-or-miss"};
    words.insert(words.end(), rule.begin(), rule.end());
    const json document = json_of(words);
    EXPECT_EQ(document.at("estimate").at("trials"), 5000);
    EXPECT_EQ(document.at("complete"), false);
  }
  EXPECT_EQ(json_of({"box:1,1,1", "--max-trials", "5000", "--trials", "5000"}).at("complete"), true);
  EXPECT_NE(run({"box:1,1,1", "--max-trials", "5000", "--estimator", "hit-or-miss"}).out.find("incomplete"),
            std::string::npos);
}

TEST_F(Run, ADisagreementExitsWithFourAndStillReports) {
  const Finished finished = run({"box:1,1,1", "--trials", "20000", "--max-z", "1e-9", "--json", "result.json"});
  EXPECT_EQ(finished.exit_code, 4) << finished.err;
  EXPECT_NE(finished.out.find("DISAGREE"), std::string::npos) << finished.out;
  EXPECT_EQ(json::parse(read_file("result.json")).at("estimate").at("trials"), 20000);
  const Finished document = run({"box:1,1,1", "--trials", "20000", "--max-z", "1e-9", "--json", "-"});
  EXPECT_EQ(document.exit_code, 4);
  EXPECT_TRUE(json::accept(document.out));
  for (const std::string& name : backends_of_this_build()) {
    if (name.rfind("ccd", 0) != 0) continue;
    // A backend that is wrong is found out: libccd on bodies smaller than its tolerances.
    EXPECT_EQ(run({"box:1e-9,1e-9,1e-9", "--trials", "5000", "--backend", name}).exit_code, 4);
  }
  EXPECT_EQ(run({"box:1e-9,1e-9,1e-9", "--trials", "5000"}).exit_code, 0);
}

TEST_F(Run, SizesFarFromOneWork) {
  for (const char* body : {"box:1e-40,2e-40,3e-40", "box:1e40,2e40,3e40", "ellipsoid:1e-44,1e-44,2e-44",
                           "capsule:1e30,1e-10", "sphere:1e44"}) {
    const json document = json_of({body, "--trials", "5000", "--domain", "ball"});
    if (document.at("z").is_number()) {
      EXPECT_LT(std::fabs(document.at("z").get<double>()), 5.0) << body;
    }
    EXPECT_GT(document.at("estimate").at("std_error"), 0.0);
  }
}

// A prism over a regular polygon of circumradius 1/2, as an .obj file.
std::string prism_of(int n_sides, double radius, double thickness) {
  std::ostringstream file;
  file.precision(17);
  for (const double z : {-0.5 * thickness, 0.5 * thickness}) {
    for (int k = 0; k < n_sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / n_sides;
      file << "v " << radius * std::cos(angle) << " " << radius * std::sin(angle) << " " << z << "\n";
    }
  }
  file << "f";
  for (int k = n_sides; k > 0; --k) file << " " << k;
  file << "\nf";
  for (int k = 1; k <= n_sides; ++k) file << " " << n_sides + k;
  file << "\n";
  for (int k = 1; k <= n_sides; ++k) {
    const int next = k % n_sides + 1;
    file << "f " << k << " " << next << " " << n_sides + next << " " << n_sides + k << "\n";
  }
  return file.str();
}

TEST_F(Run, ExactAveragesOfThinBodiesAreRight) {
  // Faces were once picked by area alone, and a rim of a millionth of it never; the mean curvature of a thin ellipsoid
  // was sampled by uniform normals, of which none met the narrow band that it faces.
  write_file("disc.obj", prism_of(200, 0.5, 1e-6));
  write_file("rod.obj", prism_of(200, 5e-7, 1.0));
  for (const Words& words :
       alike<Words>({Words{"disc.obj", "plate:1,1", "--orientations", "cone:0"},
                     Words{"disc.obj", "--orientations", "cone:1e-6"}, Words{"rod.obj", "--orientations", "cone:0"},
                     Words{"rod.obj", "--orientations", "onsager:1e10"},
                     Words{"rounded:0.5,ellipsoid:1e-9,1e-9,1", "box:1,1,1", "--orientations", "fixed:1,0.3,0.2,0.5"},
                     Words{"rounded:0.5,ellipsoid:1,1e-6,1", "box:1,1,1", "--orientations", "fixed:1,0.3,0.2,0.5"},
                     Words{"rounded:0.1,ellipsoid:1e-6,1e-6,1", "capsule:1,0.1", "--orientations", "cone:20"},
                     Words{"rounded:0.1,ellipsoid:1,1e-3,1e-6", "capsule:1,0.1", "--orientations", "cone:20"}})) {
    Words all = words;
    all.insert(all.end(), {"--estimator", "hit-or-miss-fitted", "--trials", "30000"});
    const json document = json_of(all);
    const double exact = document.at("exact_average").at("excluded_volume");
    EXPECT_LT(document.at("exact_average").at("error").get<double>(), 2e-3 * exact) << words[0];
    ASSERT_TRUE(document.at("z").is_number()) << words[0];
    EXPECT_LT(std::fabs(document.at("z").get<double>()), 4.0) << words[0] << " " << words.back();
  }
}

TEST_F(Run, AFittedDomainFitsStrips) {
  // A strip is long and flat: with its short axis alone a needle beside it hit once in a thousand trials.
  for (const Words& words : {Words{"needle:1", "plate:1,1e-3"}, Words{"needle:1", "plate:1,1e-6"},
                             Words{"plate:1,1e-4", "plate:1,1e-4", "--orientations", "cone:10"},
                             Words{"box:1,1e-4,1e-12", "needle:1"}, Words{"capsule:1,1e-4", "plate:1,1e-4"}}) {
    Words all = words;
    all.insert(all.end(), {"--estimator", "hit-or-miss-fitted", "--trials", "20000"});
    const json document = json_of(all);
    EXPECT_GT(document.at("estimate").at("hits").get<double>(), 10000.0) << words[0] << " " << words[1];
    EXPECT_LT(std::fabs(document.at("z").get<double>()), 4.0) << words[0] << " " << words[1];
  }
}

TEST_F(Run, EveryVerdictIsProvenAgain) {
  write_file("rod.obj", cube_obj());
  for (const Words& words : {Words{"box:1,1,1"}, Words{"rod.obj", "ellipsoid:1,2,3"}, Words{"capsule:1,0.5", "disc:1"},
                             Words{"cone:1,1", "box:1,1,1", "--backend", "ccd-gjk"}}) {
    Words all = words;
    all.insert(all.end(), {"--trials", "2000", "--verify"});
    const json document = json_of(all);
    EXPECT_EQ(document.at("verification").at("proven"), 2000) << words[0];
    EXPECT_EQ(document.at("verification").at("unproven"), 0) << words[0];
    EXPECT_TRUE(document.at("verification").at("faults").empty());
  }
  EXPECT_FALSE(json_of({"box:1,1,1", "--trials", "100"}).contains("verification"));
  const Finished run_of_program = run({"box:1,1,1", "--trials", "500", "--verify"});
  EXPECT_EQ(run_of_program.exit_code, 0);
  EXPECT_NE(run_of_program.out.find("500 verdicts proven again, in exact arithmetic; 0 not"), std::string::npos);
}

}  // namespace
}  // namespace vex::golden
