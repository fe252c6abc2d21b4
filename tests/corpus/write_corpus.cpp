// Writes the files of the corpus as seeds for the fuzzer: FOLDER/obj/0001.obj ... tests/fuzz/run calls it.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "corpus.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_corpus FOLDER\n");
    return 2;
  }
  constexpr std::size_t kMostBytes = 4096;  // a fuzzer learns little from more, slowly
  std::size_t n = 0;
  for (const vex::tests::Row& row : vex::tests::corpus()) {
    const std::string format =
        row.options.format.empty() ? std::filesystem::path(row.file).extension().string() : row.options.format;
    if (format.size() < 2 || row.bytes.size() > kMostBytes) continue;
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / format.substr(1);
    std::filesystem::create_directories(folder);
    std::ofstream(folder / (std::to_string(++n) + format), std::ios::binary) << row.bytes;
  }
  std::printf("%zu files\n", n);
  return n > 0 ? 0 : 1;
}
