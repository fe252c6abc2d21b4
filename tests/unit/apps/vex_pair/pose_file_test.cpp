// A file of poses, line by line: what lines there are, in files and in pipes that fill slowly, and what is held of
// them.
#include "apps/vex_pair/pose_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

namespace fs = std::filesystem;

const std::string kHeader = "tx,ty,tz,qw,qx,qy,qz";
const std::string kRow = "1,2,3,1,0,0,0";

class PoseFileTest : public testing::Test {
 protected:
  PoseFileTest()
      : path_(fs::temp_directory_path() / ("vex_pose_file_test_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv")) {}
  ~PoseFileTest() override { fs::remove(path_); }

  std::string write(const std::string& content) const {
    std::ofstream(path_, std::ios::binary) << content;
    return path_.string();
  }

  struct Line {
    std::string text;
    std::uint64_t number;
    friend bool operator==(const Line&, const Line&) = default;
    friend void PrintTo(const Line& line, std::ostream* out) { *out << line.number << " \"" << line.text << "\""; }
  };

  // All rows, taken in blocks of so many at most.
  std::vector<Line> rows_of(const std::string& content, std::size_t n_most = 1000) const {
    PoseFile file(write(content), interrupt_);
    file.read_header();
    std::vector<Line> lines;
    RowBlock block;
    for (;;) {
      file.read_rows(n_most, block);
      if (block.rows.empty()) return lines;
      EXPECT_EQ(block.first_index, lines.size());
      EXPECT_LE(block.rows.size(), n_most);
      for (const RowBlock::Row& row : block.rows) {
        lines.push_back({row.is_too_long ? "too long" : std::string(block.text_of(row)), row.line});
      }
    }
  }

  fs::path path_;
  std::atomic<int> interrupt_{0};
};

TEST_F(PoseFileTest, GivesItsRowsWithTheirLines) {
  const std::vector<Line> expected = {{"a", 2}, {"b", 3}, {"c", 4}};
  for (const std::size_t n_most : {1u, 2u, 1000u}) {
    EXPECT_EQ(rows_of(kHeader + "\na\nb\nc\n", n_most), expected);
    EXPECT_EQ(rows_of(kHeader + "\na\nb\nc", n_most), expected) << "no end of the last line";
    EXPECT_EQ(rows_of("\xEF\xBB\xBF" + kHeader + "\na\nb\nc\n", n_most), expected) << "a byte order mark";
    EXPECT_EQ(rows_of(kHeader + "\na\nb\nc\n\n \t\r\n\n", n_most), expected) << "blank lines at the end";
  }
  EXPECT_EQ(rows_of(kHeader + "\r\na\r\nb\r\n"), (std::vector<Line>{{"a\r", 2}, {"b\r", 3}}));
  EXPECT_EQ(rows_of(kHeader), std::vector<Line>{});
  EXPECT_EQ(rows_of(kHeader + "\n\n\n"), std::vector<Line>{});
}

TEST_F(PoseFileTest, BlankLinesInTheMiddleAreRows) {
  const std::vector<Line> expected = {{"a", 2}, {"", 3}, {"", 4}, {"b", 5}, {"", 6}, {"c", 7}};
  for (const std::size_t n_most : {1u, 2u, 3u, 1000u}) {
    EXPECT_EQ(rows_of(kHeader + "\na\n\n  \nb\n\nc\n\n", n_most), expected);
  }
}

TEST_F(PoseFileTest, LinesThatAreTooLongAreNotHeld) {
  const std::string longest(PoseFile::kLongestLine, 'x');
  EXPECT_EQ(rows_of(kHeader + "\n" + longest + "\nb\n"), (std::vector<Line>{{longest, 2}, {"b", 3}}));
  for (const std::size_t n : {PoseFile::kLongestLine + 1, std::size_t{1} << 20, std::size_t{5} << 20}) {
    const std::string line(n, 'x');
    const std::vector<Line> expected = {{"a", 2}, {"too long", 3}, {"b", 4}};
    EXPECT_EQ(rows_of(kHeader + "\na\n" + line + "\nb\n"), expected) << n;
    EXPECT_EQ(rows_of(kHeader + "\na\n" + line), (std::vector<Line>{{"a", 2}, {"too long", 3}})) << n;
    EXPECT_EQ(rows_of(kHeader + "\n\n" + line + "\n"), (std::vector<Line>{{"", 2}, {"too long", 3}})) << n;
  }
}

TEST_F(PoseFileTest, ManyRowsInEveryBlockSize) {
  std::string content = kHeader + "\n";
  constexpr std::size_t kRows = 50000;  // several times what is read at once
  for (std::size_t k = 0; k < kRows; ++k) content += kRow + "," + std::to_string(k) + "\n";
  for (const std::size_t n_most : {777u, 1u << 20}) {
    const std::vector<Line> lines = rows_of(content, n_most);
    ASSERT_EQ(lines.size(), kRows);
    for (std::size_t k = 0; k < kRows; ++k) ASSERT_EQ(lines[k], (Line{kRow + "," + std::to_string(k), k + 2}));
  }
}

TEST_F(PoseFileTest, RefusesWhatIsNoFileOfPoses) {
  const auto refusal = [this](const std::string& path) -> std::string {
    try {
      PoseFile(path, interrupt_).read_header();
    } catch (const InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  EXPECT_NE(refusal("no/such/poses.csv").find("cannot be read (no/such/poses.csv: No such file"), std::string::npos);
  EXPECT_NE(refusal(fs::temp_directory_path().string()).find("Is a directory"), std::string::npos);
  EXPECT_NE(refusal("/dev/null").find("the file of poses is empty (/dev/null)"), std::string::npos);
  EXPECT_NE(refusal(write("\n" + kHeader + "\n")).find(", line 1: not a header"), std::string::npos);
  EXPECT_NE(refusal(write(std::string(1 << 20, 'x'))).find(", line 1: too long a header"), std::string::npos);
  EXPECT_NE(refusal(write("\xFF\xFE" + kHeader + "\n")).find(", line 1: not a header"), std::string::npos);
}

// It came about that /dev/zero was read for ever.
TEST_F(PoseFileTest, ALineWithoutAnEndIsTheLastOne) {
  const std::string endless(PoseFile::kLongestSkipped + (1 << 20), 'x');
  PoseFile zeros("/dev/zero", interrupt_);
  EXPECT_THROW(zeros.read_header(), InputError);
  PoseFile file(write(kHeader + "\na\n" + endless + "\nb\n"), interrupt_);
  file.read_header();
  RowBlock block;
  file.read_rows(100, block);
  ASSERT_EQ(block.rows.size(), 2u) << "the rows before it are answered";
  EXPECT_EQ(block.text_of(block.rows.front()), "a");
  EXPECT_TRUE(block.rows.back().is_too_long);
  try {
    file.read_rows(100, block);
    ADD_FAILURE() << "nothing says that b was not read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 3: no end of the line"), std::string::npos);
  }
}

// What a slow writer has written is answered before it writes more.
TEST_F(PoseFileTest, APipeIsReadAsFarAsItHasCome) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  const auto send = [&](const std::string& text) {
    ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  };
  PoseFile file("/dev/fd/" + std::to_string(ends[0]), interrupt_);
  RowBlock block;
  send(kHeader + "\na\nb");
  file.read_header();
  file.read_rows(100, block);
  ASSERT_EQ(block.rows.size(), 1u);
  EXPECT_EQ(block.text, "a");
  send("b\n\n");
  file.read_rows(100, block);
  EXPECT_EQ(block.text, "bb");
  EXPECT_EQ(block.first_index, 1u);
  {
    const std::jthread late([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(120));
      send("c\n");
    });
    file.read_rows(100, block);  // waits
  }
  ASSERT_EQ(block.rows.size(), 2u) << "the blank line is a row by now";
  EXPECT_EQ(block.text, "c");
  EXPECT_EQ(block.rows.back().line, 5u);
  {
    const std::jthread late([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(120));
      interrupt_.store(2);
    });
    file.read_rows(100, block);  // would wait for ever
  }
  EXPECT_TRUE(block.rows.empty());
  for (const int end : ends) close(end);
}

}  // namespace
}  // namespace vex
