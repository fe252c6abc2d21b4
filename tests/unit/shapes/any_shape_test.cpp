#include "shapes/any_shape.h"

#include <gtest/gtest.h>

#include "engine/numeric/errors.h"

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
  for (const auto& [text, kind] :
       std::initializer_list<std::pair<const char*, const char*>>{{"sphere:1", "sphere"},
                                                                  {"box:1,2,3", "box"},
                                                                  {"ellipsoid:1,2,3", "ellipsoid"},
                                                                  {"capsule:1,2", "capsule"}}) {
    EXPECT_EQ(parse_shape(text).kind, kind);
    EXPECT_TRUE(names_a_shape(text));
  }
  EXPECT_EQ(named_shapes().size(), 4u);
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

TEST(ParseShape, ExplainsMalformedTexts) {
  EXPECT_NE(message_of<UsageError>("box:1,2").find("box:A,B,C"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("box:1,2,3,4").find("4 in"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:one").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:1 ").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("sphere:1,").find("not a number"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("spher:1").find("sphere:R"), std::string::npos);
  EXPECT_NE(message_of<UsageError>("cylinder:1,1").find("not built yet"), std::string::npos);
}

TEST(NamesAShape, LeavesPathsAlone) {
  EXPECT_FALSE(names_a_shape("box.obj"));
  EXPECT_FALSE(names_a_shape("sphere"));
  EXPECT_FALSE(names_a_shape("./sphere:1"));
  EXPECT_TRUE(names_a_shape("needle:1")) << "planned ones are bodies too";
}

}  // namespace
}  // namespace vex
