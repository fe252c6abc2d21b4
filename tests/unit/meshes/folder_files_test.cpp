#include "meshes/folder_files.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "temporary_folder.h"
#include "tests/setup/refused_calls.h"

namespace vex::tests {
namespace {

namespace fs = std::filesystem;

/// A folder with files and links in it, beside a secret.
class FolderFiles : public testing::Test {
 protected:
  FolderFiles() : folder_(top_.path() / "folder") {
    fs::create_directories(folder_ / "inner");
    top_.file("secret.bin", "s");
    top_.file("folder/a.bin", "a");
    top_.file("folder/inner/b.bin", "b");
    fs::create_symlink("../secret.bin", folder_ / "out.bin");
    fs::create_symlink(top_.path() / "secret.bin", folder_ / "absolute.bin");
    fs::create_symlink("..", folder_ / "up");
    fs::create_symlink("inner/b.bin", folder_ / "within.bin");
  }

  /// What is in the file; "" where it is not opened.
  std::string text(const fs::path& folder, const std::string& name) const {
    const OpenFile file = open_beneath(folder, name);
    char byte = 0;
    return file.number() >= 0 && ::read(file.number(), &byte, 1) == 1 ? std::string(1, byte) : "";
  }

  void expect_nothing_outside(const fs::path& folder) const {
    for (const std::string name :
         {"../secret.bin", "./../secret.bin", "inner/../../secret.bin", "up/secret.bin", "out.bin", "absolute.bin",
          "inner/../out.bin", "", ".", "..", "absent.bin", "a.bin/x", "//etc/hostname", "/proc/self/cwd/a.bin"}) {
      EXPECT_EQ(text(folder, name), "") << name;
    }
    EXPECT_EQ(text(folder, (top_.path() / "secret.bin").string()), "");
    EXPECT_EQ(text(folder, std::string("a.bin\0x", 7)), "");
    for (const std::string name : {"a.bin", "./a.bin", ".//./a.bin"}) EXPECT_EQ(text(folder, name), "a") << name;
    for (const std::string name : {"inner/b.bin", "./inner//b.bin"}) EXPECT_EQ(text(folder, name), "b") << name;
  }

  const TemporaryFolder top_;
  const fs::path folder_;
};

TEST_F(FolderFiles, AreOpenedWithinTheirFolderAlone) {
  expect_nothing_outside(folder_);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  expect_nothing_outside("");
  expect_nothing_outside(".");
  fs::current_path(before);
  EXPECT_EQ(text(top_.path() / "absent", "a.bin"), "");
}

TEST_F(FolderFiles, AreFoundByWhereTheyAre) {
  if (const OpenFile file = open_beneath(folder_, "within.bin"); file.number() < 0) {
    GTEST_SKIP() << "this kernel does not watch the way (openat2)";
  }
  EXPECT_EQ(text(folder_, "within.bin"), "b");
  EXPECT_EQ(text(folder_, "inner/../a.bin"), "a");
}

TEST_F(FolderFiles, AreNotOutsideWhereTheKernelDoesNotWatchTheWay) {
  for (const int error : {ENOSYS, EPERM}) {
    const pid_t child = ::fork();
    if (child == 0) {
      if (!refuse_calls({SYS_openat2}, error)) ::_exit(2);
      expect_nothing_outside(folder_);
      EXPECT_EQ(text(folder_, "within.bin"), "");
      ::_exit(HasFailure() ? 1 : 0);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << error;
  }
}

}  // namespace
}  // namespace vex::tests
