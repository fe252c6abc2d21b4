// Hits of some pairs and a hash over all verdicts, for tests/same_hits.sh to compare between ways of building.
//   vex_same_hits_count TRIALS THREADS
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "engine/query/overlap.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "tests/regression/same_hits_bodies.h"

namespace vex {
namespace {

struct Count {
  std::array<std::uint64_t, 3> outcomes{};
  std::uint64_t n_escalated = 0, hash = 0;

  void add(const Count& other) {
    for (std::size_t k = 0; k < outcomes.size(); ++k) outcomes[k] += other.outcomes[k];
    n_escalated += other.n_escalated;
    hash += other.hash;
  }
};

// The finaliser of MurmurHash3. Summed over trials: the same in any order.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdull;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return x ^ (x >> 33);
}

Count count(const ConvexBody& a, const ConvexBody& b, std::uint64_t first, std::uint64_t step, std::uint64_t end) {
  MonteCarloSettings settings;
  settings.domain = ball_domain(a, b);
  Count result;
  for (std::uint64_t k = first; k < end; k += step) {
    const Verdict verdict = overlap(a, b, trial_pose(a, b, settings, k));
    const auto outcome = static_cast<std::uint64_t>(verdict.outcome);
    ++result.outcomes[outcome];
    result.n_escalated += verdict.by == DecidedBy::gjk ? 0 : 1;
    result.hash += mixed(4 * k + outcome);
  }
  return result;
}

void print_hits(SameHitsBody kind_a, SameHitsBody kind_b, std::uint64_t n_trials, std::uint64_t n_threads) {
  const ConvexBody a = same_hits_body(kind_a), b = same_hits_body(kind_b);
  std::vector<Count> counts(n_threads);
  std::vector<std::thread> threads;
  for (std::uint64_t k = 0; k < n_threads; ++k) {
    threads.emplace_back([&, k] { counts[k] = count(a, b, k, n_threads, n_trials); });
  }
  Count all;
  for (std::uint64_t k = 0; k < n_threads; ++k) {
    threads[k].join();
    all.add(counts[k]);
  }
  // The driver, with the kernels of every instruction set that this machine has, counts the same.
  for (const InstructionSet set : instruction_sets()) {
    MonteCarloSettings settings;
    settings.domain = ball_domain(a, b);
    settings.stop.trials = n_trials;
    settings.n_threads = static_cast<int>(n_threads);
    settings.instruction_set = set;
    settings.backend = gjk_backend(set);
    const Tally tally = run_monte_carlo(a, b, settings).tally;
    if (tally.n_hits == all.outcomes[1] && tally.n_undecided == all.outcomes[2]) continue;
    std::printf("pair %d %d: %s hits by the driver with %s\n", static_cast<int>(kind_a), static_cast<int>(kind_b),
                std::to_string(tally.n_hits).c_str(), std::string(name_of(set)).c_str());
    std::exit(1);
  }
  std::printf("pair %d %d: disjoint %llu overlap %llu undecided %llu escalated %llu hash %016llx\n",
              static_cast<int>(kind_a), static_cast<int>(kind_b), static_cast<unsigned long long>(all.outcomes[0]),
              static_cast<unsigned long long>(all.outcomes[1]), static_cast<unsigned long long>(all.outcomes[2]),
              static_cast<unsigned long long>(all.n_escalated), static_cast<unsigned long long>(all.hash));
}

// A fitted domain's positions are made of the bodies' heights, and its tally of volumes: all of it is to be the same.
void print_fitted_hits(SameHitsBody kind_a, SameHitsBody kind_b, std::uint64_t n_trials, std::uint64_t n_threads) {
  const ConvexBody a = same_hits_body(kind_a), b = same_hits_body(kind_b);
  MonteCarloSettings settings;
  settings.domain = fitted_domain(a, b);
  settings.stop.trials = n_trials;
  settings.n_threads = static_cast<int>(n_threads);
  settings.instruction_set = InstructionSet::scalar;
  const Tally one_by_one = run_monte_carlo(a, b, settings).tally;
  for (const InstructionSet set : instruction_sets()) {
    settings.instruction_set = set;
    settings.backend = gjk_backend(set);
    const Tally tally = run_monte_carlo(a, b, settings).tally;
    if (tally.n_hits == one_by_one.n_hits && tally.all == one_by_one.all && tally.hits == one_by_one.hits) continue;
    std::printf("pair %d %d: other fitted trials with %s\n", static_cast<int>(kind_a), static_cast<int>(kind_b),
                std::string(name_of(set)).c_str());
    std::exit(1);
  }
  std::printf("pair %d %d fitted: overlap %llu shares %a squares of overlaps %a\n", static_cast<int>(kind_a),
              static_cast<int>(kind_b), static_cast<unsigned long long>(one_by_one.n_hits),
              one_by_one.all.first.value(), one_by_one.hits.second.value());
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using vex::SameHitsBody;
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s TRIALS THREADS\n", argv[0]);
    return 2;
  }
  const std::uint64_t n_trials = std::strtoull(argv[1], nullptr, 10), n_threads = std::strtoull(argv[2], nullptr, 10);
  if (n_trials == 0 || n_threads == 0) {
    std::fprintf(stderr, "TRIALS and THREADS are at least 1 - got %s %s\n", argv[1], argv[2]);
    return 2;
  }
  constexpr SameHitsBody kPairs[][2] = {{SameHitsBody::cube, SameHitsBody::cube},
                                        {SameHitsBody::slab, SameHitsBody::plate},
                                        {SameHitsBody::ellipsoid, SameHitsBody::ellipsoid},
                                        {SameHitsBody::cylinder, SameHitsBody::slab},
                                        {SameHitsBody::capsule, SameHitsBody::cube}};
  for (const auto& [a, b] : kPairs) {
    vex::print_hits(a, b, n_trials, n_threads);
    vex::print_fitted_hits(a, b, n_trials, n_threads);
  }
}
