// The inputs that fuzzing kept, read once more: each ends in an InputError or in what the reader promises. Under the
// sanitizers this is what a campaign begins with.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "meshes/file_bytes.h"
#include "reader_fuzz.h"

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

INSTANTIATE_TEST_SUITE_P(OfEveryFormat, KeptInputs, ::testing::ValuesIn(fuzz_formats()), [](const auto& test) {
  return "of_" + test.param.name;
});

}  // namespace
}  // namespace vex::tests
