// vex_pair: one pose, every query, against what is known in closed form.
#include <cmath>
#include <numbers>

#include "tests/golden/pair.h"

namespace vex::golden {
namespace {

using nlohmann::json;

// Where a curved body is met, the place is known to about the square root of what the time is known to.
constexpr double kCurved = 1e-6;

class PairOnePose : public PairQuery {
 protected:
  /// The row of a unit cube and a ball of radius 0.5 with its centre here.
  json cube_and_ball(const std::string& centre, Words words) const {
    words.insert(words.begin(), {"box:1,1,1", "sphere:0.5", "--translation", centre, "--jsonl", "--query"});
    return row_of(words);
  }
  json row_of(const Words& words) const {
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.err, "");
    return json::parse(finished.out);
  }
};

// The number under this key and its bounds, which must hold the true one and be near each other.
void expect_value(const json& row, const char* key, double truth, double tolerance = 1e-11) {
  SCOPED_TRACE(row.dump());
  ASSERT_TRUE(row.at(key).is_number()) << key;
  EXPECT_NEAR(row.at(key).get<double>(), truth, tolerance);
  const double lower = row.at("lower"), upper = row.at("upper");
  EXPECT_LE(lower, truth + 1e-15 * std::fabs(truth));
  EXPECT_GE(upper, truth - 1e-15 * std::fabs(truth));
  EXPECT_LE(upper - lower, tolerance);
}

void expect_vector(const json& row, const char* key, double x, double y, double z, double tolerance = 1e-9) {
  SCOPED_TRACE(std::string(key) + " of " + row.dump());
  ASSERT_TRUE(row.at(key).is_array());
  EXPECT_NEAR(row.at(key).at(0).get<double>(), x, tolerance);
  EXPECT_NEAR(row.at(key).at(1).get<double>(), y, tolerance);
  EXPECT_NEAR(row.at(key).at(2).get<double>(), z, tolerance);
}

void expect_null(const json& row, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(row.at(key).is_null()) << key << " of " << row.dump();
}

TEST_F(PairOnePose, Distance) {
  const json apart = cube_and_ball("1.5,0.25,0.125", {"distance"});
  EXPECT_EQ(apart.at("verdict"), "disjoint");
  expect_value(apart, "distance", 0.5);
  expect_vector(apart, "normal", 1, 0, 0);
  expect_vector(apart, "point_a", 0.5, 0.25, 0.125);
  expect_vector(apart, "point_b", 1, 0.25, 0.125);
  const json overlapping = cube_and_ball("0.75,0,0", {"distance"});
  EXPECT_EQ(overlapping.at("verdict"), "overlap");
  for (const char* key : {"distance", "lower", "upper"}) EXPECT_EQ(overlapping.at(key), 0.0);
  expect_null(overlapping, {"normal", "point_a", "point_b"});
}

TEST_F(PairOnePose, Depth) {
  const json overlapping = cube_and_ball("0.75,0.25,0.125", {"depth"});
  EXPECT_EQ(overlapping.at("verdict"), "overlap");
  expect_value(overlapping, "depth", 0.25);
  expect_vector(overlapping, "normal", 1, 0, 0);
  expect_vector(overlapping, "point_a", 0.5, 0.25, 0.125);
  expect_vector(overlapping, "point_b", 0.25, 0.25, 0.125);
  const json apart = cube_and_ball("1.5,0,0", {"depth"});
  EXPECT_EQ(apart.at("verdict"), "disjoint");
  for (const char* key : {"depth", "lower", "upper"}) EXPECT_EQ(apart.at(key), 0.0);
  expect_null(apart, {"normal", "point_a", "point_b"});
}

TEST_F(PairOnePose, SignedIsOneOfBoth) {
  const json apart = cube_and_ball("0,-1.5,0", {"signed"}), deep = cube_and_ball("0,-0.75,0", {"signed"});
  expect_value(apart, "distance", 0.5);
  expect_value(deep, "depth", 0.25);
  EXPECT_EQ(apart.at("signed_distance"), apart.at("distance"));
  EXPECT_EQ(deep.at("signed_distance"), -deep.at("depth").get<double>());
  EXPECT_FALSE(apart.contains("depth"));
  EXPECT_FALSE(deep.contains("distance"));
  for (const json& row : {apart, deep}) expect_vector(row, "normal", 0, -1, 0);
}

TEST_F(PairOnePose, ARayHitsWhatIsFirst) {
  const json a = cube_and_ball("1.5,0,0", {"ray", "--ray", "-3,0.25,0,2,0,0"});
  EXPECT_EQ(a.at("verdict"), "overlap");
  EXPECT_EQ(a.at("hit"), "a");
  expect_value(a, "parameter", 1.25);
  expect_vector(a, "normal", -1, 0, 0);
  expect_vector(a, "point_a", -0.5, 0.25, 0);
  expect_null(a, {"point_b"});
  const json b = cube_and_ball("1.5,0,0", {"ray", "--ray", "5,0,0,-2,0,0"});
  EXPECT_EQ(b.at("hit"), "b");
  expect_value(b, "parameter", 1.5);
  expect_vector(b, "normal", 1, 0, 0, kCurved);
  expect_vector(b, "point_b", 2, 0, 0, kCurved);
  expect_null(b, {"point_a"});
  const json inside = cube_and_ball("1.5,0,0", {"ray", "--ray", "1.25,0,0,-1,0,0"});
  EXPECT_EQ(inside.at("hit"), "b");
  EXPECT_EQ(inside.at("parameter"), 0.0);
  const json missed = cube_and_ball("1.5,0,0", {"ray", "--ray", "3,0,0,1,0,0"});
  EXPECT_EQ(missed.at("verdict"), "disjoint") << "a ray goes one way";
  expect_null(missed, {"parameter", "lower", "upper", "hit", "normal", "point_a", "point_b"});
}

TEST_F(PairOnePose, ABodyThatIsGrazedBeforeIsNotForgotten) {
  // The ray runs along a face of A, which it meets at 2.5, and into B behind it.
  const json behind = row_of(
      {"box:1,1,1", "sphere:1", "--translation", "9,0,0", "--query", "ray", "--ray", "-3,0,0.5,1,0,0", "--jsonl"});
  EXPECT_EQ(behind.at("verdict"), "overlap") << "one of them is hit for sure";
  EXPECT_LE(behind.at("lower").get<double>(), 2.5);
  EXPECT_GE(behind.at("upper").get<double>(), 2.5);
}

TEST_F(PairOnePose, ARayMeetsBAsItIsPlaced) {
  // Turned by an eighth about z, an edge of the cube looks against the ray.
  const json row = row_of({"sphere:0.5", "box:1,1,1", "--rotation", "0.92387953251128674,0,0,0.38268343236508977",
                           "--translation", "4,0,0", "--query", "ray", "--ray", "2,0,0,0.5,0,0", "--jsonl"});
  EXPECT_EQ(row.at("hit"), "b");
  expect_value(row, "parameter", 2.0 * (2.0 - std::numbers::sqrt2 / 2.0));
  expect_vector(row, "point_b", 4.0 - std::numbers::sqrt2 / 2.0, 0, 0);
}

TEST_F(PairOnePose, ACastEndsAtTheFirstContact) {
  const json met = cube_and_ball("3,0.25,0", {"cast", "--cast", "-4,0,0"});
  EXPECT_EQ(met.at("verdict"), "overlap");
  expect_value(met, "parameter", 0.5);
  expect_vector(met, "normal", 1, 0, 0, kCurved);
  expect_vector(met, "point_a", 0.5, 0.25, 0, kCurved);
  expect_vector(met, "point_b", 0.5, 0.25, 0, kCurved);
  const json never = cube_and_ball("3,0,0", {"cast", "--cast", "4,0,0"});
  EXPECT_EQ(never.at("verdict"), "disjoint");
  expect_null(never, {"parameter", "lower", "upper", "normal", "point_a", "point_b"});
  EXPECT_EQ(cube_and_ball("0.75,0,0", {"cast", "--cast", "4,0,0"}).at("parameter"), 0.0) << "it is there at once";
}

TEST_F(PairOnePose, TheAngularVelocityIsInDegrees) {
  const json straight = cube_and_ball("3,0,0", {"toi", "--toi", "-4,0,0,0,0,0"});
  expect_value(straight, "time", 0.5, 1e-6);
  expect_vector(straight, "normal", 1, 0, 0, 1e-3);
  // A needle along x, above a cube, turns about its middle until it meets the cube's edge.
  const json turning = row_of({"box:1,1,1", "needle:4", "--rotation", "1,0,1,0", "--translation", "0,2,0", "--query",
                               "toi", "--toi", "0,0,0,0,0,90", "--jsonl"});
  EXPECT_EQ(turning.at("verdict"), "overlap");
  expect_value(turning, "time", std::atan(3.0) / (0.5 * std::numbers::pi), 1e-6);
  const json never = cube_and_ball("3,0,0", {"toi", "--toi", "0,0,0,0,0,90"});
  EXPECT_EQ(never.at("verdict"), "disjoint");
  expect_null(never, {"time", "lower", "upper", "normal", "point_a", "point_b"});
  EXPECT_EQ(cube_and_ball("3,0,0", {"toi", "--toi", "0,0,0,0,0,0"}).at("verdict"), "disjoint") << "it stays";
}

TEST_F(PairOnePose, AManifoldOfTwoFaces) {
  const auto manifold = [this](const std::string& translation, const Words& more) {
    Words words = {"box:1,1,1", "box:1,1,1", "--translation", translation, "--query", "manifold", "--jsonl"};
    words.insert(words.end(), more.begin(), more.end());
    return row_of(words);
  };
  const json deep = manifold("0.875,0.25,0", {});
  expect_value(deep, "depth", 0.125);
  expect_vector(deep, "normal", 1, 0, 0);
  ASSERT_EQ(deep.at("contacts").size(), 4u) << deep.dump();
  for (const json& contact : deep.at("contacts")) {
    EXPECT_NEAR(contact.at("signed_distance").get<double>(), -0.125, 1e-12);
    EXPECT_NEAR(contact.at("point_a").at(0).get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(contact.at("point_b").at(0).get<double>(), 0.375, 1e-12);
    const double y = contact.at("point_a").at(1), z = contact.at("point_a").at(2);
    EXPECT_TRUE(std::fabs(y + 0.25) < 1e-12 || std::fabs(y - 0.5) < 1e-12) << contact.dump();
    EXPECT_NEAR(std::fabs(z), 0.5, 1e-12);
  }
  EXPECT_EQ(manifold("1.125,0,0", {}).at("contacts"), json::array());
  EXPECT_EQ(manifold("1.125,0,0", {"--margin", "0.25"}).at("contacts").size(), 4u);
  EXPECT_EQ(manifold("1.125,0,0", {"--margin", "0.0625"}).at("contacts"), json::array());
}

TEST_F(PairOnePose, AMarginCountsAsContact) {
  const auto verdict = [this](const Words& bodies, const std::string& margin) {
    Words words = bodies;
    words.insert(words.end(), {"--translation", "1.125,0,0", "--margin", margin, "--certificate", "--jsonl"});
    const json row = row_of(words);
    EXPECT_EQ(row.at("reproven"), true) << row.dump();
    return row.at("verdict").get<std::string>();
  };
  // The gap is 2^-3 exactly; the other number is the double before it.
  for (const Words& bodies : {Words{"box:1,1,1", "box:1,1,1"}, Words{"sphere:0.5", "box:1,1,1"},
                              Words{"box:1,1,1", "sphere:0.5"}, Words{"sphere:0.5", "sphere:0.5"}}) {
    SCOPED_TRACE(bodies[0] + " " + bodies[1]);
    EXPECT_EQ(verdict(bodies, "0.125"), "overlap");
    EXPECT_EQ(verdict(bodies, "0.0625"), "disjoint");
    EXPECT_EQ(verdict(bodies, "0"), "disjoint");
  }
  for (const Words& bodies :
       {Words{"box:1,1,1", "box:1,1,1"}, Words{"sphere:0.5", "box:1,1,1"}, Words{"box:1,1,1", "sphere:0.5"}}) {
    EXPECT_EQ(verdict(bodies, "0x1.fffffffffffffp-4"), "disjoint") << "no radii are added, and nothing is rounded";
  }
}

// With radii of both bodies, a sum of one and the margin may be rounded: then the other one's is taken, or both sides.
TEST_F(PairOnePose, AMarginIsNotRounded) {
  const auto row = [this](const Words& bodies, const std::string& centre, const std::string& margin) {
    Words words = bodies;
    words.insert(words.end(), {"--translation", centre, "--margin", margin, "--certificate", "--jsonl"});
    return row_of(words);
  };
  const auto both_ways = [](const std::string& a, const std::string& b) {
    return std::array{Words{a, b}, Words{b, a}};
  };
  for (const Words& bodies : both_ways("sphere:1e10", "sphere:1")) {
    const json near = row(bodies, "10000000001,31.6,0", "1e-7");
    EXPECT_EQ(near.at("verdict"), "overlap") << "the gap is 4.99e-8: " << near;
    EXPECT_EQ(near.at("reproven"), true);
    EXPECT_EQ(row(bodies, "10000000001,31.6,0", "4e-8").at("verdict"), "disjoint");
  }
  for (const Words& bodies : both_ways("sphere:0.1", "sphere:0.2")) {
    const json far = row(bodies, "0.6,6.9e-9,0", "0.3");
    EXPECT_EQ(far.at("verdict"), "disjoint") << "the gap is larger by 1.2e-17: " << far;
    EXPECT_EQ(far.at("reproven"), true);
  }
  // 0.1 + 0.3 is a tie between two doubles, and the gap is the margin: neither side proves it.
  const json open = row({"sphere:0.1", "sphere:0.1"}, "0.5,0,0", "0.3");
  EXPECT_EQ(open.at("verdict"), "undecided") << open;
  EXPECT_EQ(open.at("undecided_reason"), "rounding");
  EXPECT_LE(open.at("lower").get<double>(), 0.3) << "the bounds are of the gap of the bodies themselves";
  EXPECT_GE(open.at("upper").get<double>(), 0.3);
  EXPECT_LT(open.at("upper").get<double>() - open.at("lower").get<double>(), 1e-15);
}

TEST_F(PairOnePose, AnUndecidedMarginBoundsTheGapWithoutIt) {
  const Words words = {"ellipsoid:1,1,1", "ellipsoid:1,1,1", "--translation", "2.25,0,0", "--margin", "0.25"};
  Words as_json = words;
  as_json.emplace_back("--jsonl");
  const json row = row_of(as_json);
  ASSERT_EQ(row.at("verdict"), "undecided") << row;
  EXPECT_LE(row.at("lower").get<double>(), 0.25);
  EXPECT_GE(row.at("upper").get<double>(), 0.25);
  EXPECT_LE(row.at("upper").get<double>() - row.at("lower").get<double>(), 1e-9);
  const std::string report = run(words).out;
  EXPECT_EQ(report.rfind("A ellipsoid:1,1,1 and B ellipsoid:1,1,1, with a margin of 0.25: UNDECIDED\n", 0), 0u);
  EXPECT_NE(report.find("their gap is the margin to within rounding"), std::string::npos) << report;
}

TEST_F(PairOnePose, WhichBodyARayHitsFirstIsProven) {
  const auto ray = [this](const std::string& centre, const std::string& numbers) {
    return row_of(
        {"cylinder:1,1", "sphere:1.5", "--translation", centre, "--query", "ray", "--ray", numbers, "--jsonl"});
  };
  const json either = ray("0.499999999999997,0,0", "-3,0,0,1,0,0");
  EXPECT_EQ(either.at("verdict"), "overlap");
  EXPECT_EQ(either.at("hit"), "either") << either;
  expect_value(either, "parameter", 2.0);
  EXPECT_TRUE(either.at("normal").is_array());
  EXPECT_EQ(ray("0.4999,0,0", "-3,0,0,1,0,0").at("hit"), "b");
  EXPECT_EQ(ray("0.5001,0,0", "-3,0,0,1,0,0").at("hit"), "a");
  EXPECT_EQ(ray("0.5,0,0", "0,0,0,1,0,0").at("hit"), "either") << "it starts in both";
}

TEST_F(PairOnePose, NoZeroHasASign) {
  for (const Words& form : {Words{"--jsonl"}, Words{"--csv"}, Words{}}) {
    for (const Words& query : {Words{"manifold"}, Words{"signed"}, Words{"signed", "--certificate"}}) {
      Words words = {"rounded:0.1,plate:1,1", "plate:1,1", "--translation", "0.25,0,0.1", "--query"};
      words.insert(words.end(), query.begin(), query.end());
      words.insert(words.end(), form.begin(), form.end());
      const std::string text = run(words).out;
      EXPECT_NE(text.find("0.25"), std::string::npos) << text;
      for (std::size_t at = text.find("-0"); at != std::string::npos; at = text.find("-0", at + 1)) {
        const bool is_exponent = at > 0 && text[at - 1] == 'e';
        EXPECT_TRUE(is_exponent || text[at + 2] == '.') << text.substr(at, 20);
      }
    }
  }
}

TEST_F(PairOnePose, ACertificateOfADistance) {
  for (const char* query : {"distance", "depth", "signed"}) {
    for (const char* centre : {"1.5,0,0", "0.75,0,0"}) {
      const json row = cube_and_ball(centre, {query, "--certificate"});
      EXPECT_EQ(row.at("reproven"), true) << row.dump();
      EXPECT_TRUE(row.at("certificate").is_object());
    }
  }
}

TEST_F(PairOnePose, MotionsHaveAnEnd) {
  // They meet at 0.5.
  for (const Words& query : {Words{"cast", "--cast", "-1,0,0"}, Words{"toi", "--toi", "-1,0,0,0,0,30"},
                             Words{"ray", "--ray", "-1,0.1,0.2,1,0,0"}}) {
    const auto asked_until = [&](const char* until) {
      Words words = query;
      words.insert(words.end(), {"--until", until, "--certificate"});
      const json row = cube_and_ball("1.5,0,0", words);
      EXPECT_EQ(row.at("reproven"), true) << row.dump();
      return row.at("verdict").get<std::string>();
    };
    EXPECT_EQ(asked_until("0.25"), "disjoint");
    EXPECT_EQ(asked_until("0"), "disjoint");
    EXPECT_EQ(asked_until("0.75"), "overlap");
    EXPECT_EQ(asked_until("1e300"), "overlap");
  }
}

TEST_F(PairOnePose, BothBodiesMove) {
  // Towards each other, 1 apart, at 1 and 3; and the same by the motion of one.
  json row = cube_and_ball("2,0,0", {"toi", "--toi", "-3,0,0,0,0,90", "--toi-a", "1,0,0,0,0,0", "--certificate"});
  EXPECT_EQ(row.at("reproven"), true);
  expect_value(row, "time", 0.25);
  expect_vector(row, "point_a", 0.75, 0, 0);
  expect_vector(row, "point_b", 0.75, 0, 0);
  expect_vector(row, "normal", 1, 0, 0);
  // A cube whose edge comes round: it is sqrt(1/2) from the axis, and meets the ball once 1/2 from its centre.
  row = cube_and_ball("1.2,0,0", {"toi", "--toi", "0,0,0,0,0,0", "--toi-a", "0,0,0,0,0,45", "--certificate"});
  EXPECT_EQ(row.at("reproven"), true);
  const double before = std::acos(1.69 / (2.4 * std::sqrt(0.5)));
  EXPECT_NEAR(row.at("time").get<double>(), 1.0 - before / std::atan(1.0), 1e-11);
  EXPECT_NEAR(row.at("point_a").at(0).get<double>(), std::sqrt(0.5) * std::cos(before), 1e-9);
  EXPECT_NEAR(row.at("point_a").at(1).get<double>(), -std::sqrt(0.5) * std::sin(before), 1e-9);
  row = cube_and_ball("1.25,0,0", {"toi", "--toi", "0,0,0,0,0,0", "--toi-a", "0,0,0,0,0,45", "--certificate"});
  EXPECT_EQ(row.at("verdict"), "disjoint");
  EXPECT_EQ(row.at("reproven"), true);
  // Side by side for ever, both turning: nothing but an end ends it.
  row = cube_and_ball("1.25,0,0",
                      {"toi", "--toi", "1,0,0,0,0,30", "--toi-a", "1,0,0,0,0,45", "--until", "20", "--certificate"});
  EXPECT_EQ(row.at("verdict"), "disjoint");
  EXPECT_EQ(row.at("reproven"), true);
}

TEST_F(PairOnePose, OfPolytopesTheEndIsOneOfTheTimes) {
  const auto verdict = [this](const char* until) {
    return row_of({"box:1,1,1", "box:1,1,1", "--translation", "2,0.25,0.125", "--query", "cast", "--cast", "-2,0,0",
                   "--until", until, "--jsonl"})
        .at("verdict")
        .get<std::string>();
  };
  EXPECT_EQ(verdict("0.5"), "overlap");
  EXPECT_EQ(verdict("0.49999999999999994"), "disjoint");
}

TEST_F(PairOnePose, ADistanceThatIsLargeEnoughIsNotLookedForFurther) {
  const auto row = [this](const char* most) {
    return row_of({"ellipsoid:1,2,3", "cone:1,0.5", "--translation", "5,4,1", "--rotation", "0.9,0.1,0.2,0.3",
                   "--query", "distance", "--max-distance", most, "--jsonl", "--certificate"});
  };
  const json all = row("100"), some = row("1");
  EXPECT_GT(some.at("lower").get<double>(), 1.0);
  EXPECT_LT(some.at("iterations").get<int>(), all.at("iterations").get<int>());
  EXPECT_EQ(some.at("reproven"), true);
  EXPECT_LE(some.at("lower").get<double>(), all.at("upper").get<double>());
  EXPECT_GE(some.at("upper").get<double>(), all.at("lower").get<double>());
}

TEST_F(PairOnePose, ACertificateOfEveryQuery) {
  const std::vector<Words> queries = {{"manifold"},
                                      {"cast", "--cast", "-1,0,0"},
                                      {"cast", "--cast", "1,0,0"},
                                      {"toi", "--toi", "-1,0,0,0,0,30"},
                                      {"toi", "--toi", "1,0,0,0,0,30"},
                                      {"ray", "--ray", "-3,0.1,0.2,1,0,0"},
                                      {"ray", "--ray", "-3,0.1,0.2,-1,0,0"}};
  for (const Words& query : queries) {
    for (const char* centre : {"1.5,0,0", "0.75,0,0"}) {
      Words words = query;
      words.push_back("--certificate");
      const json row = cube_and_ball(centre, words);
      EXPECT_EQ(row.at("reproven"), true) << row.dump();
      EXPECT_TRUE(row.at("certificate").is_object());
      words.insert(words.begin(), {"box:1,1,1", "sphere:0.5", "--translation", centre, "--query"});
      const Finished in_words = run(words);
      EXPECT_NE(in_words.out.find("yes, in exact arithmetic"), std::string::npos) << in_words.out;
      words.push_back("--csv");
      const Finished columns = run(words);
      EXPECT_NE(columns.out.find(",reproven\n"), std::string::npos) << columns.out;
      EXPECT_NE(columns.out.find(",true\n"), std::string::npos) << columns.out;
    }
  }
}

TEST_F(PairOnePose, InWords) {
  const auto report = [this](const std::string& translation, Words words) {
    words.insert(words.begin(), {"box:1,1,1", "sphere:0.5", "--translation", translation, "--query"});
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished.out;
  };
  const auto expect_parts = [](const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  };
  const std::string a = "A box:1,1,1", b = "B sphere:0.5";
  expect_parts(report("1.5,0,0", {"distance"}), {a + " and " + b + " are DISJOINT", "\n   distance  ",
                                                 "\n      between ", "normal, from A towards B          (1, 0, 0)\n",
                                                 "point of A ", "point of B, in A's frame", "support calls"});
  expect_parts(report("0.75,0,0", {"signed"}), {"OVERLAP", "\n   depth  "});
  expect_parts(report("1.5,0,0", {"ray", "--ray", "-3,0,0,2,0,0"}),
               {"The ray HITS " + a + "\n", "\n   parameter  ", "normal, out of the body"});
  expect_parts(report("1.5,0,0", {"ray", "--ray", "-3,0,0,-2,0,0"}), {"The ray MISSES " + a + " and " + b});
  expect_parts(report("1.5,0,0", {"cast", "--cast", "-1,0,0"}), {b + " MEETS " + a, "\n   parameter  "});
  expect_parts(report("1.5,0,0", {"toi", "--toi", "1,0,0,0,0,0"}), {b + " NEVER MEETS " + a});
  expect_parts(report("0.75,0,0", {"ray", "--ray", "-0.4,0,0,1,0,0"}),
               {"The ray HITS " + a + ", in which it starts\n", "\n   parameter                         0, exactly\n"});
  expect_parts(report("0.75,0,0", {"ray", "--ray", "0.5,0,0,1,0,0"}),
               {"The ray HITS " + a + " or " + b + ": it starts in one of them, or in both\n"});
  expect_parts(report("0.25,0,0", {"ray", "--ray", "0.25,3,0,0,-1,0"}), {": which one first is within rounding\n"});
  for (const Words& motion : {Words{"cast", "--cast", "1,0,0"}, Words{"toi", "--toi", "1,0,0,0,0,9"}}) {
    expect_parts(report("0.75,0,0", motion),
                 {b + " MEETS " + a + " at the start: they share a point before it moves\n", " 0, exactly\n"});
  }
  expect_parts(report("0.75,0,0", {"manifold"}), {"OVERLAP", "\n   contacts ", "signed distance"});
  expect_parts(report("1.5,0,0", {"overlap", "--margin", "1"}), {", with a margin of 1, OVERLAP"});
  expect_parts(report("1.5,0,0", {"overlap", "--margin", "0.25"}), {", with a margin of 0.25, are DISJOINT"});
}

TEST_F(PairOnePose, TheDocumentSaysWhatWasAsked) {
  const auto document = [this](const Words& words) {
    Words all = {"box:1,1,1", "box:1,1,1", "--translation", "3,0,0"};
    all.insert(all.end(), words.begin(), words.end());
    const json found = json_of(all);
    EXPECT_EQ(found.at("rows"), 1);
    EXPECT_EQ(found.at("results").size(), 1u);
    return found;
  };
  EXPECT_EQ(document({}).at("query"), "overlap");
  EXPECT_EQ(document({"--margin", "0.5"}).at("margin"), 0.5);
  EXPECT_EQ(document({"--query", "signed"}).at("query"), "signed");
  EXPECT_EQ(document({"--query", "ray", "--ray", "1,2,3,4,5,6"}).at("ray"), (json{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(document({"--query", "cast", "--cast", "1,2,3"}).at("cast"), (json{1.0, 2.0, 3.0}));
  const json impact = document({"--query", "toi", "--toi", "1,0,0,0,0,90"});
  EXPECT_EQ(impact.at("toi"), (json{1.0, 0.0, 0.0, 0.0, 0.0, 90.0})) << "in degrees, as it was given";
  EXPECT_EQ(impact.at("verdicts").at("disjoint"), 1);
  EXPECT_TRUE(impact.at("results").at(0).at("time").is_null()) << "JSON has no infinity";
}

}  // namespace
}  // namespace vex::golden
