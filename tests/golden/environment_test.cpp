// The world around the program: closed streams, full disks, readers that go away, folders that cannot be written.
#include <sys/stat.h>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Environment : public ProgramTest {
 protected:
  void expect_fault(const std::string& line, const std::string& part_of_message) const {
    SCOPED_TRACE(line);
    const Finished finished = shell(line);
    EXPECT_EQ(finished.exit_code, 1) << finished.err;
    EXPECT_EQ(finished.err.rfind("vex_mesh: ", 0), 0u) << finished.err;
    EXPECT_NE(finished.err.find(part_of_message), std::string::npos) << finished.err;
  }
};

TEST_F(Environment, AFullDiskIsAFault) {
  expect_fault("\"$VEX\" box:1,1,1 --trials 100 > /dev/full", "standard output cannot be written");
  expect_fault("\"$VEX\" box:1,1,1 --trials 100 --json - > /dev/full", "standard output cannot be written");
  expect_fault("\"$VEX\" --help > /dev/full", "standard output cannot be written");
  expect_fault("\"$VEX\" --version > /dev/full", "standard output cannot be written");
  expect_fault("\"$VEX\" box:1,1,1 --trials 100 --quiet --json /dev/full", "/dev/full");
  EXPECT_EQ(shell("\"$VEX\" box:1,1,1 --trials 100 --quiet > /dev/full").exit_code, 0) << "nothing was to be written";
}

TEST_F(Environment, TheReportIsPrintedEvenIfTheDocumentCannotBeWritten) {
  const Finished finished = run({"box:1,1,1", "--trials", "100", "--json", "/dev/full"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_NE(finished.out.find("Monte Carlo"), std::string::npos);
}

TEST_F(Environment, TheDocumentIsWrittenEvenIfTheReportCannotBe) {
  EXPECT_EQ(shell("\"$VEX\" box:1,1,1 --trials 100 --json result.json > /dev/full").exit_code, 1);
  EXPECT_TRUE(json::accept(read_file("result.json")));
}

TEST_F(Environment, ClosedStreamsAreNotMistakenForFiles) {
  write_file("cube.obj", cube_obj());
  EXPECT_EQ(shell("\"$VEX\" cube.obj --trials 100 <&-").exit_code, 0);
  EXPECT_EQ(shell("\"$VEX\" cube.obj --trials 100 2>&-").exit_code, 0);
  EXPECT_EQ(shell("\"$VEX\" cube.obj --trials 100 --quiet >&- 2>&- <&-").exit_code, 0);
  expect_fault("\"$VEX\" cube.obj --trials 100 --json result.json >&- <&-", "standard output cannot be written");
  EXPECT_TRUE(json::accept(read_file("result.json"))) << "no report in the document";
  EXPECT_EQ(shell("\"$VEX\" cube.obj --trials 100 --json other.json >&- 2>&- <&-").exit_code, 1);
  EXPECT_TRUE(json::accept(read_file("other.json")));
  EXPECT_EQ(shell("\"$VEX\" missing.obj 2>&-").exit_code, 3);
  EXPECT_EQ(read_file("cube.obj"), cube_obj());
}

TEST_F(Environment, AReaderThatGoesAwayCostsNoDocument) {
  const Finished finished =
      shell("{ \"$VEX\" box:1,1,1 --seconds 0.5 --json result.json; echo $? > code; } 2> message | true");
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_TRUE(json::accept(read_file("result.json")));
  EXPECT_EQ(read_file("code"), "1\n") << "and not a death by signal";
  EXPECT_NE(read_file("message").find("standard output cannot be written"), std::string::npos);
  const Finished head = shell("\"$VEX\" box:1,1,1 --trials 100 | head -1");
  EXPECT_EQ(head.exit_code, 0);
  EXPECT_EQ(head.out.rfind("A  box:1,1,1", 0), 0u);
}

TEST_F(Environment, AFolderThatCannotBeWrittenIsEnoughToRunIn) {
  write_file("cube.obj", cube_obj());
  chmod(folder().c_str(), 0555);
  EXPECT_EQ(run({"cube.obj", "--trials", "100"}).exit_code, 0);
  EXPECT_EQ(shell("cd /proc && \"$VEX\" box:1,1,1 --trials 100").exit_code, 0);
  const int code = shell("cd /proc && \"$VEX\" box:1,1,1 --trials 100 --quiet --json result.json").exit_code;
  EXPECT_TRUE(code == 1 || code == 2) << code;
}

TEST_F(Environment, LongAndManyArgumentsAreRefusedLikeShortOnes) {
  expect_refusal(run({std::string(120000, 'a')}), 3, "aaa");
  expect_refusal(run({"box:" + std::string(120000, '1') + ",1,1"}), 3, "");
  expect_refusal(run({"box:1,1,1", "--trials", std::string(120000, '9')}), 2, "--trials");
  expect_refusal(run({"box:1,1,1", "--" + std::string(50000, 'a')}), 2, "not understood");
  std::string sizes = "box:1";
  for (int k = 0; k < 50000; ++k) sizes += ",1";
  expect_refusal(run({sizes}), 2, "wrong number of sizes");
  Words many = {"box:1,1,1", "--trials", "10"};
  for (int k = 0; k < 2000; ++k) many.emplace_back("box:1,1,1");
  expect_refusal(run(many), 2, "not understood");
}

TEST_F(Environment, ManyThreadsAreHarmless) {
  const Finished finished = run({"box:1,1,1", "--trials", "1000", "--threads", "100", "--quiet"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
}

}  // namespace
}  // namespace vex::golden
