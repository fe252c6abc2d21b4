#include "shapes/any_shape.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/numeric/errors.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

template <class E>
std::string message_of(const std::string& text) {
  try {
    parse_shape(text);
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

TEST(ParseShape, MakesEveryBodyOfTheList) {
  const std::vector<NamedShape> shapes = named_shapes();
  EXPECT_GE(shapes.size(), 16u);
  for (const NamedShape& shape : shapes) {
    std::string text = std::string(shape.name) + ":";
    for (const char c : shape.parameters) {
      if (c == ',') text += ",";
      if (c >= 'A' && c <= 'Z' && text.back() != '1') text += "1";
    }
    if (shape.name == "rounded") text = "rounded:1,box:1,1,1";
    if (shape.name == "spindle") text = "spindle:3,1";
    if (shape.parameters.starts_with("N,")) text.replace(text.find(':') + 1, 1, "5");
    EXPECT_EQ(parse_shape(text).kind, shape.name) << text;
    EXPECT_TRUE(names_a_shape(text));
    EXPECT_TRUE(std::ranges::any_of(
        every_test_body(), [&](std::string_view body) { return body.substr(0, body.find(':')) == shape.name; }))
        << "no suite runs over a " << shape.name;
  }
}

TEST(ParseShape, RoundsAnyBodyAndAddsRadiiUp) {
  const Body once = parse_shape("rounded:0.75,box:1,2,3");
  const Body twice = parse_shape("rounded:0.5,rounded:0.25,box:1,2,3");
  EXPECT_EQ(once.measures.volume, twice.measures.volume);
  EXPECT_EQ(once.body.support(Vec3d{1, 2, 3}).y, twice.body.support(Vec3d{1, 2, 3}).y);
  std::string deep = "sphere:1";
  for (int k = 0; k < 20000; ++k) deep.insert(0, "rounded:1,");
  EXPECT_NEAR(parse_shape(deep).body.circumradius(), 20001.0, 1e-9) << "however deep it is written";
}

TEST(ParseShape, ScalesEverySize) {
  for (const char* text : every_test_body()) {
    const Body one = parse_shape(text), four = parse_shape(text, 4.0);
    EXPECT_NEAR(four.measures.volume, 64.0 * one.measures.volume, 1e-13 * four.measures.volume) << text;
    EXPECT_NEAR(four.measures.surface_area, 16.0 * one.measures.surface_area, 1e-13 * four.measures.surface_area);
    const Vec3d dir{0.3, -0.5, 0.7};
    EXPECT_NEAR(norm(four.body.support(dir) - 4.0 * one.body.support(dir)), 0.0, 4.0 * one.body.support_error());
  }
  EXPECT_THROW(parse_shape("sphere:1e30", 1e30), InputError);
  EXPECT_THROW(parse_shape("rounded:1e30,sphere:1e10", 1e20), InputError);
}

TEST(VerticesOf, AreThePolytopeExactly) {
  std::mt19937_64 random(51);
  std::size_t n_polytopes = 0;
  for (const char* text : every_test_body()) {
    const Body shape = parse_shape(text);
    const std::vector<Vec3d> vertices = vertices_of(shape.body);
    if (vertices.empty()) {
      EXPECT_EQ(shape.n_faces, 0u) << text;
      continue;
    }
    ++n_polytopes;
    if (shape.measures.volume > 0.0) {
      EXPECT_GE(shape.n_faces, 4u);
      EXPECT_LE(shape.n_faces + vertices.size(), 182u);
    }
    for (int k = 0; k < 200; ++k) {
      const Vec3d dir = random_direction(random);
      double farthest = -1e300;
      for (const Vec3d& v : vertices) farthest = std::max(farthest, dot(v, dir));
      ASSERT_NEAR(farthest, dot(shape.body.support(dir), dir), 2.0 * shape.body.support_error()) << text;
    }
  }
  EXPECT_EQ(n_polytopes, 24u);
}

TEST(ParseShape, ReadsSizesInEveryUsualNotation) {
  EXPECT_EQ(parse_shape("sphere:1e-3").body.circumradius(), 1e-3);
  EXPECT_EQ(parse_shape("sphere:.5").body.circumradius(), 0.5);
  EXPECT_EQ(parse_shape("sphere:2.").body.circumradius(), 2.0);
}

TEST(ParseShape, RefusesSizesWithoutMeaning) {
  for (const char* text : {"sphere:0", "sphere:-1", "box:1,0,1", "sphere:inf", "sphere:nan", "ellipsoid:1,1,-0",
                           "sphere:1e-400", "sphere:1e400", "sphere:1e60", "box:1e-60,1,1", "capsule:1,1e46"}) {
    EXPECT_NE(message_of<InputError>(text), "") << text;
  }
}

TEST(ParseShape, TakesWholeNumbersOfSides) {
  EXPECT_EQ(vertices_of(parse_shape("prism:7,1,1").body).size(), 14u);
  EXPECT_EQ(vertices_of(parse_shape("prism:7,1,1", 3.0).body).size(), 14u) << "a number is no length";
  for (const char* text : {"prism:2,1,1", "prism:6.5,1,1", "pyramid:1001,1,1", "antiprism:-3,1,1", "prism:1e9,1,1"}) {
    EXPECT_NE(message_of<InputError>(text), "") << text;
  }
  EXPECT_NE(message_of<InputError>("prism:2,1,1").find("a whole number from 3 to 1000"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("prism:6,1").find("prism:N,A,H"), std::string::npos);
}

TEST(ParseShape, RefusesSizesThatDoNotGoTogether) {
  for (const char* text : {"lens:1,2.1", "lens:1,1e-10", "cut-sphere:1,1.1,0.5", "cut-sphere:1,0.5,1.1",
                           "spindle:2,1.1", "spindle:2,1e-10"}) {
    EXPECT_NE(message_of<InputError>(text), "") << text;
  }
  EXPECT_NE(message_of<InputError>("superball:0.4,1").find("(superball:0.4,1) - "), std::string::npos);
  EXPECT_EQ(parse_shape("superball:2,1", 3.0).body.support({1, 0, 0}).x, 3.0) << "an exponent is no length";
  EXPECT_EQ(parse_shape("lens:1,2").measures.volume, parse_shape("sphere:1").measures.volume);
}

TEST(ParseShape, ExplainsMalformedTexts) {
  EXPECT_NE(message_of<UsageError>("box:1,2").find("box:A,B,C"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("box:1,2,3,4").find("4 in"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:one").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:").find("sphere:R"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:1 ").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:1,").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("spher:1").find("sphere:R"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("rounded:1").find("rounded:r,BODY"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("rounded:1,").find("rounded:r,BODY"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("rounded:1,pear:1").find("no body of this name (pear:1)"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("rounded:,box:1,1,1").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<InputError>("rounded:0,box:1,1,1").find("not positive"), std::string::npos);
}

TEST(ParseShape, SaysWhatMayBeMeant) {
  const auto meant = [](const char* text) {
    const std::string message = message_of<UsageError>(text);
    const std::string begin = "did you mean ";
    const std::size_t at = message.find(begin);
    return at == std::string::npos ? "" : message.substr(at + begin.size(), message.find('?') - at - begin.size());
  };
  EXPECT_EQ(meant("cube:1"), "box:A,B,C");
  EXPECT_EQ(meant("spherocylinder:5,1"), "capsule:L,R");
  EXPECT_EQ(meant("Sphere:1"), "sphere:R");
  EXPECT_EQ(meant("SPHERE:1"), "sphere:R");
  EXPECT_EQ(meant("elipsoid:1,2,3"), "ellipsoid:A,B,C");
  EXPECT_EQ(meant("disk:1"), "disc:R");
  EXPECT_EQ(meant("truncated_cube:1"), "truncated-cube:E");
  EXPECT_EQ(meant("prisma:6,1,1"), "prism:N,A,H");
  EXPECT_EQ(meant("rounded:1,tetraedron:1"), "tetrahedron:E");
  EXPECT_EQ(meant("pear:1"), "");
  EXPECT_EQ(meant((std::string(100000, 'a') + ":1").c_str()), "");
}

TEST(NamesAShape, LeavesPathsAlone) {
  EXPECT_FALSE(names_a_shape("box.obj"));
  EXPECT_FALSE(names_a_shape("sphere"));
  EXPECT_FALSE(names_a_shape("./sphere:1"));
  EXPECT_FALSE(names_a_shape("rounded.obj"));
  EXPECT_TRUE(names_a_shape("rounded:1,a.obj"));
}

}  // namespace
}  // namespace vex
