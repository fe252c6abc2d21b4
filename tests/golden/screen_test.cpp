// What a person sees: the report, the help, the progress bar.
#include <cmath>
#include <cstdio>
#include <regex>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Screen : public ProgramTest {};

std::string twelve_digits(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.12g", value);
  // 1e+20 is written 1e20.
  return std::regex_replace(std::regex_replace(text, std::regex("e\\+0*"), "e"), std::regex("e-0+"), "e-");
}

/// The estimate as it stands in the report: 11.0007(10) or 1.05(14)e-26.
struct WithError {
  double value = NAN, error = NAN, unit = NAN;
  std::string error_digits;
};

WithError estimate_in(const std::string& report) {
  const std::string part = report.substr(std::min(report.find("Monte Carlo"), report.size()));
  std::smatch match;
  WithError found;
  if (!std::regex_search(part, match,
                         std::regex("<V_ex>, Monte Carlo +([0-9]+(\\.([0-9]+))?)\\(([0-9]+)\\)(e(-?[0-9]+))?"))) {
    return found;
  }
  const double scale = match[6].matched ? std::pow(10.0, std::stod(match[6])) : 1.0;
  found.unit = scale * std::pow(10.0, -static_cast<double>(match[3].length()));
  found.value = std::stod(match[1]) * scale;
  found.error_digits = match[4];
  found.error = std::stod(match[4]) * found.unit;
  return found;
}

TEST_F(Screen, TheReportHoldsTheNumbersOfTheDocument) {
  for (const Words& bodies : {Words{"box:1,2,3"}, Words{"ellipsoid:1,2,3", "sphere:0.5"},
                              Words{sample("icosahedron.obj")}, Words{"capsule:1e20,2e19"}}) {
    Words words = bodies;
    words.insert(words.end(), {"--trials", "5000", "--json", "result.json", "--estimator", "hit-or-miss"});
    const Finished finished = run(words);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const json document = json::parse(read_file("result.json"));
    const auto expect_shown = [&](const std::string& text) {
      EXPECT_NE(finished.out.find(text), std::string::npos) << text << " is missing:\n" << finished.out;
    };
    for (const json& body : document.at("bodies")) {
      expect_shown(body.at("source"));
      for (const char* key : {"volume", "surface_area", "integrated_mean_curvature", "circumradius", "inradius"}) {
        expect_shown(twelve_digits(body.at(key)));
      }
    }
    for (const char* key : {"excluded_volume", "reduced", "b2"})
      expect_shown(twelve_digits(document.at("formula").at(key)));
    const json& estimate = document.at("estimate");
    expect_shown(std::to_string(estimate.at("hits").get<int>()) + " / 5000");
    expect_shown("seed 1");
    expect_shown("hit-or-miss");
    const WithError shown = estimate_in(finished.out);
    EXPECT_NEAR(shown.value, estimate.at("excluded_volume"), 0.51 * shown.unit);
    EXPECT_NEAR(shown.error, estimate.at("std_error"), 0.51 * shown.unit);
    EXPECT_EQ(shown.error_digits.size(), 2u) << finished.out;
    EXPECT_EQ(finished.err, "");
  }
}

TEST_F(Screen, TheErrorReadsWellAtEveryScaleAndPrecision) {
  for (const char* body : {"box:1e-30,1e-30,1e-30", "box:1e-3,1e-3,1e-3", "box:.3,.3,.3", "box:1,1,1", "box:7,8,9",
                           "box:1e2,1e2,1e2", "box:1e4,1e4,1e4", "box:1e30,1e30,1e30", "box:1,1,1e-6", "sphere:1"}) {
    for (const char* trials : {"1", "2", "10", "100", "1000", "12345", "200000"}) {
      const Finished finished = run({body, "--trials", trials, "--json", "result.json", "--estimator", "hit-or-miss"});
      const json estimate = json::parse(read_file("result.json")).at("estimate");
      const WithError shown = estimate_in(finished.out);
      EXPECT_NEAR(shown.value, estimate.at("excluded_volume"), 0.51 * shown.unit) << finished.out;
      EXPECT_NEAR(shown.error, estimate.at("std_error"), 0.51 * shown.unit) << finished.out;
      EXPECT_EQ(shown.error_digits.size(), 2u) << finished.out;
      for (const char* word : {"nan", "inf", "-0 ", "-0,", "(-0", "e+", "e-0"}) {
        if (std::string(word) == "inf" && std::string(trials) == "1") continue;
        EXPECT_EQ(finished.out.find(std::string(" ") + word), std::string::npos) << word << "\n" << finished.out;
      }
    }
  }
}

TEST_F(Screen, TheSecondBodyIsNotRepeated) {
  EXPECT_NE(run({"box:1,2,3", "--trials", "10"}).out.find("the same body"), std::string::npos);
  const std::string two = run({"box:1,2,3", "sphere:1", "--trials", "10"}).out;
  EXPECT_EQ(two.find("the same body"), std::string::npos);
  EXPECT_NE(two.find("B  sphere:1"), std::string::npos);
}

TEST_F(Screen, TheHelpListsEveryOption) {
  const Finished help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* option :
       {"--help",       "--version",          "--json FILE",   "--quiet",         "--seed",
        "--threads",    "--trials",           "--rel-error",   "--seconds",       "--max-trials",
        "--max-z",      "--estimator",        "--sequence",    "--domain",        "--no-quick-verdicts",
        "--isa",        "--backend",          "--cross-check", "--verify",        "--orientations",
        "--checkpoint", "--checkpoint-every", "--first-trial", "--resume",        "--convex-tolerance",
        "--hull",       "--unit-volume",      "--scale",       "--dump-vertices", "sphere:R",
        "box:A,B,C",    "ellipsoid:A,B,C",    "capsule:L,R",   "Exit codes"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  EXPECT_EQ(run({"-h"}).out, help.out);
  EXPECT_EQ(run({"box:1,1,1", "--help"}).out, help.out);
}

TEST_F(Screen, TheVersionIsOneLine) {
  const Finished version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(std::regex_match(version.out, std::regex("vex_mesh [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << version.out;
  EXPECT_EQ(version.out, "vex_mesh " + json_of({"box:1,1,1", "--trials", "1"}).at("version").get<std::string>() + "\n");
}

TEST_F(Screen, TheProgressBarIsDrawnOnATerminalAndErased) {
  for (const int width : {80, 132, 50, 20, 0}) {
    const auto columns = static_cast<unsigned short>(width);
    const Finished finished = run_on_terminal({"box:1,1,1", "--seconds", "1"}, columns);
    EXPECT_EQ(finished.exit_code, 0);
    const std::string erase = "\r\033[K";
    ASSERT_EQ(finished.out.rfind(erase, 0), 0u) << finished.out.substr(0, 200);
    std::size_t n_drawn = 0;
    std::string last;
    std::size_t at = 0;
    while (true) {
      const std::size_t start = at + erase.size();
      const std::size_t next = finished.out.find(erase, start);
      if (next == std::string::npos) {
        last = finished.out.substr(start);
        break;
      }
      const std::string line = finished.out.substr(start, next - start);
      ++n_drawn;
      EXPECT_LT(line.size(), columns == 0 ? 80u : columns) << "it would wrap: " << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
      if (columns >= 50) {
        EXPECT_TRUE(
            std::regex_search(line, std::regex("[0-9]+ %  [0-9]+:[0-9][0-9] left  .* (trials|values)  [0-9.e]+/s")))
            << line;
      }
      if (columns >= 80) {
        EXPECT_TRUE(std::regex_search(line, std::regex("^\\[#* *\\] .*rel\\. error"))) << line;
      }
      at = next;
    }
    EXPECT_GE(n_drawn, 1u);
    EXPECT_LE(n_drawn, 12u) << "no more than ten a second";
    EXPECT_EQ(last.rfind("A  box:1,1,1", 0), 0u) << "the report follows on the erased line: " << last;
  }
}

TEST_F(Screen, NoProgressBarWhereNobodyLooks) {
  EXPECT_EQ(run({"box:1,1,1", "--seconds", "0.4"}).err, "");
  EXPECT_EQ(run_on_terminal({"box:1,1,1", "--seconds", "0.4", "--quiet"}, 80).out, "");
  EXPECT_EQ(run_on_terminal({"box:1,1,1", "--trials", "10"}, 80).out.find('\033'), std::string::npos)
      << "it is over at once";
}

TEST_F(Screen, WithTheDocumentOnStandardOutputTheBarIsStillOnTheTerminal) {
  // Standard output goes to a file, standard error stays on the terminal.
  const std::string terminal = run_on_terminal({"box:1,1,1", "--seconds", "0.5", "--json", "result.json"}, 80).out;
  EXPECT_NE(terminal.find("/s"), std::string::npos);
  EXPECT_TRUE(json::accept(read_file("result.json")));
}

}  // namespace
}  // namespace vex::golden
