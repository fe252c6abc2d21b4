// What programs read besides meshes, damaged: whatever the bytes are, reading them ends as the readers promise.
// Deterministic and bounded; VEX_FUZZ_FILES in the environment is another number of files, VEX_FUZZ_SEED another seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "meshes/file_bytes.h"
#include "mutator.h"
#include "program_fuzz.h"

namespace vex::tests {
namespace {

class MutatedPrograms : public ::testing::TestWithParam<FuzzFormat> {};

TEST_P(MutatedPrograms, KeepTheReadersPromises) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(VEX_KEPT_INPUTS) / GetParam().name)) {
    if (entry.file_size() > 0) paths.push_back(entry.path());
  }
  ASSERT_FALSE(paths.empty());
  std::ranges::sort(paths);
  std::vector<std::string> files;
  for (const std::filesystem::path& path : paths) files.emplace_back(read_file_bytes(path).view());
  Mutator mutator(from_environment("VEX_FUZZ_SEED", 1));
  const std::uint64_t n_files = from_environment("VEX_FUZZ_FILES", 3000);
  for (std::uint64_t k = 0; k < n_files; ++k) {
    const std::string bytes = mutator.mutated(files[k % files.size()]);
    ASSERT_NO_THROW(read_as(GetParam(), bytes)) << "file " << k << " of " << paths[k % files.size()];
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryFormat, MutatedPrograms, ::testing::ValuesIn(program_formats()),
                         [](const auto& test) { return "of_" + test.param.name; });

}  // namespace
}  // namespace vex::tests
