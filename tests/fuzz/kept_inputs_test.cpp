// The inputs that fuzzing kept, read once more: each ends in an InputError or in what the reader promises. Under the
// sanitizers this is what a campaign begins with. Likewise of what programs read besides, and of queries.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "meshes/data/archives.h"
#include "meshes/file_bytes.h"
#include "program_fuzz.h"
#include "query_fuzz.h"
#include "reader_fuzz.h"
#include "run_state_fuzz.h"
#include "tests/corpus/file_text.h"

namespace vex::tests {
namespace {

class KeptInputs : public ::testing::TestWithParam<FuzzFormat> {};

TEST_P(KeptInputs, KeepTheReadersPromises) {
  const std::filesystem::path folder = std::filesystem::path(VEX_KEPT_INPUTS) / GetParam().name;
  ASSERT_TRUE(std::filesystem::is_directory(folder)) << "no campaign has kept inputs of this format";
  std::size_t n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    if (entry.file_size() == 0) continue;
    EXPECT_NO_THROW(read_as(GetParam(), read_file_bytes(entry.path()).view()));
    ++n_files;
  }
  EXPECT_GT(n_files, 1U);
}

const auto kFormatName = [](const auto& test) {
  std::string name = "of_" + test.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
};
INSTANTIATE_TEST_SUITE_P(OfEveryFormat, KeptInputs, ::testing::ValuesIn(fuzz_formats()), kFormatName);
INSTANTIATE_TEST_SUITE_P(OfPrograms, KeptInputs, ::testing::ValuesIn(program_formats()), kFormatName);
INSTANTIATE_TEST_SUITE_P(OfRuns, KeptInputs, ::testing::ValuesIn(run_state_formats()), kFormatName);
INSTANTIATE_TEST_SUITE_P(OfQueries, KeptInputs, ::testing::ValuesIn(query_formats()), kFormatName);

struct Found {
  const char* format;
  std::string bytes;
};

/// Inputs on which a promise was broken.
TEST(FoundInputs, KeepTheReadersPromises) {
  const Found inputs[] = {
      // A tag's name in a message, with control characters of the file.
      {"amf", "<amf><constellation><instance><deltax\x01\x7f>1,5</deltax\x01\x7f></instance></constellation></amf>"},
      {"amf", "<amf><object><mesh><vertices><vertex><coordinates\x02 /></vertex></vertices></mesh></object></amf>"},
      // A unit's name, likewise.
      {"dae",
       "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>"
       "<unit name=\"a - b\" meter=\"2\"/><unit name=\"c\x01 - \" meter=\"3\"/></asset></COLLADA>"},
      // A number that is none.
      {"gltf", R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0)"
               "\x01\xab - "
               R"(}}]}]})"},
      // The name of an archive's part, likewise.
      {"3mf", zipped({{"_rels/.rels", "<Relationships/>"},
                      {"3D/a\x03.model", "<model unit=\"millimeter\"><resources/><resources/></model>"},
                      {"3D/b\x04.model", "<model><component objectid=\"1\" p:path=\"/3D/a.model\"/></model>"}})}};
  for (const Found& found : inputs) {
    SCOPED_TRACE(found.format);
    for (const FuzzFormat& format : fuzz_formats()) {
      if (format.name != found.format) continue;
      EXPECT_NO_THROW(read_as(format, found.bytes));
    }
  }
}

}  // namespace
}  // namespace vex::tests
