// Queries of support mappings that break their contract: they end, soon, and neither crash nor throw what they should
// not. Inputs of fixed seeds, and those that campaigns found (tests/fuzz/run); VEX_FUZZ_FILES in the environment is
// another number of them, VEX_FUZZ_SEED another seed.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <string>

#include "mutator.h"
#include "query_fuzz.h"

namespace vex::tests {
namespace {

TEST(LyingBodies, EndEveryQuery) {
  std::mt19937_64 random(from_environment("VEX_FUZZ_SEED", 1));
  const std::uint64_t n_inputs = from_environment("VEX_FUZZ_FILES", 8'000);
  double slowest = 0.0;
  for (std::uint64_t k = 0; k < n_inputs; ++k) {
    std::string bytes(40 + random() % 400, '\0');
    for (char& byte : bytes) byte = static_cast<char>(static_cast<unsigned char>(random() & 0xFFU));
    if (k % 2 == 0) {
      // Of usual sizes: most bodies are then well within the numbers.
      for (char& byte : bytes) byte = static_cast<char>(static_cast<unsigned char>(byte) % 160);
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_NO_THROW(query_liars(bytes)) << "input " << k;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > slowest) slowest = seconds;
  }
  const MostAsked most = most_asked();
  std::printf("%llu inputs; most points asked for: %llu, by %s; slowest %.3g s\n",
              static_cast<unsigned long long>(n_inputs), static_cast<unsigned long long>(most.n_points), most.query,
              slowest);
  EXPECT_LT(slowest, 10.0);
  EXPECT_GT(most.n_points, 100u) << "or nothing was asked";
}

}  // namespace
}  // namespace vex::tests
