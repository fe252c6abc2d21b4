#include "engine/sampling/rank_worker.h"

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "engine/sampling/rank_crew.h"
#include "engine/sampling/run_state_text.h"

namespace vex {
namespace {

class TrialWork {
 public:
  using Record = BlockRecord;
  TrialWork(RunnerFactory& factory, const MonteCarloSettings& settings) : factory_(factory), settings_(settings) {}

  // Its pieces take a hundredth of a second.
  struct Runner {
    std::unique_ptr<TrialRunner> runner;
    BlockRecord run(std::uint64_t begin, std::uint64_t end, const std::atomic<bool>& /*is_over*/) const {
      return runner->run(begin, end);
    }
  };
  std::unique_ptr<Runner> make() { return std::make_unique<Runner>(Runner{factory_.make()}); }
  std::uint64_t grain() const { return factory_.grain(); }

  std::string text(std::uint64_t begin, std::uint64_t /*end*/, BlockRecord&& record) const {
    RunState state;
    state.first_trial = begin;
    state.done = std::move(record);
    state.done.keep_first();
    if (!settings_.integrand) {
      state.domain = settings_.domain.kind;
      state.domain_volume = settings_.domain.volume;
    }
    return run_state_text(state);
  }

 private:
  RunnerFactory& factory_;
  const MonteCarloSettings& settings_;
};

}  // namespace

void work_for_leader(RunnerFactory& factory, const MonteCarloSettings& settings) {
  TrialWork work(factory, settings);
  RankCrew<TrialWork>(work, settings.n_threads, *settings.ranks).go();
}

}  // namespace vex
