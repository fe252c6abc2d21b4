#include "meshes/assimp_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "archives.h"
#include "meshes/data/archives.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/reader.h"
#include "refusal.h"
#include "soups.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

std::string refusal_for(const std::filesystem::path& path) {
  return refusal_of([&] { static_cast<void>(read_polygon_soup(path)); });
}

void expect_equal_points(const PolygonSoup& soup, const std::vector<Vec3d>& expected) {
  ASSERT_EQ(soup.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(soup.points[i].x, expected[i].x) << i;
    EXPECT_EQ(soup.points[i].y, expected[i].y) << i;
    EXPECT_EQ(soup.points[i].z, expected[i].z) << i;
  }
}

/// Where the corners of every face are, one after another: the same however a reader numbers the vertices.
std::vector<Vec3d> corners_of(const PolygonSoup& soup) {
  std::vector<Vec3d> corners;
  for (const std::uint32_t corner : soup.corners) corners.push_back(soup.points[corner]);
  return corners;
}

double float_place(double x) {
  const float nearest = static_cast<float>(std::fabs(x));
  return double{std::nextafter(nearest, std::numeric_limits<float>::infinity())} - double{nearest};
}

// --- The second opinion on the formats that vex reads itself

/// The same faces, and every corner within the rounding of assimp, which adds the digits before and behind the point as
/// floats: two last places.
void expect_assimp_agrees(const std::filesystem::path& path) {
  const PolygonSoup ours = read_polygon_soup(path);
  const PolygonSoup assimps = read_by_assimp(path);
  EXPECT_EQ(ours.face_sizes, assimps.face_sizes) << path;
  const std::vector<Vec3d> a = corners_of(ours), b = corners_of(assimps);
  ASSERT_EQ(a.size(), b.size()) << path;
  ASSERT_FALSE(a.empty()) << path;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE(std::fabs(a[i].x - b[i].x), 2 * float_place(a[i].x)) << path << " corner " << i;
    EXPECT_LE(std::fabs(a[i].y - b[i].y), 2 * float_place(a[i].y)) << path << " corner " << i;
    EXPECT_LE(std::fabs(a[i].z - b[i].z), 2 * float_place(a[i].z)) << path << " corner " << i;
  }
}

/// Neither floats nor of few digits.
PolygonSoup with_doubles(const PolygonSoup& soup) {
  return moved(soup, [](const Vec3d& p) { return Vec3d{p.x / 3 + 0.1, p.y * 1.7 - p.x / 7, 1e-3 * p.z}; });
}

TEST(SecondOpinion, AgreesOnEveryOwnFormat) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, PolygonSoup>> bodies{
      {"box", box_soup({-1, -2, -4}, {1, 2, 4})},
      {"dodecahedron", dodecahedron_soup()},
      {"sphere", sphere_soup(4, [](const Vec3d& p) { return p; })},
      {"far", moved(icosahedron_soup(),
                    [](const Vec3d& p) {
                      return p + Vec3d{12345.678, -1e6, 0.001};
                    })},
      {"torus", torus_soup(8)},
      {"great", great_dodecahedron_soup()},
      {"prism", l_prism_soup()},
      {"doubles", with_doubles(capsule_soup(7, 3))}};  // of fewer than ten corners: assimp's .off loses larger faces
  for (const auto& [name, soup] : bodies) {
    for (const char* extension : {".obj", ".off", ".ply", ".stl"}) {
      expect_assimp_agrees(folder.file(name + extension, mesh_bytes(soup, extension)));
    }
    expect_assimp_agrees(folder.file(name + "-text.ply", ply_text(soup)));
    expect_assimp_agrees(folder.file(name + "-text.stl", stl_text(soup)));
  }
}

TEST(SecondOpinion, AgreesOnTheSampleBodies) {
  std::size_t n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VEX_SAMPLE_BODIES)) {
    const std::string extension = lower_extension(entry.path());
    if (extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl") {
      expect_assimp_agrees(entry.path());
      ++n_files;
    }
  }
  EXPECT_GE(n_files, 10U);
}

// --- Coordinates

TEST(AssimpReader, KeepsTheBitsOfFloatsThatNoTransformMoves) {
  const TemporaryFolder folder;
  PolygonSoup soup = triangulated(moved(sphere_soup(3, [](const Vec3d& p) { return p; }), [](const Vec3d& p) {
    return Vec3d{double{static_cast<float>(p.x / 3)}, double{static_cast<float>(100 * p.y)}, -0.0};
  }));
  for (const char* extension : {".gltf", ".glb", ".3mf"}) {
    const PolygonSoup read = read_polygon_soup(folder.file(std::string("a") + extension, mesh_bytes(soup, extension)));
    expect_equal_points(read, soup.points);
    EXPECT_EQ(read.corners, soup.corners);
    EXPECT_EQ(read.digits.kind, CoordinateDigits::Kind::floats);
    EXPECT_NEAR(read.digits.last_place, 0x1p-17, 0x1p-40) << extension;  // of 100
  }
}

TEST(AssimpReader, PlacesPointsInDouble) {
  const TemporaryFolder folder;
  const PolygonSoup box = triangulated(box_soup({0, 0, 0}, {1, 2, 4}));
  folder.file("b.bin", gltf_buffer(box));
  const std::string nodes =
      R"([{"translation": [1000000, 0, -7], "children": [1]}, {"scale": [0.125, 1, 3], "mesh": 0}])";
  const PolygonSoup soup = read_polygon_soup(folder.file("a.gltf", gltf_text(box, "b.bin", nodes)));
  std::vector<Vec3d> expected = box.points;
  for (Vec3d& p : expected) p = {0.125 * p.x + 1e6, p.y, 3 * p.z - 7};  // no float: it has a place of 1/16 there
  expect_equal_points(soup, expected);
  // The coordinates, up to 4, have 2^-21 times the largest scale, at most. That the shift of 1e6 is a float of last
  // place 1/16 moves the mesh as a whole, and changes no shape: a dent of a thousandth was "explained" by it once.
  EXPECT_LE(soup.digits.last_place, 3 * 0x1p-21 + 4 * 0x1p-22);
  EXPECT_GE(soup.digits.last_place, 3 * 0x1p-22);
}

TEST(AssimpReader, CarriesTheLastPlaceThroughTheTransforms) {
  const TemporaryFolder folder;
  const PolygonSoup box = triangulated(box_soup({-1, -1, -1}, {1, 1, 1}));
  folder.file("b.bin", gltf_buffer(box));
  const auto last_place = [&](const std::string& nodes) {
    return read_polygon_soup(folder.file("a.gltf", gltf_text(box, "b.bin", nodes))).digits.last_place;
  };
  EXPECT_EQ(last_place(R"([{"mesh": 0}])"), 0x1p-23);
  EXPECT_EQ(last_place(R"([{"mesh": 0, "scale": [-1, 1, 1]}])"), 0x1p-23);
  // The scale of 1024 is a float as well: its own last place, 2^-13, for a coordinate of 1.
  EXPECT_EQ(last_place(R"([{"mesh": 0, "scale": [1024, 1, 1]}])"), 0x1p-13 + 0x1p-13);
  // Of two meshes their shifts count. Nested: the outer scale multiplies what the inner translation's rounding does.
  const std::string shifted = R"({"mesh": 0, "translation": [1000000, 0, 0]})";
  EXPECT_LE(last_place(R"([{"scale": [8, 8, 8], "children": [1]}, )" + shifted + "]"), 1e-5);
  EXPECT_NEAR(last_place(R"([{"scale": [8, 8, 8], "children": [1, 2]}, )" + shifted + ", {\"mesh\": 0}]"),
              8 * 0.0625 + 1e6 * 8 * 0x1p-23, 1e-4);
}

// Skins and morph targets were left out without a word: the body was another one.
TEST(AssimpReader, RefusesPointsThatSkinsMorphTargetsAndInstancesMove) {
  const TemporaryFolder folder;
  const PolygonSoup box = triangulated(box_soup({-1, -1, -1}, {1, 1, 1}));
  folder.file("b.bin", gltf_buffer(box));
  const auto reads = [&](const std::string& nodes) {
    return read_polygon_soup(folder.file("a.gltf", gltf_text(box, "b.bin", nodes)));
  };
  for (const char* nodes : {R"([{"mesh": 0, "skin": 0}])", R"([{"mesh": 0, "weights": [0.0, 1e-3]}])",
                            R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}}])"}) {
    try {
      reads(nodes);
      ADD_FAILURE() << nodes;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("moved or repeated"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(reads(R"([{"mesh": 0, "weights": [0.0, 0]}])").points.size(), box.points.size());
}

// --- Units

// assimp took memory by one count and filled it by another: V was of memory that nobody had written.
TEST(AssimpReader, RefusesColladaCountsThatLieAndWhatAssimpLeavesOut) {
  const TemporaryFolder folder;
  const std::string text = dae_text(triangulated(box_soup({0, 0, 0}, {100, 200, 50})));
  const auto refused = [&](const std::string& from, const std::string& to, const char* part) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    try {
      read_polygon_soup(folder.file("a.dae", changed));
      ADD_FAILURE() << to;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused("count=\"24\"", "count=\"12\"", "a count does not hold");
  refused("count=\"24\"", "count=\"27\"", "a count does not hold");
  refused("count=\"8\"", "count=\"9\"", "a count does not hold");
  refused("<instance_geometry", "<instance_controller url=\"#c\"/><instance_geometry", "skin");
  refused("100", "0.00000000034567890123", "more digits than assimp reads");
}

std::string dae_with(const std::string& asset) {
  std::string text = dae_text(triangulated(box_soup({0, 0, 0}, {100, 200, 50})));
  const std::size_t at = text.find("<asset>") + 7;
  return text.insert(at, asset);
}

TEST(AssimpReader, KeepsTheCoordinatesOfColladaAndNamesTheirUnit) {
  const TemporaryFolder folder;
  const PolygonSoup plain = read_polygon_soup(folder.file("a.dae", dae_with("")));
  EXPECT_EQ(plain.unit, "");
  EXPECT_EQ(plain.unit_metres, 0.0);
  const auto soup_of_unit = [&](const std::string& unit) {
    const PolygonSoup soup = read_polygon_soup(folder.file("b.dae", dae_with(unit)));
    expect_equal_points(soup, plain.points);
    return std::pair(soup.unit, soup.unit_metres);
  };
  const auto named = [](const char* name, double metres) { return std::pair(std::string(name), metres); };
  EXPECT_EQ(soup_of_unit("<unit name=\"centimeter\" meter=\"0.01\"/>"), named("cm", 0.01));
  EXPECT_EQ(soup_of_unit("<unit meter = '2.54e-2'></unit>"), named("in", 0.0254));
  EXPECT_EQ(soup_of_unit("<unit name='x>y' meter='0.001'/>"), named("mm", 0.001));
  EXPECT_EQ(soup_of_unit("<unit/>"), named("m", 1.0));
  EXPECT_EQ(soup_of_unit("<!-- <unit meter=\"7\"/> --><unit name='yard' meter='0.9144'/>"), named("yard", 0.9144));
  EXPECT_EQ(soup_of_unit("<unit name='inch' meter='1.5'/>"), named("1.5 m", 1.5));
  EXPECT_EQ(soup_of_unit("<contributor><unit meter='3'/></contributor>"), named("", 0.0));
}

TEST(AssimpReader, RefusesAColladaUnitThatIsNone) {
  const TemporaryFolder folder;
  for (const char* bad : {"0,01", "0", "-1", "", "1x", "1e400", "nan"}) {
    const std::string unit = std::string("<unit meter=\"") + bad + "\"/>";
    EXPECT_TRUE(contains(refusal_for(folder.file("a.dae", dae_with(unit))), "no positive number of metres")) << bad;
  }
  EXPECT_TRUE(contains(refusal_for(folder.file("a.dae", dae_with("<unit meter='1'/><unit meter='2'/>"))), "two units"));
}

TEST(AssimpReader, RefusesColladaNumbersThatAssimpMisreads) {
  const TemporaryFolder folder;
  for (const char* bad : {"1.0D+02", "100,5", "1x", "1_000", "5-3", "1.5.2"}) {
    std::string text = dae_with("");
    text.replace(text.find("100 "), 3, bad);
    EXPECT_TRUE(contains(refusal_for(folder.file("a.dae", text)), std::string("'") + bad + "' is no decimal number"));
  }
}

TEST(AssimpReader, RefusesColladaNumbersOfMoreDigitsThanAssimpCounts) {
  // assimp counts in 64 bits, and takes what does not fit for 0, or for what is left of it.
  const TemporaryFolder folder;
  const auto with = [&](const std::string& number) {
    std::string text = dae_with("");
    text.replace(text.find("100 "), 3, number);
    return folder.file("a.dae", text);
  };
  for (const char* bad : {"100000000000000000000.5", "-40000000000000000000", "0000000000000000000000000100",
                          "1000000000000000000000e-19", "1.5e00000000000000000001", "1e-00000000000000000001"}) {
    EXPECT_TRUE(contains(refusal_for(with(bad)), "' has more digits than assimp reads")) << bad;
  }
  const std::vector<Vec3d> whole = read_polygon_soup(with("100")).points;
  for (const char* good : {"100.00000000000000000000000000", "1000000000000000.0e-13", "+1.0000000000000000000000e2"}) {
    expect_equal_points(read_polygon_soup(with(good)), whole);
  }
}

TEST(AssimpReader, RefusesColladaIndicesThatAssimpMisreads) {
  const TemporaryFolder folder;
  const std::string text = dae_with("");
  const std::size_t at = text.find("<p>") + 3;
  const std::size_t size = text.find(' ', at) - at;
  for (const char* bad : {"-1", "4294967296", "1.5", "0x1", "1,2"}) {
    EXPECT_TRUE(contains(refusal_for(folder.file("a.dae", std::string(text).replace(at, size, bad))),
                         std::string("'") + bad + "' is not a whole number from 0 to"));
  }
}

TEST(AssimpReader, RefusesColladaThatItCannotLookInto) {
  const TemporaryFolder folder;
  for (std::string wide : {"", "\xFF\xFE"}) {  // UTF-16, which assimp reads
    for (const char c : dae_with("<unit meter=\"0.01\"/>")) wide += {c, '\0'};
    EXPECT_TRUE(contains(refusal_for(folder.file("a.dae", wide)), " in UTF-"));
  }
  std::string skewed = dae_with("");
  skewed.insert(skewed.find("<instance_geometry"), "<skew>45 0 1 0 1 0 0</skew>");
  EXPECT_TRUE(contains(refusal_for(folder.file("b.dae", skewed)), "skewed"));
}

std::string model(const std::string& attributes, const std::string& items = "<item objectid=\"1\"/>") {
  return "<?xml version=\"1.0\"?><model " + attributes +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object id=\"1\"><mesh>"
         "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1.25\" "
         "z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"0.1\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
         "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" "
         "v3=\"3\"/></triangles></mesh></object></resources><build>" +
         items + "</build></model>";
}

const std::vector<Vec3d> kModelPoints{{0, 0, 0}, {1, 0, 0}, {0, 1.25, 0}, {0, 0, double{0.1F}}};

TEST(AssimpReader, NamesTheUnitOf3mf) {
  const TemporaryFolder folder;
  for (const auto& [attribute, unit] : std::vector<std::pair<std::string, std::string>>{
           {"unit=\"micron\"", "um"}, {"unit='inch'", "in"}, {"unit=\"foot\"", "ft"}, {"", "mm"}}) {
    for (const bool deflated : {false, true}) {
      const PolygonSoup soup = read_polygon_soup(folder.file("a.3mf", threemf_of(model(attribute), {}, deflated)));
      EXPECT_EQ(soup.unit, unit);
      expect_equal_points(soup, kModelPoints);
    }
  }
  EXPECT_TRUE(contains(refusal_for(folder.file("a.3mf", threemf_of(model("unit=\"league\"")))), "'league'"));
}

TEST(AssimpReader, Reads3mfWithAPictureInEitherProcess) {
  // assimp 5.2 deletes a preview picture twice: 24 of 58 valid files ended its process after they had been read.
  const TemporaryFolder folder;
  const auto path =
      folder.file("a.3mf", threemf_of(model(""), {{"Metadata/thumbnail.png", "\x89PNG" + std::string(5000, 'x')},
                                                  {"Thumbnails/thumbnail.JPG", std::string(70, 'y')}}));
  expect_equal_points(read_polygon_soup(path), kModelPoints);
  expect_equal_points(read_by_assimp(path), kModelPoints);
}

TEST(AssimpReader, Refuses3mfWhoseGeometryAssimpDoesNotSee) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& text, const std::vector<std::pair<std::string, std::string>>& more = {}) {
    return folder.file("a.3mf", threemf_of(text, more));
  };
  const std::string production = "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" ";
  const std::vector<std::pair<std::string, std::string>> part{{"3D/Objects/o.model", model("")}};
  EXPECT_TRUE(
      contains(refusal_for(file(model(production, "<item objectid=\"1\" p:path=\"/3D/Objects/o.model\"/>"), part)),
               "several files"));
  expect_equal_points(read_polygon_soup(file(model(production + "requiredextensions=\"p\""), part)), kModelPoints);
  EXPECT_TRUE(contains(refusal_for(file(model("requiredextensions=\"b\" xmlns:b=\"http://x/beamlattice/2017/02\""))),
                       "beamlattice"));
  EXPECT_FALSE(refusal_for(folder.file("b.3mf", zipped({{"a.txt", "hello"}}))).empty());
  const std::string whole = threemf_of(model(""));
  for (std::size_t size = 1; size < whole.size(); size += 37) {
    EXPECT_FALSE(refusal_for(folder.file("c.3mf", whole.substr(0, size))).empty()) << size;
  }
}

std::string with_text(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(AssimpReader, Refuses3mfOfWhoseNumbersAssimpWouldMakeOthers) {
  // assimp takes the beginning of 0,5 and 1x, and 0 for what is no number or not there.
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& what, const std::string& with) {
    const std::string text =
        with_text(model("", "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 2 3 4\"/>"), what, with);
    const std::string message = refusal_for(folder.file("a.3mf", threemf_of(text)));
    EXPECT_TRUE(contains(message, "a.3mf: ")) << with;
    EXPECT_TRUE(contains(message, " in '3D/3dmodel.model': expected ")) << with;
    // Nor is a part read that is not the model itself.
    EXPECT_TRUE(contains(refusal_for(folder.file("b.3mf", threemf_of(model(""), {{"3D/o.model", text}}))),
                         " in '3D/o.model': expected "))
        << with;
    return message;
  };
  for (const char* token : {"half", "1x", "0x1", "1.0D+01", "1,25", "", "nan", "inf", "1e400", "1 2", "&#49;"}) {
    EXPECT_TRUE(contains(refusal("y=\"1.25\"", "y=\"" + std::string(token) + "\""),
                         "'" + std::string(token) + "' is not a decimal number"));
  }
  for (const char* token : {"", "0x", "x", "1.5", "-1", "99999999999", "2e0"}) {
    EXPECT_TRUE(contains(refusal("v2=\"2\"", "v2=\"" + std::string(token) + "\""),
                         "'" + std::string(token) + "' is not a whole number from 0 to"));
  }
  for (const char* missing : {"x=\"1\" ", "y=\"1.25\" ", "z=\"0.1\"", "v1=\"0\" ", "v2=\"1\" ", " v3=\"1\"",
                              " id=\"1\"", " objectid=\"1\""}) {
    EXPECT_TRUE(contains(refusal(missing, ""), "a number is missing"));
  }
  EXPECT_TRUE(contains(refusal("objectid=\"1\"", "objectid=\"1a\""), "'1a' is not a whole number"));
  for (const char* transform : {"", "1 0 0 0 1 0 0 0 1 2 3", "1 0 0 0 1 0 0 0 1 2 3 4 5", "1 0 0 0 1 0 0 0 1 2 3 4x",
                                "1,0 0 0 0 1 0 0 0 1 2 3 4", "1,0,0,0,1,0,0,0,1,2,3,4"}) {
    EXPECT_TRUE(contains(refusal("1 0 0 0 1 0 0 0 1 2 3 4", transform), "' is not twelve decimal numbers"));
  }
  EXPECT_TRUE(contains(refusal("<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 2 3 4\"/>",
                               "<component objectid=\"1\" transform=\"1\"/><item objectid=\"1\"/>"),
                       "transform of '<component "));
}

TEST(AssimpReader, Refuses3mfWhoseObjectsAreNotThoseItAsksFor) {
  // assimp leaves out an item whose object is not there, and of two objects of one number the second.
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    EXPECT_FALSE(refusal_for(folder.file("b.3mf", threemf_of(model(""), {{"3D/o.model", text}}))).empty());
    return refusal_for(folder.file("a.3mf", threemf_of(text)));
  };
  const std::string one = "<item objectid=\"1\"/>";
  EXPECT_TRUE(contains(refusal(model("", one + "<item objectid=\"2\"/>")), "no object has the number"));
  EXPECT_TRUE(contains(refusal(model("", "<item objectid=\"0\"/>")), "no object has the number"));
  const auto with_resource = [&](const std::string& resource) {
    return with_text(model("", one), "</resources>", resource + "</resources>");
  };
  EXPECT_TRUE(
      contains(refusal(with_resource("<object id=\"2\"><components><component objectid=\"3\"/></components></object>")),
               "no object has the number"));
  for (const char* resource :
       {"<object id=\"1\"/>", "<object id=\"01\"/>", "<basematerials id=\"1\"/>", "<m:texture2dgroup id=\"1\"/>"}) {
    EXPECT_TRUE(contains(refusal(with_resource(resource)), "two resources have the same number")) << resource;
  }
  EXPECT_TRUE(contains(refusal(with_resource("</resources><resources>")), "two of what it may have one of"));
  EXPECT_TRUE(contains(refusal(with_text(model("", one), "</model>", "<build>" + one + "</build></model>")),
                       "two of what it may have one of"));
}

TEST(AssimpReader, Reads3mfOfWhichAnObjectComesAfterItsUse) {
  const TemporaryFolder folder;
  const std::string text = with_text(
      model("", "<item objectid=\"7\"/>"), "<resources>",
      "<resources><basematerials id=\"2\"/><object id=\"7\"><components><component objectid=\"01\"/></components>"
      "</object>");
  expect_equal_points(read_polygon_soup(folder.file("a.3mf", threemf_of(text))), kModelPoints);
}

TEST(AssimpReader, Reads3mfWithNumbersInEveryLegalForm) {
  const TemporaryFolder folder;
  std::string text = model("", "<item objectid=\"1\" transform=\" 1 0 0\n0 1 0\t0 0  1 -2.0 +3e0 4E+00 \"/>");
  text = with_text(text, "y=\"1.25\"", "y = '+.125e1'");
  text = with_text(text, "x=\"1\"", "x=\"1.\"");
  text = with_text(text, "v1=\"0\"", "v1='00'");
  text = with_text(text, "<vertices>", "<!-- <vertex x=\"half\"/> --><vertices>");
  for (const bool deflated : {false, true}) {
    const PolygonSoup soup = read_polygon_soup(folder.file("a.3mf", threemf_of(text, {}, deflated)));
    expect_equal_points(soup, {{-2, 3, 4}, {-1, 3, 4}, {-2, 4.25, 4}, {-2, 3, 4 + double{0.1F}}});
    EXPECT_EQ(soup.face_sizes.size(), 4U);
  }
}

TEST(AssimpReader, Refuses3mfThatUnpacksToMoreThanAnyModel) {
  const TemporaryFolder folder;
  const std::string text = with_text(model(""), "<vertices>", std::string(std::size_t{4} << 20U, ' ') + "<vertices>");
  EXPECT_TRUE(contains(refusal_for(folder.file("a.3mf", threemf_of(text))), "unpacks to more than a model does"));
  expect_equal_points(read_polygon_soup(folder.file("b.3mf", threemf_of(text, {}, false))), kModelPoints);
}

std::string amf() {
  std::string text = "<?xml version=\"1.0\"?><amf unit=\"inch\"><object id=\"0\"><mesh><vertices>";
  for (const char* p : {"<x>0</x><y>0</y><z>0</z>", "<x>1</x><y>0</y><z>0</z>", "<x>0</x><y>1.25</y><z>0</z>"}) {
    text += std::string("<vertex><coordinates>") + p + "</coordinates></vertex>";
  }
  return text + "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></amf>";
}

TEST(AssimpReader, NamesTheUnitOfGltfAndAmf) {
  const TemporaryFolder folder;
  const PolygonSoup body = icosahedron_soup();
  EXPECT_EQ(read_polygon_soup(folder.file("a.glb", glb(body))).unit, "m");
  EXPECT_EQ(read_polygon_soup(folder.file("a.gltf", gltf_embedded(body))).unit_metres, 1.0);
  const PolygonSoup soup = read_polygon_soup(folder.file("a.amf", amf()));
  EXPECT_EQ(soup.unit, "in");
  EXPECT_EQ(soup.points.size(), 3U);
}

// --- AMF

TEST(AssimpReader, RefusesAmfOfWhoseNumbersAssimpWouldMakeOthers) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& what, const std::string& with) {
    return refusal_for(folder.file("a.amf", with_text(amf(), what, with)));
  };
  for (const char* token :
       {"half", "", "1,5", "0x1", "1.0D+01", "1x", "nan", "inf", "1e400", "1 2", "&#49;", "1<!-- -->5", "<b/>1"}) {
    EXPECT_TRUE(contains(refusal("1.25", token), "' is not a decimal number (")) << token;
    const std::string instance = "<constellation id=\"c\"><instance objectid=\"0\"><deltay>" + std::string(token) +
                                 "</deltay></instance></constellation></amf>";
    EXPECT_TRUE(contains(refusal("</amf>", instance), "<deltay> in <instance>: expected a decimal number")) << token;
  }
  for (const char* token : {"", "-1", "1.5", "1x", "0x1", "4294967297", "1<!-- -->5"}) {
    EXPECT_TRUE(contains(refusal("<v2>1", "<v2>" + std::string(token)), "' is not a whole number from 0 to")) << token;
  }
  EXPECT_TRUE(contains(refusal("<y>1.25</y>", "<y/>"), "'' is not a decimal number"));
}

TEST(AssimpReader, RefusesAmfWithoutAllItsPartsOnce) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& what, const std::string& with) {
    return refusal_for(folder.file("a.amf", with_text(amf(), what, with)));
  };
  EXPECT_TRUE(contains(refusal("<y>1.25</y>", ""), "<coordinates> has 0 of <y>"));
  EXPECT_TRUE(contains(refusal("<y>1.25</y>", "<y>1.25</y><Y>3</Y>"), "<coordinates> has 2 of <y>"));
  EXPECT_TRUE(contains(refusal("<v3>2</v3>", ""), "<triangle> has 0 of <v3>"));
  EXPECT_TRUE(contains(refusal("<vertex>", "<vertex/><vertex>"), "<vertex> has 0 of <coordinates>"));
  EXPECT_TRUE(contains(refusal("<vertex>", "<vertex><coordinates/></vertex><vertex>"), "<coordinates> has 0 of <x>"));
  const std::string volume = "<volume><triangle><v1>0</v1><v2>2</v2><v3>1</v3></triangle></volume></mesh>";
  EXPECT_TRUE(contains(refusal("</mesh>", volume), "<mesh> has 2 of <volume>"));
  EXPECT_TRUE(contains(refusal("</mesh>", "<vertices/></mesh>"), "<mesh> has 2 of <vertices>"));
}

TEST(AssimpReader, RefusesAmfThatAssimpTakesForAnother) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& what, const std::string& with) {
    return refusal_for(folder.file("a.amf", with_text(amf(), what, with)));
  };
  const auto instance = [](const std::string& inside) {
    return "<constellation id=\"c\"><instance objectid=\"0\">" + inside + "</instance></constellation></amf>";
  };
  EXPECT_TRUE(contains(refusal("</amf>", instance("<rz>90</rz>")), "a turned instance"));
  EXPECT_TRUE(contains(refusal("</amf>", instance("<scale>2</scale>")), "a scaled instance"));
  EXPECT_TRUE(contains(refusal("</amf>", instance("<mirrorx>1</mirrorx>")), "a mirrored instance"));
  EXPECT_TRUE(contains(refusal("</vertex>", "<normal><nx>0</nx></normal></vertex>"), "a curved triangle"));
  EXPECT_TRUE(contains(refusal("</vertices>", "<edge><v1>0</v1></edge></vertices>"), "a curved triangle"));
  const std::string text = amf();
  const std::size_t begin = text.find("<object"), end = text.find("</amf>");
  const std::string object = text.substr(begin, end - begin);
  EXPECT_TRUE(contains(refusal("</amf>", object + "</amf>"), "not told apart by their names"));
  EXPECT_TRUE(contains(refusal("</amf>", with_text(object, " id=\"0\"", "") + "</amf>"), "not told apart"));

  const PolygonSoup two = read_polygon_soup(
      folder.file("b.amf", with_text(text, "</amf>", with_text(object, "\"0\"", "\"1\"") + "</amf>")));
  EXPECT_EQ(two.face_sizes.size(), 2U);
  std::vector<Vec3d> moved_points = read_polygon_soup(folder.file("b.amf", text)).points;
  for (Vec3d& p : moved_points) p = p + Vec3d{5, 0, -2};
  expect_equal_points(read_polygon_soup(folder.file(
                          "b.amf", with_text(text, "</amf>", instance("<deltax> 5\n</deltax><deltaz>-2.</deltaz>")))),
                      moved_points);
}

TEST(AssimpReader, RefusesAmfThatItCannotLookInto) {
  const TemporaryFolder folder;
  for (const bool deflated : {false, true}) {
    EXPECT_TRUE(contains(refusal_for(folder.file("a.amf", zipped({{"a.amf", amf()}}, deflated))), "unpack it"));
  }
  for (std::string wide : {"", "\xFF\xFE"}) {  // UTF-16, which assimp reads
    for (const char c : amf()) wide += {c, '\0'};
    EXPECT_TRUE(contains(refusal_for(folder.file("a.amf", wide)), " in UTF-"));
  }
}

// --- glTF

TEST(AssimpReader, FindsGltfBuffersWithEscapesInTheirNames) {
  const TemporaryFolder folder;
  const PolygonSoup body = triangulated(icosahedron_soup());
  std::filesystem::create_directory(folder.path() / "in %20 ner");
  for (const auto& [file, uri] :
       std::vector<std::pair<std::string, std::string>>{{"a b.bin", "a%20b.bin"},
                                                        {"c d.bin", "c d.bin"},
                                                        {"e%20f.bin", "e%20f.bin"},
                                                        {"g%h.bin", "g%25h.bin"},
                                                        {"in %20 ner/i.bin", "in%20%2520%20ner/i.bin"},
                                                        {"\xC3\xA9.bin", "%C3%A9.bin"},
                                                        {"k.bin", "\\u006B.bin"}}) {
    folder.file(file, gltf_buffer(body));
    const auto path = folder.file("a.gltf", gltf_text(body, uri));
    expect_equal_points(read_polygon_soup(path), body.points);
    const std::vector<std::filesystem::path> read = files_read_with(path);
    ASSERT_EQ(read.size(), 2U) << uri;
    EXPECT_TRUE(std::filesystem::equivalent(read[1], folder.path() / file)) << uri;
  }
}

TEST(AssimpReader, RefusesGltfThatNeedsWhatAssimpDoesNotHeed) {
  const TemporaryFolder folder;
  const PolygonSoup body = icosahedron_soup();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = gltf_embedded(body);
    text.replace(text.find(from), from.size(), to);
    return folder.file("a.gltf", text);
  };
  EXPECT_TRUE(
      contains(refusal_for(with("\"scene\": 0", "\"extensionsRequired\": [\"KHR_mesh_quantization\"], \"scene\": 0")),
               "'KHR_mesh_quantization'"));
  const PolygonSoup harmless =
      read_polygon_soup(with("\"scene\": 0", "\"extensionsRequired\": [\"KHR_materials_unlit\"], \"scene\": 0"));
  EXPECT_EQ(harmless.face_sizes.size(), 20U);
  EXPECT_TRUE(contains(refusal_for(with("\"2.0\"", "\"1.0\"")), "glTF 1"));
  EXPECT_TRUE(contains(refusal_for(with("\"2.0\"", "\"3.0\"")), "version '3.0', not 2"));
  EXPECT_TRUE(contains(refusal_for(with("\"buffers\": [", "\"buffers\": {")), "is no JSON"));
  std::string old = glb(body);
  old[4] = 1;
  EXPECT_TRUE(contains(refusal_for(folder.file("a.glb", old)), "glTF 1"));
  EXPECT_TRUE(
      contains(refusal_for(folder.file("b.gltf", R"({"asset": {}, "buffers": {"b": {"uri": "b.bin"}}})")), "glTF 1"));
}

}  // namespace
}  // namespace vex::tests
