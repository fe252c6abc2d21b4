// Meshes from standard input, in formats that their names do not tell, in units, and in two sizes.
#include <cmath>

#include "tests/golden/pair.h"
#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

const std::string kShortLine = " --trials 1000 --estimator hit-or-miss --json -";

class MeshInput : public ProgramTest {
 protected:
  MeshInput() { write_file("cube.obj", cube_obj()); }

  json json_of_shell(const std::string& line) const {
    const Finished finished = shell(line);
    EXPECT_EQ(finished.exit_code, 0) << line << "\n" << finished.err;
    return json::parse(finished.out, nullptr, false);
  }
  void expect_wrong(const Words& words, const std::string& part) const {
    SCOPED_TRACE(testing::PrintToString(words));
    expect_refusal(run(words), 2, part);
  }
  static double volume(const json& document, std::size_t body) {
    return document.at("bodies").at(body).at("volume").get<double>();
  }
};

TEST_F(MeshInput, AMeshOnStandardInput) {
  const json of_file = json_of({"cube.obj", "--trials", "1000", "--estimator", "hit-or-miss"});
  for (const char* format : {"obj", ".obj", "OBJ"}) {
    const json piped = json_of_shell("cat cube.obj | \"$VEX\" - --format " + std::string(format) + kShortLine);
    EXPECT_EQ(piped.at("bodies")[0].at("source"), "-");
    EXPECT_EQ(piped.at("bodies")[0].at("vertices"), 8);
    EXPECT_EQ(piped.at("estimate").at("hits"), of_file.at("estimate").at("hits"));
  }
  EXPECT_EQ(json_of_shell("\"$VEX\" - --format obj < cube.obj" + kShortLine).at("formula"), of_file.at("formula"));
  EXPECT_NEAR(volume(json_of_shell("\"$VEX\" sphere:1 rounded:1,- --format obj < cube.obj" + kShortLine), 1),
              1.0 + 6.0 + 3.0 * M_PI + 4.0 / 3.0 * M_PI, 1e-12);
  const Finished shown = shell("\"$VEX\" - --format obj --trials 100 < cube.obj");
  EXPECT_EQ(shown.out.rfind("A  standard input  polyhedron, 8 vertices", 0), 0u) << shown.out;
  const Finished broken = shell("echo v 1 x 2 | \"$VEX\" box:1,1,1 - --format obj");
  expect_refusal(broken, 3, "standard input");
  EXPECT_EQ(run({"-", "--format", "stl"}).exit_code, 3) << "there is nothing";
}

TEST_F(MeshInput, StandardInputIsForOneOfThem) {
  expect_wrong({"-"}, "standard input has no extension that tells its format");
  expect_wrong({"-", "-", "--format", "obj"}, "standard input is wanted for 2 bodies");
  expect_wrong({"-", "rounded:1,-", "--format", "obj"}, "standard input is wanted for 2 bodies");
  expect_wrong({"box:1,1,1", "-", "--control-variate", "-", "--format", "obj"},
               "standard input is wanted for 2 bodies");
  for (const char* format : {"doc", ".", "o bj", "png", "-"}) {
    expect_wrong({"-", "--format", format}, std::string("no such format is read (--format ") + format + ")");
    expect_wrong({"cube.obj", "--format", format}, "no such format is read");
  }
  expect_wrong({"box:1,1,1", "--format", "stl"}, "no body is a mesh file (--format stl with box:1,1,1)");
}

TEST_F(MeshInput, TheHullOfOneFile) {
  // A cube without one of its sides, and a tetrahedron with a point inside.
  std::string open_cube = cube_obj();
  open_cube.erase(open_cube.rfind("f "));
  write_file("open.obj", open_cube);
  write_file("points.dat", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.25 0.25 0.25\n");
  expect_refusal(run({"open.obj"}), 3, "open.obj");
  const json hull = json_of({"hull:open.obj", "points:points.dat", "--trials", "1000"});
  EXPECT_EQ(hull.at("bodies")[0].at("source"), "hull:open.obj");
  EXPECT_NEAR(volume(hull, 0), 1.0, 1e-15);
  EXPECT_NEAR(volume(hull, 1), 1.0 / 6, 1e-15);
  EXPECT_EQ(hull.at("bodies")[1].at("vertices"), 4);
  EXPECT_NEAR(volume(json_of({"rounded:1,points:open.obj", "--trials", "1000"}), 0),
              1.0 + 6.0 + 3.0 * M_PI + 4.0 / 3.0 * M_PI, 1e-12);
  EXPECT_NEAR(volume(json_of({"hull:open.obj", "--unit-volume", "--scale", "2", "--trials", "1000"}), 0), 8.0, 1e-14);
  expect_refusal(run({"hull:cube.obj", "open.obj"}), 3, "open.obj");  // which nobody asked the hull of
  expect_refusal(run({"hull:points.dat"}), 3, "points.dat");
  expect_refusal(run({"hull:nothing.obj"}), 3, "nothing.obj");
  for (const char* text : {"hull:", "points:", "hull:box:1,1,1", "rounded:1,hull:"}) {
    expect_wrong({text}, "write hull:FILE or points:FILE");
  }
  EXPECT_EQ(json_of_shell("\"$VEX\" hull:- --format obj < open.obj" + kShortLine).at("bodies")[0].at("vertices"), 8);
}

TEST_F(MeshInput, AFormatThatTheNameDoesNotTell) {
  write_file("cube.backup", cube_obj());
  write_file("tetrahedron", tetrahedron_stl());
  EXPECT_EQ(json_of({"cube.backup", "--format", "obj", "--trials", "100"}).at("bodies")[0].at("vertices"), 8);
  EXPECT_EQ(json_of({"tetrahedron", "--format", "stl", "--trials", "100"}).at("bodies")[0].at("vertices"), 4);
  expect_refusal(run({"cube.backup"}), 3, "cube.backup");
  // What standard input is says nothing of a file with a name of its own.
  const json both = json_of_shell("\"$VEX\" - cube.obj --format stl < tetrahedron" + kShortLine);
  EXPECT_EQ(both.at("bodies")[0].at("vertices"), 4);
  EXPECT_EQ(both.at("bodies")[1].at("vertices"), 8);
  EXPECT_EQ(run({"cube.obj", "--format", "stl"}).exit_code, 3) << "asked for, it is read as that";
}

TEST_F(MeshInput, AAndBInSizesOfTheirOwn) {
  const Words few = {"--trials", "1000", "--estimator", "hit-or-miss"};
  const auto json_with = [&](Words words) {
    words.insert(words.end(), few.begin(), few.end());
    return json_of(words);
  };
  for (const std::string& body : {std::string("cube.obj"), std::string("box:1,1,1")}) {
    SCOPED_TRACE(body);
    const json b_scaled = json_with({body, "--scale-b", "2"});
    EXPECT_NEAR(volume(b_scaled, 0), 1.0, 1e-15);
    EXPECT_NEAR(volume(b_scaled, 1), 8.0, 1e-14);
    EXPECT_EQ(b_scaled.at("bodies")[0].at("scale"), 1.0);
    EXPECT_EQ(b_scaled.at("bodies")[1].at("scale"), 2.0);
    // 1 + 8 + (3 pi 24 + 6 pi 6) / 4 pi.
    EXPECT_NEAR(b_scaled.at("formula").at("excluded_volume").get<double>(), 36.0, 1e-12);
    EXPECT_LT(std::fabs(b_scaled.at("z").get<double>()), 5.0);
    const json a_scaled = json_with({body, body, "--scale-a", "2"});
    EXPECT_NEAR(volume(a_scaled, 0), 8.0, 1e-14);
    EXPECT_NEAR(volume(a_scaled, 1), 1.0, 1e-15);
    const json all = json_with({body, "box:1,1,2", "--unit-volume", "--scale", "3", "--scale-a", "0.5"});
    EXPECT_NEAR(volume(all, 0), 27.0 / 8.0, 1e-13);
    EXPECT_NEAR(volume(all, 1), 27.0, 1e-12);
    const json alike = json_with({body, "--scale-a", "2", "--scale-b", "2"});
    EXPECT_EQ(alike.at("bodies")[0], alike.at("bodies")[1]);
  }
  EXPECT_NE(run({"cube.obj", "--trials", "100"}).out.find("B  the same body"), std::string::npos);
  const Finished unlike = run({"cube.obj", "--trials", "100", "--scale-b", "2"});
  EXPECT_EQ(unlike.out.find("B  the same body"), std::string::npos) << unlike.out;
  const json piped = json_of_shell("cat cube.obj | \"$VEX\" - --format obj --scale-b 0.5" + kShortLine);
  EXPECT_NEAR(volume(piped, 0), 1.0, 1e-15);
  EXPECT_NEAR(volume(piped, 1), 0.125, 1e-15);
}

TEST_F(MeshInput, AControlVariateIsAsLargeAsWhatItIsLike) {
  const Words words = {"cube.obj", "--scale-b", "2", "--control-variate", "sphere:0.6", "--trials", "20000"};
  const json document = json_of(words);
  EXPECT_LT(std::fabs(document.at("z").get<double>()), 5.0);
  Words twice = words;
  twice.insert(twice.begin() + 5, {"--control-variate", "sphere:0.6"});
  EXPECT_EQ(json_of(twice).at("estimate").at("excluded_volume"), document.at("estimate").at("excluded_volume"));
}

TEST_F(MeshInput, ScalesAndUnitsThatMeanNothing) {
  for (const char* option : {"--scale-a", "--scale-b"}) {
    for (const char* word : {"0", "-2", "nan", "inf", "large", "1e400"}) {
      expect_wrong({"box:1,1,1", option, word}, std::string("\"") + word + "\" for " + option);
    }
    expect_wrong({"box:1,1,1", "--scale", "1e200", option, "1e200"}, "out of range");
    expect_wrong({"box:1,1,1", "--scale", "1e-200", option, "1e-200"}, "out of range");
  }
  for (const char* word : {"km", "MM", "1", "mm2"}) {
    expect_wrong({"cube.obj", "--unit", word}, std::string("(\"") + word + "\" for --unit) - there are m, cm, mm");
  }
  expect_wrong({"box:1,1,1", "--unit", "mm"}, "no body is a mesh file, whose unit could be converted");
  expect_refusal(run({"cube.obj", "--unit", "mm"}), 3, "unit");
  for (const char* word : {"-1e-9", "0.2", "nan", "tight"}) expect_wrong({"cube.obj", "--weld", word}, "--weld");
  EXPECT_EQ(run({"box:1,1,1", "--weld", "1e-6", "--hull", "--convex-tolerance", "1e-5", "--trials", "10"}).exit_code, 0)
      << "what a named body fulfils as it is";
}

TEST_F(MeshInput, AFilesUnitIsNamedAndConverted) {
  // A glTF file is in metres.
  write_file("body.gltf", tetrahedron_gltf("body.bin"));
  write_file("body.bin", tetrahedron_buffer());
  const json as_it_is = json_of({"body.gltf", "--trials", "100"});
  EXPECT_EQ(as_it_is.at("bodies")[0].at("unit"), "m");
  EXPECT_NEAR(volume(as_it_is, 0), 1.0 / 6.0, 1e-15);
  const json converted = json_of({"body.gltf", "--trials", "100", "--unit", "mm"});
  EXPECT_EQ(converted.at("bodies")[0].at("unit"), "mm");
  EXPECT_NEAR(volume(converted, 0), 1e9 / 6.0, 1e-6);
  EXPECT_NE(run({"body.gltf", "--trials", "100", "--unit", "mm"}).out.find(", in mm, "), std::string::npos);
  const json scaled = json_of({"body.gltf", "--trials", "100", "--scale", "1000"});
  EXPECT_TRUE(scaled.at("bodies")[0].at("unit").is_null()) << "the scale may have been meant as a change of unit";
  EXPECT_TRUE(json_of({"cube.obj", "--trials", "100"}).at("bodies")[0].at("unit").is_null());
}

TEST_F(MeshInput, FilesOfDifferentUnitsDoNotMeetByTheirNumbersAlone) {
  write_file("metres.gltf", tetrahedron_gltf("body.bin"));
  write_file("body.bin", tetrahedron_buffer());
  write_file("centimetres.dae", tetrahedron_dae("centimeter", "0.01"));
  const Words pair = {"metres.gltf", "centimetres.dae", "--trials", "100"};
  expect_refusal(run(pair), 3, "two files of different units (metres.gltf in m, centimetres.dae in cm)");
  const auto volumes_with = [&](const Words& words) {
    Words all = pair;
    all.insert(all.end(), words.begin(), words.end());
    const json document = json_of(all);
    return std::pair(6.0 * volume(document, 0), 6.0 * volume(document, 1));
  };
  const auto [a_cm, b_cm] = volumes_with({"--unit", "cm"});
  EXPECT_NEAR(a_cm, 1e6, 1e-4);
  EXPECT_NEAR(b_cm, 1.0, 1e-12);
  const auto [a, b] = volumes_with({"--scale-b", "1"});
  EXPECT_NEAR(a, 1.0, 1e-12) << "as they stand";
  EXPECT_NEAR(b, 1.0, 1e-12) << "as they stand";
  const auto [a_unit, b_unit] = volumes_with({"--unit-volume"});
  EXPECT_NEAR(a_unit, b_unit, 1e-12);
  EXPECT_EQ(run({"metres.gltf", "cube.obj", "--trials", "100"}).exit_code, 0) << "one that states none";
  EXPECT_EQ(run({"centimetres.dae", "box:1,1,1", "--trials", "100"}).exit_code, 0);
}

TEST_F(MeshInput, TheReportSaysHowFinelyTheCoordinatesAreStated) {
  for (const auto& [number, kind, shown] : std::initializer_list<std::tuple<const char*, const char*, const char*>>{
           {"1", "doubles of the file", "its coordinates, 64-bit"},
           {"0.333333", "decimals of the file, 6 digits", "its coordinates, printed to 6 digits"}}) {
    std::string text = cube_obj();
    for (std::size_t at = 0; (at = text.find(" 1", at)) < text.find('f'); ++at) text.replace(at + 1, 1, number);
    write_file("body.obj", text);
    const json body = json_of({"body.obj", "--trials", "100"}).at("bodies")[0];
    EXPECT_EQ(body.at("coordinates"), kind);
    const double rounding = body.at("coordinate_rounding");
    EXPECT_GT(rounding, std::string(number) == "1" ? 1e-17 : 1e-7);
    EXPECT_LT(rounding, std::string(number) == "1" ? 1e-15 : 1e-5);
    EXPECT_EQ(body.at("dropped_vertices"), 0);
    EXPECT_TRUE(body.at("unit").is_null());
    const Finished finished = run({"body.obj", "--trials", "100"});
    EXPECT_NE(finished.out.find(shown), std::string::npos) << finished.out;
    EXPECT_NE(json_of({"body.obj", "--trials", "100", "--scale", "2"}).at("bodies")[0].at("coordinates"), kind);
  }
  const json floats = json_of({sample("icosahedron.gltf"), "--trials", "100"}).at("bodies")[0];
  EXPECT_EQ(floats.at("coordinates"), "numbers of the file, as fine as 32-bit floats, in m");
  EXPECT_NEAR(floats.at("coordinate_rounding").get<double>(), 3e-8, 2e-8);
  EXPECT_NE(run({sample("icosahedron.gltf"), "--trials", "100"}).out.find("its coordinates, 32-bit, in m, taken as"),
            std::string::npos);
  const json named = json_of({"box:1,1,1", "--trials", "100"}).at("bodies")[0];
  EXPECT_TRUE(named.at("coordinate_rounding").is_null());
  EXPECT_TRUE(named.at("unit").is_null());
  EXPECT_EQ(named.at("dropped_vertices"), 0);
}

TEST_F(PairQuery, AMeshOnStandardInputAndInASizeOfItsOwn) {
  write_file("cube.obj", cube_obj());
  write_file("poses.csv", kQuaternionHeader + "2.5,0,0,1,0,0,0\n");
  const std::string pair = "\"$VEX\" - cube.obj --format obj --query distance --jsonl --quiet ";
  const auto distance_of = [&](const std::string& line) {
    const Finished finished = shell(line);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return objects_of(finished.out).at(0).at("distance").get<double>();
  };
  EXPECT_NEAR(distance_of(pair + "--poses poses.csv < cube.obj"), 1.5, 1e-12);
  EXPECT_NEAR(distance_of(pair + "--translation 2.5,0,0 --scale-a 2 < cube.obj"), 0.5, 1e-12);
  const std::string twice = "standard input is wanted for a body and for --poses";
  expect_refusal(shell(pair + "--poses - < cube.obj"), 2, twice, "vex_pair");
  EXPECT_NEAR(distance_of("\"$VEX\" cube.obj cube.obj --query distance --jsonl --quiet --poses - --scale-b 0.5 "
                          "--scale 2 < poses.csv"),
              0.5, 1e-12);
}

}  // namespace
}  // namespace vex::golden
