// vex_scene: what is left of a run that a signal ends, wherever it is.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "tests/golden/scene.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class SceneInterrupt : public SceneTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    // Open for writing, so that whoever reads it waits.
    pipe_ = open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
    ASSERT_GE(pipe_, 0);
  }
  void TearDown() override { close(pipe_); }

  json document() const { return json::parse(read_file("result.json"), nullptr, false); }

  static bool works(pid_t process) {
    std::error_code error;
    const auto threads = std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", error);
    return !error && std::distance(begin(threads), end(threads)) >= 2;
  }

  void expect_nothing_known(const Finished& finished, int code) const {
    EXPECT_EQ(finished.exit_code, code) << finished.err;
    EXPECT_EQ(finished.out, "");
    const json found = document();
    ASSERT_TRUE(found.is_object()) << read_file("result.json");
    EXPECT_EQ(found.at("complete"), false);
    for (const char* key : {"bodies", "pairs", "clusters", "undecided", "shapes", "read_seconds"}) {
      EXPECT_TRUE(found.at(key).is_null()) << key;
    }
  }

 private:
  int pipe_ = -1;
};

TEST_F(SceneInterrupt, WhileTheSceneIsRead) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    std::filesystem::remove(folder() / "result.json");
    const Finished finished = run_and_signal({"pipe", "--json", "result.json"}, signal, works);
    expect_nothing_known(finished, code);
    EXPECT_NE(finished.err.find("interrupted before the scene was read"), std::string::npos) << finished.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"pipe", "result.json"}));
  }
}

TEST_F(SceneInterrupt, AFileThatTheSceneMayNameIsLeftAsItIs) {
  write_file("result.json", "a mesh, for all that is known");
  const Finished finished = run_and_signal({"pipe", "--json", "result.json"}, SIGINT, works);
  EXPECT_EQ(finished.exit_code, 130);
  EXPECT_EQ(read_file("result.json"), "a mesh, for all that is known");
  EXPECT_NE(finished.err.find("result.json is left as it was"), std::string::npos) << finished.err;
}

TEST_F(SceneInterrupt, WhileBodiesAreLoaded) {
  write_file("result.json", "of another run");
  const Finished finished = shell("\"$VEX\" --random 10,-,0.1 --format obj --json result.json < pipe & program=$!; " +
                                  kUntilItTakesSignals + "sleep 0.5; kill -TERM $program; wait $program");
  expect_nothing_known(finished, 143);
}

TEST_F(SceneInterrupt, WhileRowsWaitForTheirReader) {
  const std::string words = "\"$VEX\" --random 3000,box:1,1,1,2 --threads 1";
  const std::string all = shell(words + " --quiet").out;
  ASSERT_GT(all.size(), std::size_t{1} << 17) << "more than a pipe holds";
  for (const char* rows : {"", " --jsonl"}) {
    const std::string expected = *rows == '\0' ? all : shell(words + rows + " --quiet").out;
    const Finished finished = shell("mkfifo rows; " + words + rows +
                                    " --json result.json > rows & program=$!; exec 3< rows; "
                                    "dd bs=1 count=1 of=read.csv <&3 2> log; sleep 0.3; kill -TERM $program; "
                                    "wait $program; code=$?; cat <&3 >> read.csv; rm rows; exit $code");
    EXPECT_EQ(finished.exit_code, 143) << finished.err;
    EXPECT_NE(finished.err.find("interrupted while rows were written"), std::string::npos) << finished.err;
    const std::string read = read_file("read.csv");
    EXPECT_GT(read.size(), 10000u);
    EXPECT_LT(read.size(), expected.size());
    EXPECT_EQ(read.back(), '\n') << "a row is whole, or not there";
    EXPECT_EQ(read, expected.substr(0, read.size()));
    EXPECT_EQ(document().at("complete"), false);
    EXPECT_GT(document().at("pairs"), 10000) << "the answer is known";
  }
}

TEST_F(SceneInterrupt, WhileAFileWaitsForItsReader) {
  write_file("scene.csv", kSceneHeader + upright("box:1,1,1", 0, 0, 0) + upright("box:1,1,1", 0.75, 0, 0));
  const auto ended = [this](const std::string& words) {
    return shell("rm -f result.json rows; mkfifo unread; \"$VEX\" scene.csv " + words +
                 " > rows & program=$!; until test -s rows; do sleep 0.05; done; sleep 0.3; kill -TERM $program; "
                 "wait $program; code=$?; rm unread; exit $code");
  };
  for (const char* option : {"--svg", "--save"}) {
    const Finished finished = ended("--json result.json " + std::string(option) + " unread");
    EXPECT_EQ(finished.exit_code, 143) << finished.err;
    EXPECT_NE(finished.err.find("interrupted before unread was written"), std::string::npos) << finished.err;
    EXPECT_EQ(read_file("rows"), kPairHeader + "0,1,0,0,0\n");
    EXPECT_EQ(document().at("complete"), false);
    EXPECT_EQ(document().at("pairs"), 1);
  }
  EXPECT_EQ(ended("--json unread").exit_code, 143) << "the document itself";
}

}  // namespace
}  // namespace vex::golden
