// The library's part of beside_library.sh, on the same trials as the kernels':
//   vex_library_hits store A B FILE               what the kernels need of two bodies, for vex_device_hits
//   vex_library_hits hits A B SEED TRIALS THREADS run_monte_carlo, hit-or-miss
//   vex_library_hits open A B SEED FILE           the trials that the file lists, by `overlap`
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/query/overlap.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"
#include "tests/opencl/pair_of_bodies.h"

namespace {

using Words = std::vector<std::string>;

std::uint64_t number_in(const std::string& text) { return std::strtoull(text.c_str(), nullptr, 10); }

void print(std::uint64_t n_hits, std::uint64_t n_misses, std::uint64_t n_undecided, double seconds) {
  std::printf("hits %llu misses %llu open %llu seconds %.6f\n", static_cast<unsigned long long>(n_hits),
              static_cast<unsigned long long>(n_misses), static_cast<unsigned long long>(n_undecided), seconds);
}

int run_library(const Words& words) {
  if (words.size() < 4) throw std::runtime_error("store A B FILE, hits A B SEED TRIALS THREADS, or open A B SEED FILE");
  const vex::ConvexBody a = vex::parse_shape(words[1]).body, b = vex::parse_shape(words[2]).body;
  vex::MonteCarloSettings settings;
  settings.domain = vex::best_domain(a, b);
  if (words[0] == "store") {
    const std::optional<VexPair> pair = vex::pair_of_bodies(a, b, settings.domain);
    if (!pair) throw std::runtime_error("the kernels do not take this pair");
    std::ofstream(words[3], std::ios::binary).write(reinterpret_cast<const char*>(&*pair), sizeof *pair);
    return 0;
  }
  settings.seed = number_in(words.at(3));
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  if (words[0] == "hits") {
    settings.stop = {};
    settings.stop.trials = number_in(words.at(4));
    settings.n_threads = static_cast<int>(number_in(words.at(5)));
    const vex::Tally tally = vex::run_monte_carlo(a, b, settings).tally;
    print(tally.n_hits, tally.n_trials - tally.n_hits - tally.n_undecided, tally.n_undecided, seconds());
    return 0;
  }
  std::uint64_t counts[3] = {};
  std::ifstream list(words.at(4));
  if (!list) throw std::runtime_error("no file " + words[4]);
  for (std::uint64_t trial = 0; list >> trial;) {
    switch (vex::overlap(a, b, vex::Pose(vex::trial_pose(a, b, settings, trial))).outcome) {
      case vex::Outcome::overlap: ++counts[0]; break;
      case vex::Outcome::disjoint: ++counts[1]; break;
      default: ++counts[2];
    }
  }
  print(counts[0], counts[1], counts[2], seconds());
  return 0;
}

}  // namespace

int main(int n_words, char** words) {
  try {
    return run_library(Words(words + 1, words + n_words));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "vex_library_hits: %s\n", fault.what());
    return 1;
  }
}
