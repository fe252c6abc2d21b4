// The JSON document: every key of the documentation, with its type and meaning, and a file that is whole or not there.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Document : public ProgramTest {};

std::uint64_t count(const json& value) { return value.get<std::uint64_t>(); }
double number(const json& value) { return value.get<double>(); }

void expect_body(const json& body) {
  EXPECT_TRUE(body.at("source").is_string());
  EXPECT_TRUE(body.at("kind").is_string());
  for (const char* key :
       {"volume", "surface_area", "integrated_mean_curvature", "mean_radius", "circumradius", "inradius"}) {
    EXPECT_TRUE(body.at(key).is_number()) << key;
    EXPECT_GT(number(body.at(key)), 0.0) << key;
  }
  ASSERT_EQ(body.at("centre").size(), 3u);
  for (const json& coordinate : body.at("centre")) EXPECT_TRUE(coordinate.is_number());
  EXPECT_EQ(body.at("convex"), true);
  EXPECT_TRUE(body.at("reflex_depth").is_number());
  EXPECT_TRUE(body.at("welded_vertices").is_number_unsigned());
  EXPECT_TRUE(body.at("hull_added_volume").is_number());
  EXPECT_TRUE(body.at("dropped_vertices").is_number_unsigned());
  EXPECT_TRUE(body.at("unit").is_null());
  EXPECT_EQ(body.at("coordinate_rounding").is_null(), body.at("kind") != "polyhedron");
  EXPECT_NEAR(number(body.at("mean_radius")), number(body.at("integrated_mean_curvature")) / (4.0 * M_PI), 1e-14);
  EXPECT_LE(number(body.at("inradius")), number(body.at("circumradius")));
}

void expect_tally(const json& estimate) {
  const std::uint64_t trials = count(estimate.at("trials"));
  const std::uint64_t hits = count(estimate.at("hits"));
  std::uint64_t decided = 0;
  for (const char* key : {"outer_bound", "inner_bound", "gjk", "double_double", "exact", "peer"}) {
    decided += count(estimate.at("decided_by").at(key));
  }
  EXPECT_EQ(estimate.at("decided_by").size(), 6u);
  EXPECT_EQ(decided + count(estimate.at("undecided")), trials);
  EXPECT_LE(hits, trials);
  EXPECT_LE(count(estimate.at("decided_by").at("inner_bound")), hits);
  EXPECT_LE(count(estimate.at("decided_by").at("outer_bound")), trials - hits);
  const double value = number(estimate.at("excluded_volume"));
  const double middle = (static_cast<double>(hits) + 0.5 * static_cast<double>(count(estimate.at("undecided")))) /
                        static_cast<double>(trials);
  EXPECT_NEAR(value, number(estimate.at("sampling_volume")) * middle, 1e-14 * value);
  EXPECT_GT(number(estimate.at("std_error")), 0.0);
  ASSERT_EQ(estimate.at("ci95").size(), 2u);
  EXPECT_LE(number(estimate.at("ci95")[0]), value);
  EXPECT_GE(number(estimate.at("ci95")[1]), value);
  EXPECT_GT(number(estimate.at("seconds")), 0.0);
  EXPECT_GT(number(estimate.at("trials_per_second")), 0.0);
}

TEST_F(Document, HasEveryKeyForAPairOfNamedBodies) {
  const json document = json_of({"box:1,2,3", "capsule:1,0.25", "--trials", "20000", "--seed", "7", "--threads", "2",
                                 "--estimator", "hit-or-miss"});
  EXPECT_TRUE(document.at("version").is_string());
  EXPECT_TRUE(document.at("stream_version").is_number_unsigned());
  EXPECT_NE(document.at("command").get<std::string>().find("box:1,2,3 capsule:1,0.25 --trials 20000"),
            std::string::npos);
  EXPECT_EQ(document.at("seed"), 7);
  EXPECT_EQ(document.at("threads"), 2);
  EXPECT_EQ(document.at("complete"), true);
  EXPECT_GT(number(document.at("seconds")), 0.0);
  ASSERT_EQ(document.at("bodies").size(), 2u);
  for (const json& body : document.at("bodies")) {
    expect_body(body);
    EXPECT_EQ(body.at("reflex_depth"), 0.0);
    EXPECT_EQ(body.at("welded_vertices"), 0);
    EXPECT_EQ(body.at("hull_added_volume"), 0.0);
  }
  EXPECT_EQ(document.at("bodies")[0].at("source"), "box:1,2,3");
  EXPECT_EQ(document.at("bodies")[0].at("kind"), "box");
  EXPECT_EQ(document.at("bodies")[1].at("kind"), "capsule");

  const json& a = document.at("bodies")[0];
  const json& b = document.at("bodies")[1];
  const json& formula = document.at("formula");
  const double v_a = number(a.at("volume")), v_b = number(b.at("volume"));
  const double expected = v_a + v_b +
                          (number(a.at("integrated_mean_curvature")) * number(b.at("surface_area")) +
                           number(b.at("integrated_mean_curvature")) * number(a.at("surface_area"))) /
                              (4.0 * M_PI);
  EXPECT_NEAR(number(formula.at("excluded_volume")), expected, 1e-13 * expected);
  EXPECT_NEAR(number(formula.at("reduced")), expected / std::sqrt(v_a * v_b), 1e-12);
  EXPECT_NEAR(number(formula.at("b2")), 0.5 * expected, 1e-13 * expected);

  const json& estimate = document.at("estimate");
  EXPECT_EQ(estimate.at("estimator"), "hit-or-miss");
  EXPECT_EQ(estimate.at("sequence"), "random");
  EXPECT_EQ(estimate.at("backend"), "gjk");
  EXPECT_EQ(estimate.at("orientations"), "isotropic");
  EXPECT_EQ(estimate.at("trials"), 20000);
  expect_tally(estimate);
  const double z = (number(estimate.at("excluded_volume")) - number(formula.at("excluded_volume"))) /
                   number(estimate.at("std_error"));
  EXPECT_NEAR(number(document.at("z")), z, 1e-9);
  EXPECT_FALSE(document.contains("disagreements"));
}

TEST_F(Document, DescribesAMesh) {
  write_file("cube.obj", cube_obj());
  const json document = json_of({"cube.obj", "--trials", "1000", "--estimator", "hit-or-miss"});
  const json& body = document.at("bodies")[0];
  expect_body(body);
  EXPECT_EQ(body.at("source"), "cube.obj");
  EXPECT_EQ(body.at("kind"), "polyhedron");
  EXPECT_EQ(body.at("vertices"), 8);
  EXPECT_EQ(body.at("faces"), 6);
  EXPECT_NEAR(number(body.at("volume")), 1.0, 1e-15);
  EXPECT_NEAR(number(body.at("surface_area")), 6.0, 1e-14);
  EXPECT_NEAR(number(body.at("integrated_mean_curvature")), 3.0 * M_PI, 1e-14);
  EXPECT_EQ(body.at("coordinates"), "doubles of the file") << "the report says what the coordinates are";
  EXPECT_GT(number(body.at("coordinate_rounding")), 0.0);
  EXPECT_LT(number(body.at("coordinate_rounding")), 1e-15);
  EXPECT_EQ(document.at("bodies")[1], body);
  expect_tally(document.at("estimate"));
}

TEST_F(Document, ListsAPolytopesVerticesExactlyIfAsked) {
  const json document = json_of({"dodecahedron:0.7", "sphere:1", "--trials", "10", "--dump-vertices"});
  const json& vertices = document.at("bodies")[0].at("vertex_coordinates");
  EXPECT_EQ(vertices.size(), 20u);
  EXPECT_EQ(document.at("bodies")[0].at("vertices"), 20);
  EXPECT_EQ(document.at("bodies")[0].at("faces"), 12);
  EXPECT_EQ(document.at("bodies")[1].at("vertex_coordinates").size(), 0u) << "a ball has none";
  EXPECT_TRUE(document.at("bodies")[1].at("vertices").is_null());
  double farthest = 0.0;
  for (const json& vertex : vertices) {
    double sum_sq = 0.0;
    for (const json& coordinate : vertex) {
      const std::string text = coordinate;
      EXPECT_NE(text.find("0x"), std::string::npos) << text;
      sum_sq += std::pow(std::strtod(text.c_str(), nullptr), 2);
    }
    farthest = std::max(farthest, std::sqrt(sum_sq));
  }
  EXPECT_NEAR(farthest, number(document.at("bodies")[0].at("circumradius")), 1e-14);
  const Finished finished = run({"plate:0.5,3", "--trials", "10", "--dump-vertices"});
  EXPECT_NE(finished.out.find("-0x1p-2 0x1.8p+0 0x0p+0"), std::string::npos) << finished.out;
  EXPECT_FALSE(json_of({"box:1,1,1", "--trials", "10"}).at("bodies")[0].contains("vertex_coordinates"));
}

TEST_F(Document, NumbersHaveFullPrecision) {
  const Finished finished = run({"box:1,1,0.1", "--trials", "777", "--json", "-"});
  const json document = json::parse(finished.out);
  for (const char* key : {"\"integrated_mean_curvature\": ", "\"std_error\": ", "\"sampling_volume\": ", "\"z\": "}) {
    const std::size_t at = finished.out.find(key);
    ASSERT_NE(at, std::string::npos) << key;
    const char* const text = finished.out.c_str() + at + std::string(key).size();
    const std::size_t length = std::string(text).find_first_of(",\n");
    const double value = std::strtod(text, nullptr);
    char shortest[64];
    bool needs_16 = true;
    std::snprintf(shortest, sizeof shortest, "%.14e", value);
    needs_16 = std::strtod(shortest, nullptr) != value;
    if (needs_16) {
      EXPECT_GE(length, 16u) << key << std::string(text, length);
    }
  }
  EXPECT_EQ(number(document.at("bodies")[0].at("integrated_mean_curvature")), M_PI * 2.1);
}

TEST_F(Document, WhereTheFormulaDoesNotHoldItSaysWhyAndComparesWithTheExactAverage) {
  const json document = json_of({"box:1,1,1", "--orientations", "aligned", "--rel-error", "1e-2"});
  EXPECT_TRUE(document.at("formula").is_null());
  EXPECT_NE(document.at("formula_reason").get<std::string>().find("aligned"), std::string::npos);
  EXPECT_NEAR(number(document.at("exact_average").at("excluded_volume")), 8.0, 1e-11);
  EXPECT_LT(number(document.at("exact_average").at("error")), 1e-10);
  EXPECT_LT(std::fabs(number(document.at("z"))), 4.0);
  EXPECT_EQ(document.at("estimate").at("orientations"), "aligned");
  const double error = number(document.at("estimate").at("std_error"));
  EXPECT_NEAR(number(document.at("estimate").at("excluded_volume")), 8.0, 4.0 * error);

  const json cone = json_of({"cylinder:1,0.5", sample("gem.obj"), "--orientations", "cone:40", "--rel-error", "1e-2"});
  EXPECT_TRUE(cone.at("formula").is_null());
  const double average_error = number(cone.at("exact_average").at("error"));
  EXPECT_GT(average_error, 0.0);
  EXPECT_LT(average_error, 1e-3 * number(cone.at("exact_average").at("excluded_volume")));
  EXPECT_LT(std::fabs(number(cone.at("z"))), 4.0);
  EXPECT_FALSE(json_of({"box:1,1,1", "--trials", "100"}).contains("exact_average")) << "the formula is better";
}

TEST_F(Document, EveryOrientationLawIsNamedAsItWasWritten) {
  for (const auto& [written, named] : std::initializer_list<std::pair<const char*, const char*>>{
           {"isotropic", "isotropic"},
           {"aligned", "aligned"},
           {"fixed:1,0,0,0", "fixed:1,0,0,0"},
           {"fixed:-2e-3,.5,1e300,1e-320", "fixed:-0.002,0.5,1e+300,1e-320"},
           {"cone:0", "cone:0"},
           {"cone:30", "cone:30"},
           {"cone:90", "cone:90"},
           {"onsager:0", "onsager:0"},
           {"onsager:0.1", "onsager:0.1"},
           {"onsager:1e308", "onsager:1e+308"}}) {
    const json document =
        json_of({"capsule:1,0.25", "--orientations", written, "--trials", "5000", "--estimator", "hit-or-miss"});
    const json& estimate = document.at("estimate");
    EXPECT_EQ(estimate.at("orientations"), named);
    expect_tally(estimate);
    EXPECT_EQ(document.at("formula").is_null(), std::string(written) != "isotropic") << written;
    if (document.at("formula").is_null()) {
      EXPECT_NE(document.at("formula_reason").get<std::string>().find(named), std::string::npos) << written;
    }
    // Between parallel and crossed capsules.
    const double parallel = 4.0 * M_PI / 3.0 * 0.125 + M_PI * 0.25 * 2.0;
    EXPECT_GE(number(estimate.at("excluded_volume")), parallel - 5.0 * number(estimate.at("std_error"))) << written;
    EXPECT_LE(number(estimate.at("excluded_volume")), parallel + 1.0 + 5.0 * number(estimate.at("std_error")))
        << written;
  }
}

TEST_F(Document, TheFittedEstimatorSaysWhatItSampled) {
  const Words words = {"box:1,1,0.001", "capsule:2,0.01", "--estimator", "hit-or-miss-fitted", "--trials", "20000"};
  const json document = json_of(words);
  const json& estimate = document.at("estimate");
  EXPECT_EQ(estimate.at("estimator"), "hit-or-miss-fitted");
  EXPECT_EQ(estimate.at("domain"), "fitted");
  EXPECT_EQ(estimate.at("trials"), 20000);
  std::uint64_t decided = count(estimate.at("undecided"));
  for (const json& n : estimate.at("decided_by")) decided += count(n);
  EXPECT_EQ(decided, 20000u);
  const double value = number(estimate.at("excluded_volume")), error = number(estimate.at("std_error"));
  EXPECT_NEAR(number(estimate.at("ci95")[0]), value - 1.959963984540054 * error, 1e-9 * value);
  EXPECT_NEAR(number(estimate.at("ci95")[1]), value + 1.959963984540054 * error, 1e-9 * value);
  EXPECT_LE(std::fabs(number(document.at("z"))), 5.0);
  // The mean volume: at least the estimate, and far below the constant domain's.
  const double sampled = number(estimate.at("sampling_volume"));
  EXPECT_GT(sampled, value);
  const json constant =
      json_of({"box:1,1,0.001", "capsule:2,0.01", "--trials", "20000", "--estimator", "hit-or-miss"}).at("estimate");
  EXPECT_LT(sampled, 0.5 * number(constant.at("sampling_volume")));
  EXPECT_LT(error, 0.7 * number(constant.at("std_error")));
  // Threads change nothing, the sums of volumes included.
  for (const char* n : {"1", "3"}) {
    Words again = words;
    again.insert(again.end(), {"--threads", n});
    const json other = json_of(again).at("estimate");
    for (const char* key : {"excluded_volume", "std_error", "hits", "sampling_volume"}) {
      EXPECT_EQ(other.at(key), estimate.at(key)) << key;
    }
  }
  EXPECT_NE(run(words).out.find("hit-or-miss-fitted, isotropic orientations, fitted domains of mean volume"),
            std::string::npos);
}

TEST_F(Document, AlignedBoxesInTheirFittedDomainHitAlwaysAndClaimNoComparison) {
  const json document = json_of({"box:1,1,1", "--estimator", "hit-or-miss-fitted", "--orientations", "aligned"});
  const json& estimate = document.at("estimate");
  EXPECT_EQ(estimate.at("hits"), estimate.at("trials"));
  EXPECT_NEAR(number(estimate.at("excluded_volume")), 8.0, 1e-10);
  EXPECT_GT(number(estimate.at("std_error")), 0.0);
  EXPECT_TRUE(document.at("z").is_null());
  EXPECT_LT(count(estimate.at("trials")), 100000u) << "no miss is waited for";
}

TEST_F(Document, ASpherePairInTheBallHitsAlwaysAndClaimsNoComparison) {
  const json document = json_of({"sphere:1", "sphere:0.5", "--rel-error", "1e-3", "--estimator", "hit-or-miss"});
  EXPECT_TRUE(document.at("z").is_null());
  EXPECT_TRUE(document.at("z_reason").is_string());
  const json& estimate = document.at("estimate");
  expect_tally(estimate);
  EXPECT_EQ(estimate.at("hits"), estimate.at("trials"));
  EXPECT_GT(number(estimate.at("std_error")), 0.0);
  EXPECT_LT(count(estimate.at("trials")), 1000000u) << "one evaluation is enough";
  EXPECT_NEAR(number(estimate.at("excluded_volume")), 4.0 / 3.0 * M_PI * std::pow(1.5, 3), 1e-10);
  const json boxed = json_of({"sphere:1", "sphere:0.5", "--rel-error", "1e-2", "--domain", "box"});
  EXPECT_TRUE(boxed.at("z").is_number()) << "in the box some trials miss";
}

TEST_F(Document, NoHitAtAllClaimsNoErrorOfZero) {
  const json estimate = json_of({"box:1,1e-20,1e-20", "--trials", "2000", "--estimator", "hit-or-miss"}).at("estimate");
  EXPECT_EQ(estimate.at("hits"), 0);
  EXPECT_EQ(number(estimate.at("excluded_volume")), 0.0);
  const double volume = number(estimate.at("sampling_volume"));
  // The half-width of Wilson's interval at z = 1 for 0 of n: 1/(2(n + 1)).
  EXPECT_NEAR(number(estimate.at("std_error")) / volume, 0.5 / 2001.0, 1e-9);
  EXPECT_EQ(number(estimate.at("ci95")[0]), 0.0);
  EXPECT_GT(number(estimate.at("ci95")[1]), 0.0);
}

TEST_F(Document, CrossCheckListsEveryDisagreementWithItsPose) {
  const json clean = json_of({"box:1,1,1", "--trials", "2000", "--cross-check"});
  EXPECT_TRUE(clean.at("disagreements").is_array());
  EXPECT_EQ(clean.at("n_disagreements"), clean.at("disagreements").size());
  EXPECT_EQ(clean.at("cross_check"), backends_of_this_build());
  const std::vector<std::string> backends = backends_of_this_build();
  if (std::ranges::find(backends, "ccd-gjk") == backends.end()) return;  // nothing here that would be wrong
  // libccd compares with lengths of its own: bodies of a nanometre, written in metres, meet everywhere.
  const json document = json_of({"box:1e-9,1e-9,1e-9", "--trials", "200", "--cross-check"});
  EXPECT_GT(count(document.at("n_disagreements")), 0u);
  EXPECT_EQ(document.at("n_disagreements"), document.at("disagreements").size());
  std::uint64_t last = 0;
  for (const json& one : document.at("disagreements")) {
    EXPECT_LT(count(one.at("index")), 200u);
    EXPECT_GE(count(one.at("index")), last);
    last = count(one.at("index"));
    EXPECT_EQ(one.at("matrix").size(), 12u);
    bool disjoint = false, overlap = false;
    for (const std::string& backend : backends_of_this_build()) {
      disjoint |= one.at("verdicts").at(backend) == "disjoint";
      overlap |= one.at("verdicts").at(backend) == "overlap";
    }
    EXPECT_TRUE(disjoint && overlap) << one;
  }
}

TEST_F(Document, OnStandardOutputIsAllThatIsPrinted) {
  const Finished finished = run({"box:1,1,1", "--trials", "1000", "--json", "-"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_TRUE(json::accept(finished.out)) << finished.out;
  EXPECT_EQ(finished.err, "");
  EXPECT_TRUE(files().empty());
  const Finished quiet = run({"box:1,1,1", "--trials", "1000", "--json=-", "--quiet"});
  EXPECT_TRUE(json::accept(quiet.out));
}

TEST_F(Document, AFileIsReplacedWholeAndLeavesNothingBeside) {
  write_file("result.json", std::string(100000, 'x'));
  const Finished finished = run({"box:1,1,1", "--trials", "1000", "--json", "result.json"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_NE(finished.out, "") << "beside a file the report is printed";
  EXPECT_TRUE(json::accept(read_file("result.json")));
  EXPECT_EQ(read_file("result.json").back(), '\n');
  EXPECT_EQ(files(), std::vector<std::string>{"result.json"});
  std::filesystem::create_directory(folder() / "sub");
  EXPECT_EQ(run({"box:1,1,1", "--trials", "10", "--quiet", "--json", "sub/name with spaces"}).exit_code, 0);
  EXPECT_TRUE(json::accept(read_file("sub/name with spaces")));
  EXPECT_EQ(run({"box:1,1,1", "--trials", "10", "--quiet", "--json", "/dev/null"}).exit_code, 0);
}

}  // namespace
}  // namespace vex::golden
