// vex_pair: what it refuses, with which exit code, and what it says.
#include "tests/golden/pair.h"

namespace vex::golden {
namespace {

TEST_F(PairRefusal, AHeaderThatIsNone) {
  const auto expect_refused = [this](const std::string& content, const std::string& part) {
    write_file("poses.csv", content);
    expect_wrong({"--poses", "poses.csv", "--json", "result.json"}, 3, part);
  };
  expect_refused("", "the file of poses is empty (poses.csv)");
  expect_refused("0,0,0,1,0,0,0\n", "poses.csv, line 1: the header is missing");
  expect_refused("tx,ty,tz,qx,qy,qz,qw\n0,0,0,0,0,0,1\n",
                 "line 1: not a header of poses (\"qx\" where qw is expected)");
  expect_refused("\n" + kQuaternionHeader, "line 1: not a header");
  expect_wrong({"--poses", "missing.csv"}, 3, "cannot be read (missing.csv: No such file");
  expect_wrong({"--poses", "."}, 3, "Is a directory");
  expect_wrong({"--poses", "-"}, 3, "the file of poses is empty (standard input)");
  EXPECT_EQ(files(), std::vector<std::string>{"poses.csv"});
  write_file("poses.csv", "\xEF\xBB\xBF tx , ty , tz , qw , qx , qy , qz\r\n 0.5 , 0 , 0 , 1 , 0 , 0 , 0 \r\n\r\n");
  const Finished tolerated = cubes({"--poses", "poses.csv", "--quiet", "--csv"});
  EXPECT_EQ(tolerated.exit_code, 0) << tolerated.err;
  EXPECT_EQ(lines_of(tolerated.out).size(), 2u);
}

TEST_F(PairRefusal, ExactlyOneWayToGiveAPose) {
  const std::string unit = "1,0,0,0,1,0,0,0,1,0,0,0";
  expect_wrong({}, 2, "no pose is given");
  expect_wrong({"--matrix", unit, "--translation", "0,0,0"}, 2, "more than one way (--matrix --rotation or");
  expect_wrong({"--matrix", unit, "--poses", "poses.csv"}, 2, "more than one way");
  expect_wrong({"--rotation", "1,0,0,0", "--poses", "-"}, 2, "more than one way");
  expect_wrong({"--matrix", unit, "--keep-going"}, 2, "goes with --poses");
  expect_refusal(run({"box:1,1,1", "--matrix", unit}), 2, "nothing is given for B", "vex_pair");
}

TEST_F(PairRefusal, APoseThatIsNone) {
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,1"}, 2, "wrong number of numbers (9 for --matrix)");
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,one,0,0,0"}, 2, "not a number (\"one\" for --matrix)");
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,nan,0,0,0"}, 3, "not finite");
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,1,0,0,inf"}, 3, "not finite");
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,1.00001,0,0,0"}, 3, "not a rotation");
  expect_wrong({"--matrix", "1,0,0,0,1,0,0,0,-1,0,0,0"}, 3, "a reflection is no pose");
  expect_wrong({"--rotation", "0,0,0,0"}, 3, "a quaternion of length 0");
  expect_wrong({"--rotation", "inf,0,0,0"}, 3, "not finite");
  expect_wrong({"--rotation", "1,0,0"}, 2, "wrong number of numbers (3 for --rotation)");
  expect_wrong({"--translation", "0,0"}, 2, "wrong number of numbers (2 for --translation)");
  expect_wrong({"--translation", "0,0,1e400"}, 3, "out of the range of doubles");
  expect_wrong({"--translation", ""}, 2, "empty");
}

TEST_F(PairRefusal, AQueryAndItsOptionsBelongTogether) {
  const auto expect_wrong_query = [this](Words words, int exit_code, const std::string& part) {
    words.insert(words.begin(), {"--translation", "3,0,0"});
    expect_wrong(words, exit_code, part);
  };
  expect_wrong_query({"--query", "volume"}, 2, "not a choice (\"volume\" for --query)");
  expect_wrong_query({"--query", "ray"}, 2, "not given (--query ray) - add --ray ox,oy,oz,dx,dy,dz");
  expect_wrong_query({"--query", "cast"}, 2, "not given (--query cast) - add --cast dx,dy,dz");
  expect_wrong_query({"--query", "toi"}, 2, "not given (--query toi) - add --toi vx,vy,vz,wx,wy,wz");
  expect_wrong_query({"--ray", "0,0,0,1,0,0"}, 2, "(--ray with --query overlap) - add --query ray");
  expect_wrong_query({"--query", "distance", "--cast", "1,0,0"}, 2, "(--cast with --query distance)");
  expect_wrong_query({"--query", "ray", "--ray", "0,0,0,1,0,0", "--toi", "1,0,0,0,0,0"}, 2, "(--toi with --query ray)");
  expect_wrong_query({"--query", "signed", "--margin", "0.1"}, 2, "(--margin with --query signed)");
  expect_wrong_query({"--until", "1"}, 2, "an end goes with motions (--until with --query overlap)");
  expect_wrong_query({"--query", "cast", "--cast", "1,0,0", "--until", "-1"}, 2, "an end below 0 (-1 for --until)");
  expect_wrong_query({"--query", "cast", "--cast", "1,0,0", "--until", "nan"}, 3, "not finite (\"nan\" for --until)");
  expect_wrong_query({"--toi-a", "1,0,0,0,0,0"}, 2, "(--toi-a with --query overlap)");
  expect_wrong_query({"--max-distance", "1"}, 2, "(--max-distance with --query overlap)");
  expect_wrong_query({"--margin", "-1"}, 2, "a margin below 0 (-1 for --margin)");
  expect_wrong_query({"--margin", "inf"}, 3, "not finite (\"inf\" for --margin)");
  expect_wrong_query({"--query", "ray", "--ray", "0,0,0,1,0"}, 2, "wrong number of numbers (5 for --ray)");
  expect_wrong_query({"--query", "ray", "--ray", "0,0,0,0,0,0"}, 3, "a direction of length 0 (0,0,0 for --ray)");
  expect_wrong_query({"--query", "cast", "--cast", "0,0,0"}, 3, "a direction of length 0 (0,0,0 for --cast)");
  expect_wrong_query({"--query", "cast", "--cast", "nan,0,0"}, 3, "not finite (\"nan\" for --cast)");
  expect_wrong_query({"--query", "toi", "--toi", "0,0,0,0,0,inf"}, 3, "not finite (\"inf\" for --toi)");
  EXPECT_EQ(cubes({"--translation", "3,0,0", "--query", "toi", "--toi", "0,0,0,0,0,0"}).exit_code, 0)
      << "rest is a motion, too";
}

TEST_F(PairRefusal, AResultThatOverflows) {
  const std::string far = "1e308,1.5e308,0";
  for (const char* query : {"distance", "depth", "signed", "manifold"}) {
    expect_wrong({"--translation", far, "--query", query, "--jsonl"}, 3,
                 "a translation out of range (1e308, and 1e300");
  }
  EXPECT_EQ(cubes({"--translation", far}).exit_code, 0) << "an overlap has no number that overflows";
  EXPECT_EQ(cubes({"--translation", "1e300,-1e300,0", "--query", "signed"}).exit_code, 0);
  const std::string late = "a contact so late that its time overflows";
  expect_wrong({"--translation", "3,3,3", "--query", "ray", "--ray=-2,0,0,1e-320,0,0"}, 3, late);
  expect_wrong({"--translation", "3,3,3", "--query", "cast", "--cast=-5e-324,-5e-324,-5e-324"}, 3, late);
  expect_wrong({"--translation", "3,3,3", "--query", "toi", "--toi=-5e-324,-5e-324,-5e-324,0,0,0"}, 3, late);
  expect_wrong({"--translation", "3,3,3", "--query", "ray", "--ray=-2e300,0,0,1,0,0"}, 3, "(-2e300 for --ray, and");
  expect_wrong({"--translation", "3,3,3", "--query", "cast", "--cast=0,0,1e301"}, 3, "(1e301 for --cast, and");
  expect_wrong({"--translation", "3,3,3", "--query", "toi", "--toi=0,0,0,0,0,1e301"}, 3, "(1e301 for --toi, and");
  write_file("poses.csv", kQuaternionHeader + "3,0,0,1,0,0,0\n1e308,0,0,1,0,0,0\n3,0,0,1,0,0,0\n");
  const Words stream = {"--poses", "poses.csv", "--query", "signed", "--jsonl"};
  const Finished stopped = cubes(stream);
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_EQ(objects_of(stopped.out).size(), 1u);
  EXPECT_NE(stopped.err.find("poses.csv, line 3, index 1: a translation out of range"), std::string::npos);
  Words words = stream;
  words.emplace_back("--keep-going");
  const Finished going = cubes(words);
  EXPECT_EQ(going.exit_code, 3);
  const std::vector<nlohmann::json> rows = objects_of(going.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].at("error").get<std::string>().rfind("line 3: a translation out of range", 0), 0u);
  EXPECT_EQ(rows[2].at("distance"), rows[0].at("distance"));
}

TEST_F(PairRefusal, OptionsThatMeanNothing) {
  expect_wrong({"--translatoin", "0,0,0"}, 2, "did you mean --translation?");
  expect_wrong({"--pose", "poses.csv"}, 2, "did you mean --poses?");
  expect_wrong({"--translation", "0,0,0", "--threads", "0"}, 2, "--threads");
  expect_wrong({"--translation", "0,0,0", "--seed", "x"}, 2, "--seed");
  expect_wrong({"--translation", "0,0,0", "--scale", "0"}, 2, "--scale");
  expect_wrong({"--translation", "0,0,0", "--max-z", "6"}, 2, "not understood (--max-z 6)");
  expect_wrong({"--translation", "0,0,0", "--jsonl", "--csv"}, 2, "two forms of the same rows");
  expect_wrong({"--translation", "0,0,0", "--jsonl", "--json", "-"}, 2, "standard output is asked for twice");
  expect_wrong({"--translation", "0,0,0", "--csv", "--dump-vertices"}, 2, "no place for a body's vertices");
  expect_refusal(run({"sphere:1", "sphere:2", "--translation", "0,0,0", "--dump-vertices"}), 2, "not a polytope",
                 "vex_pair");
  EXPECT_EQ(cubes({"--translation", "0,0,0", "--seed", "7"}).exit_code, 0) << "every program takes it";
}

TEST_F(PairRefusal, AnOutputThatWouldCostAnInput) {
  write_file("poses.csv", kQuaternionHeader);
  expect_wrong({"--poses", "poses.csv", "--json", "poses.csv"}, 2, "is an input");
  expect_wrong({"--poses", "poses.csv", "--json", "./poses.csv"}, 2, "is an input");
  expect_wrong({"--poses", "poses.csv", "--json", "cube.obj"}, 2, "extension of a mesh");
  EXPECT_EQ(read_file("poses.csv"), kQuaternionHeader);
}

}  // namespace
}  // namespace vex::golden
