#include "apps/vex_stress/measure.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>

#include "apps/referees/general_referee.h"
#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::uint64_t kPosesAtOnce = 16;

constexpr double kSurelySlowUs = 1e5;

double microseconds_of(OverlapBackend& backend, const Pose& pose, Verdict& verdict) {
  const auto start = std::chrono::steady_clock::now();
  verdict = backend.decide(pose);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

void keep_first(std::optional<StressExample>& kept, const StressExample& example) {
  if (!kept || example.index < kept->index) kept = example;
}

// None where the backend has no test of the pair: some find that out only when they build their own bodies (FCL's hulls
// need a volume).
std::unique_ptr<OverlapBackend> instance_of(const BackendKind& kind, const StressPair& pair) {
  if (!kind.takes(pair.a, pair.b)) return nullptr;
  try {
    return kind.make(pair.a, pair.b);
  } catch (const InputError&) {
    if (!kind.is_peer) throw;
    return nullptr;
  }
}

// A pair, its referee, and one instance of every backend that takes it: of one thread.
class Bench {
 public:
  Bench(const StressPair& pair, const GeneralReferee& referee, const std::vector<BackendKind>& kinds)
      : pair_(pair), referee_(referee), kinds_(kinds) {
    for (const BackendKind& kind : kinds) backends_.push_back(instance_of(kind, pair));
  }

  void answer(const StressPose& pose, std::uint64_t index, bool has_band, StressRow& row) {
    const Outcome truth = referee_.judge(pose.a_from_b, pose.normal);
    ++row.n_pairs;
    row.n_overlaps += truth == Outcome::overlap ? 1 : 0;
    row.n_unjudged += truth == Outcome::undecided ? 1 : 0;
    for (std::size_t k = 0; k < backends_.size(); ++k) {
      if (!backends_[k]) continue;
      Verdict verdict;
      double us = microseconds_of(*backends_[k], pose.a_from_b, verdict);
      // A query that looks slow may have been interrupted: the least of three counts. One that takes so long that no
      // interruption explains it is not asked again.
      for (int again = 0; again < 2 && us > row.counts[k].slowest_us && us < kSurelySlowUs; ++again) {
        us = std::min(us, microseconds_of(*backends_[k], pose.a_from_b, verdict));
      }
      count(verdict, truth, us, pose, index, has_band, row.counts[k]);
      if (kinds_[k].name == "gjk" && verdict.outcome != Outcome::undecided) {
        prove_again(verdict.outcome, pose, index, row.counts[k]);
      }
    }
  }

 private:
  void count(const Verdict& verdict, Outcome truth, double us, const StressPose& pose, std::uint64_t index,
             bool has_band, StressCounts& counts) const {
    ++counts.n_pairs;
    counts.slowest_us = std::max(counts.slowest_us, us);
    const bool is_undecided = verdict.outcome == Outcome::undecided;
    if (is_undecided || verdict.by == DecidedBy::double_double || verdict.by == DecidedBy::exact) ++counts.n_escalated;
    if (!is_undecided) {
      if (truth == Outcome::undecided || verdict.outcome == truth) return;
      ++(truth == Outcome::overlap ? counts.n_missed : counts.n_invented);
      keep_first(counts.first_wrong, {index, pair_.name, pose.a_from_b});
      return;
    }
    ++counts.n_undecided;
    if (verdict.reason == UndecidedReason::iteration_cap) ++counts.n_capped;
    const double gap = referee_.gap_bound(pose.a_from_b, pose.normal) / pair_.size();
    counts.widest_undecided = std::max(counts.widest_undecided, gap);
    if (pair_.is_rational() || (has_band && gap > kUndecidedBand)) {
      ++counts.n_beyond_band;
      keep_first(counts.first_beyond_band, {index, pair_.name, pose.a_from_b});
    }
  }

  void prove_again(Outcome claimed, const StressPose& pose, std::uint64_t index, StressCounts& counts) const {
    if (vex::prove_again(pair_.a, pair_.b, pose.a_from_b, claimed).is_proven) return;
    ++counts.n_unproven;
    keep_first(counts.first_unproven, {index, pair_.name, pose.a_from_b});
  }

  const StressPair& pair_;
  const GeneralReferee& referee_;
  const std::vector<BackendKind>& kinds_;
  std::vector<std::unique_ptr<OverlapBackend>> backends_;
};

// What all threads of a measurement share.
struct Shared {
  const Stratum& stratum;
  const StressSettings& settings;
  std::vector<StressPair> pairs;
  std::vector<GeneralReferee> referees;
  std::uint64_t n_poses = 0;
  std::atomic<std::uint64_t> next = 0, n_done = 0;
  std::mutex mutex{};  // of what follows
  StressRow row{};

  bool is_interrupted() const { return settings.interrupt != nullptr && settings.interrupt->load() != 0; }
};

void add_row(StressRow& to, const StressRow& from) {
  to.n_pairs += from.n_pairs;
  to.n_overlaps += from.n_overlaps;
  to.n_unjudged += from.n_unjudged;
  for (std::size_t k = 0; k < to.counts.size(); ++k) {
    // Whichever thread ends first: the example is the one of the smallest index.
    StressCounts& counts = to.counts[k];
    if (from.counts[k].first_wrong) keep_first(counts.first_wrong, *from.counts[k].first_wrong);
    if (from.counts[k].first_beyond_band) keep_first(counts.first_beyond_band, *from.counts[k].first_beyond_band);
    if (from.counts[k].first_unproven) keep_first(counts.first_unproven, *from.counts[k].first_unproven);
    counts.add(from.counts[k]);
  }
}

void work(Shared& shared, bool shows_progress) {
  std::map<std::size_t, Bench> benches;
  StressRow row;
  row.counts.resize(shared.settings.backends.size());
  while (!shared.is_interrupted()) {
    const std::uint64_t first = shared.next.fetch_add(kPosesAtOnce);
    if (first >= shared.n_poses) break;
    const std::uint64_t end = std::min(shared.n_poses, first + kPosesAtOnce);
    for (std::uint64_t index = first; index < end && !shared.is_interrupted(); ++index) {
      const std::size_t k = index % shared.pairs.size();
      const auto bench = benches.try_emplace(k, shared.pairs[k], shared.referees[k], shared.settings.backends).first;
      Draw draw(shared.settings.seed, shared.stratum.name, index);
      bench->second.answer(shared.stratum.place(shared.pairs[k], draw), index, shared.stratum.has_band, row);
      ++shared.n_done;
    }
    if (shows_progress && shared.settings.on_progress) shared.settings.on_progress(shared.n_done);
  }
  const std::lock_guard lock(shared.mutex);
  add_row(shared.row, row);
}

}  // namespace

void StressCounts::add(const StressCounts& other) {
  n_pairs += other.n_pairs;
  n_missed += other.n_missed;
  n_invented += other.n_invented;
  n_undecided += other.n_undecided;
  n_capped += other.n_capped;
  n_escalated += other.n_escalated;
  n_beyond_band += other.n_beyond_band;
  n_unproven += other.n_unproven;
  widest_undecided = std::max(widest_undecided, other.widest_undecided);
  slowest_us = std::max(slowest_us, other.slowest_us);
  if (!first_wrong) first_wrong = other.first_wrong;
  if (!first_beyond_band) first_beyond_band = other.first_beyond_band;
  if (!first_unproven) first_unproven = other.first_unproven;
}

StressRow measure(const Stratum& stratum, const StressSettings& settings) {
  Shared shared{
      stratum, settings, stratum.make_pairs(), {}, std::min<std::uint64_t>(settings.n_pairs, stratum.most_poses)};
  for (const StressPair& pair : shared.pairs) shared.referees.emplace_back(pair.a, pair.b);
  shared.row.name = stratum.name;
  shared.row.bodies = stratum.bodies;
  shared.row.distance = stratum.distance;
  shared.row.counts.resize(settings.backends.size());
  on_threads(settings.n_threads, [&shared](int k) {
    try {
      work(shared, k == 0);
    } catch (...) {
      shared.next = shared.n_poses;  // the others need not go on
      throw;
    }
  });
  shared.row.complete = shared.row.n_pairs == shared.n_poses;
  return shared.row;
}

}  // namespace vex
