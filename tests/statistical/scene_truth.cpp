// Random scenes in every stratum (tests/referees/random_scenes.h), all their answers held against brute force: a table
// of how many scenes and pairs there were. Ends with 1 where an answer is wrong, and says of the first how to ask
// again.
//   vex_scene_truth [--scenes N] [--threads N] [--seed N] [--only N] [STRATUM...]
// N scenes of each stratum (without options 1700, 10200 together: some minutes of one core); --only asks the one of
// this number alone.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

struct Settings {
  int n_scenes = 1700, n_threads = 2, seed = 1, only = -1;
  std::vector<std::string> names;  // of strata; none: all
};

struct Row {
  std::uint64_t n = 0, n_open = 0, n_bodies = 0, n_asked = 0, n_pairs = 0, n_own = 0, n_repeated = 0, n_undecided = 0;
  std::uint64_t n_wrong = 0;
  std::string first_fault;
};

void ask(SceneStratum stratum, int number, int seed, Row& row) {
  const std::string name =
      std::string(name_of(stratum)) + " --seed " + std::to_string(seed) + " --only " + std::to_string(number);
  std::seed_seq seeds(name.begin(), name.end());
  std::mt19937_64 random(seeds);
  const RandomScene made = random_scene(stratum, random);
  Scene scene = made.scene();
  if (scene.size() > 2 && random() % 3 == 0) scene.remove(static_cast<BodyId>(random() % scene.end()));
  const EveryPair every = every_pair(scene);
  const std::string fault = fault_of_scene(scene, made, every, random);
  ++row.n;
  row.n_open += made.box ? 0u : 1u;
  row.n_bodies += scene.size();
  row.n_asked += every.n_asked;
  row.n_pairs += every.pairs.size();
  row.n_own += every.n_own;
  row.n_repeated += every.n_repeated;
  row.n_undecided += every.undecided.size();
  if (fault.empty()) return;
  if (row.n_wrong++ == 0) row.first_fault = name + ": " + fault;
}

bool run(const Settings& settings) {
  std::printf("%-13s %7s %7s %9s %9s %9s %7s %9s %7s %6s\n", "stratum", "scenes", "open", "bodies", "asked", "pairs",
              "own", "repeated", "undec.", "wrong");
  std::uint64_t n = 0, n_wrong = 0;
  for (const SceneStratum stratum : kSceneStrata) {
    if (!settings.names.empty() && std::ranges::count(settings.names, name_of(stratum)) == 0) continue;
    Row row;
    std::mutex adding;
    std::atomic<int> next = settings.only >= 0 ? settings.only : 0;
    const int end = settings.only >= 0 ? settings.only + 1 : settings.n_scenes;
    const auto work = [&] {
      Row own;
      for (int k = next++; k < end; k = next++) ask(stratum, k, settings.seed, own);
      const std::lock_guard lock(adding);
      const std::pair<std::uint64_t Row::*, std::uint64_t> sums[] = {{&Row::n, own.n},
                                                                     {&Row::n_open, own.n_open},
                                                                     {&Row::n_bodies, own.n_bodies},
                                                                     {&Row::n_asked, own.n_asked},
                                                                     {&Row::n_pairs, own.n_pairs},
                                                                     {&Row::n_own, own.n_own},
                                                                     {&Row::n_repeated, own.n_repeated},
                                                                     {&Row::n_undecided, own.n_undecided},
                                                                     {&Row::n_wrong, own.n_wrong}};
      for (const auto& [member, value] : sums) row.*member += value;
      if (row.first_fault.empty()) row.first_fault = own.first_fault;
    };
    std::vector<std::thread> threads;
    for (int k = 0; k < settings.n_threads; ++k) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    const auto number = [](std::uint64_t x) { return static_cast<unsigned long long>(x); };
    std::printf("%-13s %7llu %7llu %9llu %9llu %9llu %7llu %9llu %7llu %6llu\n", std::string(name_of(stratum)).c_str(),
                number(row.n), number(row.n_open), number(row.n_bodies), number(row.n_asked), number(row.n_pairs),
                number(row.n_own), number(row.n_repeated), number(row.n_undecided), number(row.n_wrong));
    if (!row.first_fault.empty()) std::printf("   %s\n", row.first_fault.c_str());
    std::fflush(stdout);
    n += row.n;
    n_wrong += row.n_wrong;
  }
  std::printf("%llu scenes, %llu of them with a wrong answer\n", static_cast<unsigned long long>(n),
              static_cast<unsigned long long>(n_wrong));
  return n > 0 && n_wrong == 0;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::Settings settings;
  for (int k = 1; k < argc; ++k) {
    const std::string text = argv[k];
    const std::pair<const char*, int*> options[] = {{"--scenes", &settings.n_scenes},
                                                    {"--threads", &settings.n_threads},
                                                    {"--seed", &settings.seed},
                                                    {"--only", &settings.only}};
    const auto* const option = std::ranges::find_if(options, [&](const auto& one) { return text == one.first; });
    if (option == std::end(options)) {
      settings.names.push_back(text);
    } else if (++k < argc) {
      *option->second = std::atoi(argv[k]);
    } else {
      return 2;
    }
  }
  return vex::run(settings) ? 0 : 1;
}
