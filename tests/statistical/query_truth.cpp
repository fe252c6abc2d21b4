// Distances and depths of millions of poses, each judged in twice the precision (tests/referees/separation_judge.h),
// for pairs of bodies of all kinds: a table, kind by kind, of the worst that was seen. Of every so many answers the
// exact checker judges the certificate, too. Ends with 1 where any answer is wrong or not proven, and says at which
// pose the first of them was.
//   vex_query_truth [--pairs N] [--near N] [--aligned N] [--certificates N] [--threads N] [--seed N] [KIND...]
// Without options: 100000 poses anywhere, 10000 near contact, 1000 with the bodies' axes parallel, of every kind, and
// the certificates of all. A kind is two bodies with a blank between, or one: "box:1,2,3 hull:20". Hours on two cores.
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "engine/query/separation_certificate.h"
#include "tests/referees/separation_kinds.h"
#include "tests/referees/separation_tally.h"

namespace vex {
namespace {

struct Counts {
  int n_pairs = 100000, n_near = 10000, n_aligned = 1000, every_certificate = 1, n_threads = 2, seed = 1;
};

SeparationTally tally_of(const SeparationKind& kind, const Counts& counts) {
  const ConvexBody a = separation_body(kind.a), b = separation_body(kind.b);
  const SeparationJudge judge(a, b);
  const Domain domain = ball_domain(a, b);
  const std::string seed_text = kind.name() + " " + std::to_string(counts.seed);
  std::seed_seq seeds(seed_text.begin(), seed_text.end());
  std::mt19937_64 random(seeds);
  SeparationTally tally;
  const auto ask = [&](const Transformd& pose) {
    const Separation answer = signed_distance(a, b, pose);
    tally.add(pose, answer, judge.judge(pose, answer));
    if (counts.every_certificate < 1 || tally.n % static_cast<std::uint64_t>(counts.every_certificate) != 0) return;
    tally.add(pose, check_certificate(a, b, pose, answer, certify(a, b, pose, answer)));
  };
  for (int k = 0; k < counts.n_pairs; ++k) ask(random_pose(random, domain, b));
  for (int k = 0; k < counts.n_near; ++k) ask(near_contact_pose(a, b, random, k));
  for (int k = 0; k < counts.n_aligned; ++k) ask(aligned_pose(a, b, random, k));
  return tally;
}

void print_head() {
  std::printf("%-48s %8s %8s %9s %9s %9s %9s %6s %6s %6s %6s %7s %6s\n", "kind", "pairs", "apart", "distance", "depth",
              "bounds", "points", "wrong", "bounds", "undec.", "ties", "bounds", "calls");
}

void print_row(const SeparationKind& kind, const SeparationTally& tally) {
  std::printf("%-48s %8llu %8llu %9.1e %9.1e %9.1e %9.1e %6llu %6llu %6llu %6llu %7.0e %6.1f\n", kind.name().c_str(),
              static_cast<unsigned long long>(tally.n), static_cast<unsigned long long>(tally.n_apart),
              tally.worst_distance, tally.worst_depth, tally.widest, tally.farthest_off,
              static_cast<unsigned long long>(tally.n_wrong), static_cast<unsigned long long>(tally.n_bounds_violated),
              static_cast<unsigned long long>(tally.n_undecided), static_cast<unsigned long long>(tally.n_unknown),
              tally.widest_unknown, tally.n_support_calls / static_cast<double>(std::max<std::uint64_t>(tally.n, 1)));
  for (const auto& [text, fault] : tally.faults) {
    std::printf("   %llu times, first: %s\n", static_cast<unsigned long long>(fault.n), fault.first.c_str());
  }
  std::fflush(stdout);
}

// Whether nothing was wrong.
bool run(const std::vector<SeparationKind>& kinds, const Counts& counts) {
  print_head();
  std::atomic<std::size_t> next = 0;
  std::uint64_t n = 0, n_wrong = 0, n_certificates = 0, n_not_accepted = 0;
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k = next++; k < kinds.size(); k = next++) {
      const SeparationTally tally = tally_of(kinds[k], counts);
      const std::lock_guard lock(printing);
      print_row(kinds[k], tally);
      n += tally.n;
      n_wrong += tally.n_wrong;
      n_certificates += tally.n_certificates;
      n_not_accepted += tally.n_not_accepted;
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < counts.n_threads; ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  std::printf("%llu answers, %llu of them wrong\n", static_cast<unsigned long long>(n),
              static_cast<unsigned long long>(n_wrong));
  std::printf("%llu certificates checked in exact arithmetic, %llu not accepted\n",
              static_cast<unsigned long long>(n_certificates), static_cast<unsigned long long>(n_not_accepted));
  return n > 0 && n_wrong == 0 && n_not_accepted == 0;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  Counts counts;
  std::vector<SeparationKind> kinds;
  for (int k = 1; k < argc; ++k) {
    const std::string text = argv[k];
    const std::pair<const char*, int*> options[] = {
        {"--pairs", &counts.n_pairs},     {"--near", &counts.n_near},
        {"--aligned", &counts.n_aligned}, {"--certificates", &counts.every_certificate},
        {"--threads", &counts.n_threads}, {"--seed", &counts.seed}};
    const auto* const option = std::ranges::find_if(options, [&](const auto& one) { return text == one.first; });
    if (option != std::end(options)) {
      if (++k == argc) return 2;
      *option->second = std::atoi(argv[k]);
      continue;
    }
    const std::size_t blank = text.find(' ');
    kinds.push_back({text.substr(0, blank), blank == std::string::npos ? text : text.substr(blank + 1)});
  }
  return run(kinds.empty() ? separation_kinds() : kinds, counts) ? 0 : 1;
}
