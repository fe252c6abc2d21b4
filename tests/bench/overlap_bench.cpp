// What the filter's proofs cost, and overlap queries a second of the engine and of tests made for one kind of pair, on
// the same stored poses, in one run, on one core. The peers: trial_bench.cpp.
//
// Ball domain, isotropic orientations, every backend answers every pose itself (no quick verdicts), except in the rows
// "trial", which time whole trials of the driver: random numbers, pose, quick verdicts, query, tally. In the rows
// "filter" and "trial-filter" the query is the filter alone, and in "...-unproven" that filter with its signs believed
// as they are computed.
#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "apps/common/processor.h"
#include "apps/referees/specialised_backend.h"
#include "engine/query/overlap.h"
#include "engine/query/search/overlap_filter.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "shapes/any_shape.h"
#include "tests/bench/unproven_filter.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

struct Subject {
  std::string name;
  ConvexBody body;
};

std::vector<Subject> subjects() {
  return {{"cube", parse_shape("box:1,1,1").body},
          {"ellipsoid-4:1:1", parse_shape("ellipsoid:4,1,1").body},
          {"capsule-L1-R.25", parse_shape("capsule:1,0.25").body},
          {"cylinder-L1-R.5", parse_shape("cylinder:1,0.5").body},
          {"cone-H1-R.5", parse_shape("cone:1,0.5").body},
          {"hull-100", test_point_hull(100, {1, 1, 1}, 100).body},
          {"hull-100-3:2:1", test_point_hull(100, {3, 2, 1}, 1).body},
          {"hull-10000-3:2:1", test_point_hull(10000, {3, 2, 1}, 1).body}};
}

// More poses than a branch predictor remembers.
constexpr std::size_t kPoses = 1 << 17;

std::vector<Pose> stored_poses(const ConvexBody& body) {
  std::vector<Pose> poses;
  MonteCarloSettings settings;
  settings.domain = ball_domain(body, body);
  for (std::size_t k = 0; k < kPoses; ++k) poses.push_back(Pose::unchecked(trial_pose(body, body, settings, k)));
  return poses;
}

void time_query(benchmark::State& state, const ConvexBody& body, const BackendKind& kind) {
  const std::vector<Pose> poses = stored_poses(body);
  std::vector<Verdict> verdicts(256);
  const std::unique_ptr<OverlapBackend> backend = kind.make(body, body);
  std::size_t first = 0, n_hits = 0, n = 0;
  for (auto _ : state) {
    backend->decide({&poses[first], verdicts.size()}, verdicts);
    for (const Verdict& verdict : verdicts) n_hits += verdict.outcome == Outcome::overlap ? 1 : 0;
    n += verdicts.size();
    first = (first + verdicts.size()) % kPoses;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(n));
  state.counters["hits"] = static_cast<double>(n_hits) / static_cast<double>(n);
}

// A query by the filter alone; what it leaves open stays so.
template <FilterResult (*kFilter)(const ConvexBody&, const ConvexBody&, const Transformd&, int)>
class FilterBackend final : public OverlapBackend {
 public:
  FilterBackend(const ConvexBody& a, const ConvexBody& b) : a_(a), b_(b) {}
  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < a_from_b.size(); ++k) {
      verdicts[k] = kFilter(a_, b_, a_from_b[k].a_from_b(), kMaxSupportCalls).verdict;
    }
  }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
};

template <FilterResult (*kFilter)(const ConvexBody&, const ConvexBody&, const Transformd&, int)>
BackendKind filter_backend(const std::string& name) {
  return {name,
          false,
          [](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<FilterBackend<kFilter>>(a, b); },
          {}};
}

void time_trial(benchmark::State& state, const ConvexBody& body, const Domain& domain,
                const BackendKind& kind = gjk_backend()) {
  MonteCarloSettings settings;
  settings.domain = domain;
  settings.backend = kind;
  settings.stop.trials = kPoses;
  for (auto _ : state) {
    benchmark::DoNotOptimize(run_monte_carlo(body, body, settings));
    ++settings.seed;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoses));
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("compiler", std::string("g++ ") + __VERSION__);
  for (const Subject& subject : subjects()) {
    std::vector<BackendKind> kinds = {gjk_backend()};
    if (specialised_backend().takes(subject.body, subject.body)) kinds.push_back(specialised_backend());
    for (const BackendKind& kind : kinds) {
      benchmark::RegisterBenchmark((subject.name + "/" + kind.name).c_str(),
                                   [subject, kind](benchmark::State& state) { time_query(state, subject.body, kind); });
    }
    const BackendKind proven = filter_backend<filter_overlap>("filter");
    const BackendKind unproven = filter_backend<filter_overlap_unproven>("filter-unproven");
    for (const BackendKind& kind : {proven, unproven}) {
      benchmark::RegisterBenchmark((subject.name + "/" + kind.name).c_str(),
                                   [subject, kind](benchmark::State& state) { time_query(state, subject.body, kind); });
    }
    for (const BackendKind& kind : {proven, unproven}) {
      benchmark::RegisterBenchmark(
          (subject.name + (kind.name == "filter" ? "/trial-filter" : "/trial-unproven")).c_str(),
          [subject, kind](benchmark::State& state) {
            time_trial(state, subject.body, ball_domain(subject.body, subject.body), kind);
          })
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
#ifdef VEX_HAS_UNPROVEN_KERNEL
    benchmark::RegisterBenchmark((subject.name + "/trial-packets-unproven").c_str(),
                                 [subject](benchmark::State& state) {
                                   time_trial(state, subject.body, ball_domain(subject.body, subject.body),
                                              gjk_backend_with(unproven_kernel::new_packet_overlap));
                                 })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
#endif
    for (const Domain& domain : {ball_domain(subject.body, subject.body), fitted_domain(subject.body, subject.body)}) {
      const std::string name = domain.kind == Domain::Kind::fitted ? "/trial-fitted" : "/trial";
      benchmark::RegisterBenchmark(
          (subject.name + name).c_str(),
          [subject, domain](benchmark::State& state) { time_trial(state, subject.body, domain); })
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
