// Queries of every kind in every stratum (tests/referees/query_strata.h), the certificate of each answer judged by the
// exact checker: a table of how many were proven, how long they took, and how far apart their bounds are. Ends with 1
// where the checker does not accept one, and says of the first how to ask again.
//   vex_certified_queries [--scenes N] [--threads N] [--seed N] [STRATUM...] [QUERY...]
// Each stratum has N impacts and N manifolds, 5 N casts, as many rays, 4 N signed distances, and 3 N distances and
// depths each. Without options 9100 scenes: a million casts and rays, a million distances and depths, 100 100 impacts
// and as many manifolds. Some 50 minutes of one thread.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/referees/certified_query.h"

namespace vex {
namespace {

struct Settings {
  int n_scenes = 9100, n_threads = 2, seed = 1;
  std::vector<std::string> names;  // of strata and queries: all strata, or all queries, where none is named
};

// Of a stratum or of a query.
bool is_name(std::string_view text) {
  return std::ranges::any_of(query_strata(), [&](const QueryStratum& stratum) { return stratum.name == text; }) ||
         std::ranges::any_of(kCertifiedQueries, [&](CertifiedQuery query) { return name_of(query) == text; });
}

int scenes_of(CertifiedQuery query, int n) {
  switch (query) {
    case CertifiedQuery::ray:
    case CertifiedQuery::cast: return 5 * n;
    case CertifiedQuery::signed_distance: return 4 * n;
    case CertifiedQuery::distance:
    case CertifiedQuery::depth: return 3 * n;
    case CertifiedQuery::overlap:
    case CertifiedQuery::impact:
    case CertifiedQuery::manifold: break;
  }
  return n;
}

struct Row {
  std::uint64_t n = 0, n_disjoint = 0, n_overlap = 0, n_undecided = 0, n_unproven = 0;
  std::vector<double> microseconds;
  double most_seconds = 0.0, widest = 0.0;
  int most_calls = 0;
  std::string slowest, widest_scene;
  std::map<std::string, std::pair<std::uint64_t, std::string>> faults;  // how often, and the first scene

  void add(const QueryScene& scene, const CertifiedAnswer& answer) {
    ++n;
    n_disjoint += answer.outcome == Outcome::disjoint ? 1 : 0;
    n_overlap += answer.outcome == Outcome::overlap ? 1 : 0;
    n_undecided += answer.outcome == Outcome::undecided ? 1 : 0;
    if (answer.seconds > most_seconds) {
      most_seconds = answer.seconds;
      slowest = scene.text();
    }
    microseconds.push_back(1e6 * answer.seconds);
    if (answer.width > widest) {
      widest = answer.width;
      widest_scene = scene.text();
    }
    most_calls = std::max(most_calls, answer.n_support_calls);
    if (answer.fault.empty()) return;
    ++n_unproven;
    auto& [times, first] = faults[answer.fault];
    if (times++ == 0) first = scene.text();
  }
  double quantile(double share) {
    std::ranges::sort(microseconds);
    const std::size_t at = static_cast<std::size_t>(share * static_cast<double>(microseconds.size()));
    return microseconds[std::min(at, microseconds.size() - 1)];
  }
};

void print_row(const QueryStratum& stratum, CertifiedQuery query, Row& row) {
  const double median = row.quantile(0.5), late = row.quantile(0.999), most = row.quantile(1.0);
  std::printf("%-10s %-9s %8llu %8llu %8llu %6llu %6llu %9.1f %9.1f %9.1f %8.1e %7d\n", stratum.name.c_str(),
              std::string(name_of(query)).c_str(), static_cast<unsigned long long>(row.n),
              static_cast<unsigned long long>(row.n_disjoint), static_cast<unsigned long long>(row.n_overlap),
              static_cast<unsigned long long>(row.n_undecided), static_cast<unsigned long long>(row.n_unproven), median,
              late, most, row.widest, row.most_calls);
  if (most > 1000.0) std::printf("   slowest: %s\n", row.slowest.c_str());
  if (row.widest > 1e-3) std::printf("   widest: %s\n", row.widest_scene.c_str());
  for (const auto& [fault, times] : row.faults) {
    std::printf("   %llu times not proven: %s; first: %s\n", static_cast<unsigned long long>(times.first),
                fault.c_str(), times.second.c_str());
  }
  std::fflush(stdout);
}

// Whether everything was proven.
bool run(const Settings& settings) {
  struct Job {
    const QueryStratum* stratum;
    CertifiedQuery query;
  };
  std::vector<Job> jobs;
  const auto is_named = [&](std::string_view name) { return std::ranges::count(settings.names, name) > 0; };
  const bool all_strata =
      std::ranges::none_of(query_strata(), [&](const QueryStratum& stratum) { return is_named(stratum.name); });
  const bool all_queries =
      std::ranges::none_of(kCertifiedQueries, [&](CertifiedQuery query) { return is_named(name_of(query)); });
  for (const QueryStratum& stratum : query_strata()) {
    for (const CertifiedQuery query : kCertifiedQueries) {
      if ((all_strata || is_named(stratum.name)) && (all_queries || is_named(name_of(query))))
        jobs.push_back({&stratum, query});
    }
  }
  std::printf("%-10s %-9s %8s %8s %8s %6s %6s %9s %9s %9s %8s %7s\n", "stratum", "query", "asked", "disjoint",
              "overlap", "undec.", "wrong", "median us", "99.9 %", "slowest", "widest", "calls");
  std::atomic<std::size_t> next = 0;
  std::uint64_t n = 0, n_unproven = 0;
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size(); k = next++) {
      const auto& [stratum, query] = jobs[k];
      const std::string seed_text =
          stratum->name + " " + std::string(name_of(query)) + " " + std::to_string(settings.seed);
      std::seed_seq seeds(seed_text.begin(), seed_text.end());
      std::mt19937_64 random(seeds);
      Row row;
      for (int i = 0; i < scenes_of(query, settings.n_scenes); ++i) {
        const QueryScene scene = stratum->scene(random, i);
        row.add(scene, ask(scene, query));
      }
      const std::lock_guard lock(printing);
      if (row.n > 0) print_row(*stratum, query, row);
      n += row.n;
      n_unproven += row.n_unproven;
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < settings.n_threads; ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  std::printf("%llu answers, %llu of them not proven\n", static_cast<unsigned long long>(n),
              static_cast<unsigned long long>(n_unproven));
  return n > 0 && n_unproven == 0;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::Settings settings;
  for (int k = 1; k < argc; ++k) {
    const std::string text = argv[k];
    const std::pair<const char*, int*> options[] = {
        {"--scenes", &settings.n_scenes}, {"--threads", &settings.n_threads}, {"--seed", &settings.seed}};
    const auto* const option = std::ranges::find_if(options, [&](const auto& one) { return text == one.first; });
    const bool is_name = vex::is_name(text);
    if (!is_name && (option == std::end(options) || ++k == argc)) {
      std::fprintf(stderr, "usage: %s [--scenes N] [--threads N] [--seed N] [STRATUM...] [QUERY...]\n", argv[0]);
      return 2;
    }
    if (is_name) {
      settings.names.push_back(text);
    } else {
      *option->second = std::atoi(argv[k]);
    }
  }
  return vex::run(settings) ? 0 : 1;
}
