#include "meshes/file_bytes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "meshes/data/archives.h"
#include "meshes/gunzip.h"
#include "refusal.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

TEST(FileBytes, AreTheWholeFile) {
  const TemporaryFolder folder;
  std::string text(3'000'001, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * i % 251);
  const auto path = folder.file("a", text);
  EXPECT_EQ(checked_file_size(path), text.size());
  EXPECT_EQ(read_file_bytes(path).view(), text);
}

TEST(FileBytes, AreNotOfWhatIsNoFile) {
  const TemporaryFolder folder;
  const auto refusal_for = [](const std::filesystem::path& path) {
    const std::string message = refusal_of([&] { static_cast<void>(read_file_bytes(path)); });
    EXPECT_EQ(message, refusal_of([&] { static_cast<void>(checked_file_size(path)); }));
    return message;
  };
  EXPECT_TRUE(contains(refusal_for(folder.path() / "absent"), "No such file"));
  EXPECT_TRUE(contains(refusal_for(folder.path()), "it is a folder"));
  EXPECT_TRUE(contains(refusal_for(folder.file("empty", "")), "is empty (0 bytes)"));
  EXPECT_TRUE(contains(refusal_for("/dev/zero"), "a pipe, a device or a socket"));
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(contains(refusal_for(folder.path() / "pipe"), "a pipe, a device or a socket"));  // and does not wait
}

TEST(FileBytes, AreNotOfAFileThatGrowsMeanwhile) {
  const TemporaryFolder folder;
  const auto path = folder.file("a", std::string(std::size_t{1} << 26U, 'x'));
  std::atomic<bool> is_read = false;
  std::atomic<int> n_written = 0;
  std::thread writer([&] {
    std::ofstream file(path, std::ios::app);
    while (!is_read) {
      file << 'x' << std::flush;
      ++n_written;
    }
  });
  while (n_written < 10) std::this_thread::yield();
  const std::string message = refusal_of([&] { static_cast<void>(read_file_bytes(path)); });
  is_read = true;
  writer.join();
  EXPECT_TRUE(contains(message, "changed while it was read"));
}

TEST(FileBytes, AreNotOfAFileThatIsMostlyHoles) {
  const TemporaryFolder folder;
  const auto path = folder.file("a", "x");
  for (const std::uintmax_t size : {std::uintmax_t{1} << 22U, std::uintmax_t{1} << 36U, std::uintmax_t{1} << 42U}) {
    std::filesystem::resize_file(path, size);
    const std::string message = refusal_of([&] { static_cast<void>(read_file_bytes(path)); });
    EXPECT_TRUE(contains(message, "is mostly holes (of its " + std::to_string(size) + " bytes "));
    EXPECT_TRUE(contains(message, " - "));
  }
  // What is written counts, zeros or not, and small holes do no harm.
  EXPECT_EQ(read_file_bytes(folder.file("zeros", std::string(5'000'000, '\0'))).size(), 5'000'000U);
  const auto mixed = folder.file("mixed", std::string(3'000'000, 'x'));
  std::filesystem::resize_file(mixed, 6'000'000);
  EXPECT_EQ(read_file_bytes(mixed).view(), std::string(3'000'000, 'x') + std::string(3'000'000, '\0'));
}

TEST(FileStamp, ChangesWithTheFile) {
  const TemporaryFolder folder;
  const auto stamp = [](const std::filesystem::path& path) {
    return file_stamp(OpenFile(::open(path.c_str(), O_RDONLY | O_CLOEXEC)));
  };
  const auto path = folder.file("a", "x");
  const auto before = stamp(path);
  ASSERT_TRUE(before.has_value());
  EXPECT_EQ(stamp(path), before);
  folder.file("a", "xy");
  EXPECT_NE(stamp(path), before);
  EXPECT_EQ(stamp(folder.path() / "b"), std::nullopt);
}

TEST(Gunzip, GivesBackWhatWasPacked) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i) + " ";
  EXPECT_EQ(gunzip(gzipped(text), "a.gz").view(), text);
  EXPECT_EQ(gunzip(gzipped("x"), "a.gz").view(), "x");
  EXPECT_EQ(gunzip(gzipped(text.substr(0, 1000)) + gzipped("") + gzipped(text.substr(1000)), "a.gz").view(), text);
}

TEST(Gunzip, RefusesAnythingButWholeMembers) {
  const std::string packed = gzipped(std::string(5000, 'x') + "yz");
  const auto refusal_for = [](const std::string& bytes) {
    return refusal_of([&] { static_cast<void>(gunzip(bytes, "a.gz")); });
  };
  for (std::size_t size = 1; size < packed.size(); ++size) {
    EXPECT_TRUE(contains(refusal_for(packed.substr(0, size)), "a.gz ends too early")) << size;
  }
  EXPECT_TRUE(contains(refusal_for(packed + "tail"), "no whole gzip file"));
  EXPECT_TRUE(contains(refusal_for(packed + std::string(512, '\0')), "no whole gzip file"));
  EXPECT_TRUE(contains(refusal_for("hello"), "no whole gzip file"));
  for (const std::size_t from_end : {1U, 4U, 5U, 8U}) {  // the length, then the check sum
    std::string changed = packed;
    changed[changed.size() - from_end] = static_cast<char>(changed[changed.size() - from_end] ^ 1);
    EXPECT_TRUE(contains(refusal_for(changed), from_end > 4 ? "data check" : "length check"));
  }
  EXPECT_TRUE(contains(refusal_for(gzipped("")), "is empty"));
}

TEST(Gunzip, RefusesWhatUnpacksToTooMuch) {
  const std::string packed = gzipped(std::string(std::size_t{64} << 20U, '\0'));
  ASSERT_LT(packed.size() * kMostInflation, std::size_t{32} << 20U);
  EXPECT_TRUE(contains(refusal_of([&] { static_cast<void>(gunzip(packed, "a.gz")); }), "at most 256 times its size"));
}

}  // namespace
}  // namespace vex::tests
