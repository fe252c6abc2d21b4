// Bodies from files: the same floats are the same body, whatever the format and whatever the name.
#include <cmath>
#include <filesystem>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class BodyFiles : public ProgramTest {
 protected:
  json with_few_trials(Words words) const {
    words.insert(words.end(), {"--trials", "1000", "--estimator", "hit-or-miss"});
    return json_of(words);
  }
};

TEST_F(BodyFiles, TheSameBodyInFiveFormatsGivesTheSameNumbers) {
  json first;
  for (const char* extension : {"obj", "stl", "ply", "off", "gltf"}) {
    const json document = json_of({sample(std::string("icosahedron.") + extension), "--trials", "20000", "--seed", "5",
                                   "--estimator", "hit-or-miss"});
    json found = document.at("formula");
    for (const char* key : {"volume", "surface_area", "integrated_mean_curvature", "centre", "circumradius", "inradius",
                            "vertices", "faces"}) {
      found[key] = document.at("bodies")[0].at(key);
    }
    found["hits"] = document.at("estimate").at("hits");
    if (first.is_null()) first = found;
    EXPECT_EQ(found, first) << extension;
  }
  EXPECT_EQ(first.at("vertices"), 12);
  EXPECT_EQ(first.at("faces"), 20);
  EXPECT_NEAR(first.at("reduced").get<double>(), 8.915264469, 1e-6) << "the icosahedron, to its 32-bit coordinates";
}

TEST_F(BodyFiles, EverySampleBodyAgreesWithTheFormula) {
  int n_bodies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(sample(""))) {
    if (entry.path().extension() != ".obj") continue;
    ++n_bodies;
    const json document = json_of({entry.path().string(), "--rel-error", "1e-2"});
    EXPECT_LT(std::fabs(document.at("z").get<double>()), 4.0) << entry.path();
  }
  EXPECT_GE(n_bodies, 6);
}

TEST_F(BodyFiles, AMeshThatIsInsideOutIsTurnedAndSaysSo) {
  std::string text = cube_obj();
  text.resize(text.find("f "));
  text += "f 2 3 4 1\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
  write_file("cube.obj", text);
  const Finished finished = run({"cube.obj", "--trials", "1000"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.out.find("inside out"), std::string::npos) << finished.out;
}

TEST_F(BodyFiles, WeldedVerticesAreCounted) {
  std::string text = cube_obj();
  text.resize(text.find("f "));
  text += "v 0 0 0\nf 1 4 3 2\nf 5 6 7 8\nf 9 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  write_file("cube.obj", text);
  const json body = with_few_trials({"cube.obj"}).at("bodies")[0];
  EXPECT_EQ(body.at("vertices"), 8);
  EXPECT_GE(body.at("welded_vertices"), 1);
}

TEST_F(BodyFiles, AMeshIsNotRecentred) {
  std::string text = cube_obj();
  for (std::size_t at = 0; (at = text.find("v ", at)) != std::string::npos; at += 2) {
    const std::size_t x = at + 2;
    text.replace(x, 1, text[x] == '0' ? "100" : "101");
  }
  write_file("far.obj", text);
  write_file("cube.obj", cube_obj());
  const json far = with_few_trials({"far.obj"});
  EXPECT_NEAR(far.at("bodies")[0].at("centre")[0].get<double>(), 100.5, 0.01);
  EXPECT_EQ(far.at("bodies")[0].at("volume"), with_few_trials({"cube.obj"}).at("bodies")[0].at("volume"));
  EXPECT_LT(std::fabs(json_of({"far.obj", "--rel-error", "1e-2"}).at("z").get<double>()), 4.0);
}

TEST_F(BodyFiles, TheHullOfWhateverIsThere) {
  // A cube with a dent in its lid, open below, and a loose triangle inside: refused, but for its hull.
  std::string text = cube_obj();
  text.resize(text.find("f "));
  text += "v 0.5 0.5 0.25\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  write_file("dented.obj", text);
  const Finished refused = run({"dented.obj", "--trials", "10"});
  expect_refusal(refused, 3, "--hull");
  write_file("cube.obj", cube_obj());
  const json cube = with_few_trials({"cube.obj"}), hull = with_few_trials({"dented.obj", "--hull"});
  EXPECT_EQ(hull.at("estimate").at("hits"), cube.at("estimate").at("hits")) << "the same eight vertices";
  EXPECT_NEAR(hull.at("bodies")[0].at("volume").get<double>(), 1.0, 1e-14);
  EXPECT_EQ(hull.at("bodies")[0].at("vertices"), 8);
  EXPECT_EQ(hull.at("bodies")[0].at("points"), 9);
  EXPECT_TRUE(hull.at("bodies")[0].at("hull_added_volume").is_null()) << "an open surface encloses no volume";
  write_file("closed.obj", text + "f 4 3 2 1\n");
  const json closed = with_few_trials({"closed.obj", "--hull"}).at("bodies")[0];
  EXPECT_NEAR(closed.at("hull_added_volume").get<double>(), 0.25, 1e-14) << "a pyramid of height 3/4 on a unit square";
  EXPECT_NE(run({"closed.obj", "--hull", "--trials", "10"}).out.find("volume added by the hull          0.25"),
            std::string::npos);
  write_file("points.obj", text.substr(0, text.find("f ")));
  EXPECT_EQ(with_few_trials({"points.obj", "--hull"}).at("estimate").at("hits"), cube.at("estimate").at("hits"));
  write_file("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  expect_refusal(run({"flat.obj", "--hull"}), 3, "plate:");
}

TEST_F(BodyFiles, AScaledBodyIsMeasuredAnew) {
  const std::string gem = sample("gem.obj");
  const json one = json_of({gem, "--trials", "20000", "--estimator", "hit-or-miss"}),
             half = json_of({gem, "--trials", "20000", "--estimator", "hit-or-miss", "--scale", "0.5"});
  EXPECT_EQ(half.at("bodies")[0].at("scale"), 0.5);
  EXPECT_EQ(half.at("bodies")[0].at("volume").get<double>(), one.at("bodies")[0].at("volume").get<double>() / 8.0);
  EXPECT_EQ(half.at("estimate").at("hits"), one.at("estimate").at("hits")) << "a power of two changes no verdict";
  for (const std::string& body : {gem, std::string("cone:3,2"), std::string("tetrahedron:5"), "rounded:0.5," + gem,
                                  std::string("rounded:0.5,plate:1,2")}) {
    const json scaled = json_of({body, "--trials", "10", "--unit-volume"});
    EXPECT_NEAR(scaled.at("bodies")[0].at("volume").get<double>(), 1.0, 1e-14) << body;
    const json larger = json_of({body, "--trials", "10", "--unit-volume", "--scale", "3"});
    EXPECT_NEAR(larger.at("bodies")[0].at("volume").get<double>(), 27.0, 1e-12) << body;
    EXPECT_NEAR(larger.at("formula").at("reduced").get<double>(), scaled.at("formula").at("reduced").get<double>(),
                1e-12);
  }
}

TEST_F(BodyFiles, AnOddNameIsStillAName) {
  for (const char* name : {"two words.obj", "it's.obj", "\"quoted\".obj", "grün-Ωμέγα-形.obj", "a:b.obj",
                           "box:1,1,1.obj", "[1,2].obj", "$HOME;rm.obj", "back\\slash.obj", "per%20cent%s%n.obj",
                           "line\nbreak.obj", "{}.obj", "#.obj", " .obj", "cube.OBJ"}) {
    SCOPED_TRACE(name);
    write_file(name, cube_obj());
    // What looks like a named body is one, unless a folder stands before it.
    const std::string argument = std::string(name).rfind("box:", 0) == 0 ? std::string("./") + name : name;
    const json document = with_few_trials({argument});
    EXPECT_EQ(document.at("bodies")[0].at("source"), argument);
    EXPECT_EQ(document.at("bodies")[0].at("vertices"), 8);
  }
}

TEST_F(BodyFiles, ANameThatIsNotUtf8StillGivesValidJson) {
  const std::string name = "\xff\xfe\x80.obj";
  write_file(name, cube_obj());
  const json document = with_few_trials({name});
  EXPECT_TRUE(document.at("bodies")[0].at("source").is_string());
  const Finished missing = run({"\xc3\x28.obj", "--json", "-"});
  expect_refusal(missing, 3, ".obj");
}

TEST_F(BodyFiles, ControlCharactersOfANameDoNotReachTheTerminal) {
  const std::string name = "red\033[31m\rred.obj";
  write_file(name, cube_obj());
  const Finished finished = run({name, "--trials", "10"});
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.out.find('\033'), std::string::npos);
  EXPECT_NE(finished.out.find("\\x1b"), std::string::npos);
  const Finished missing = run({"two\nlines\033.obj"});
  expect_refusal(missing, 3, "two\\x0alines\\x1b.obj");
}

TEST_F(BodyFiles, ALeadingDashNeedsAFolderOrASeparator) {
  write_file("-x.obj", cube_obj());
  EXPECT_EQ(with_few_trials({"./-x.obj"}).at("bodies")[0].at("vertices"), 8);
  const Finished separated = run({"--trials", "10", "--", "-x.obj"});
  EXPECT_EQ(separated.exit_code, 0) << separated.err;
  EXPECT_EQ(run({"-x.obj"}).exit_code, 2);
}

TEST_F(BodyFiles, OptionsStandAnywhereAndMayUseAnEqualsSign) {
  const json first =
      json_of({"box:1,1,1", "box:1,2,3", "--trials", "3000", "--seed", "9", "--estimator", "hit-or-miss"})
          .at("estimate")
          .at("hits");
  EXPECT_EQ(json_of({"--trials=3000", "box:1,1,1", "--seed=9", "--estimator=hit-or-miss", "box:1,2,3"})
                .at("estimate")
                .at("hits"),
            first);
  EXPECT_EQ(json_of({"--estimator", "hit-or-miss", "--seed", "9", "--trials", "3e3", "box:1,1,1", "box:1,2,3"})
                .at("estimate")
                .at("hits"),
            first);
}

}  // namespace
}  // namespace vex::golden
