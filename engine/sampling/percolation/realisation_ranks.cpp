#include "engine/sampling/percolation/realisation_ranks.h"

#include <atomic>
#include <map>
#include <memory>
#include <utility>

#include "engine/sampling/rank_crew.h"
#include "engine/sampling/run_state_words.h"

namespace vex {
namespace {

constexpr std::uint64_t kMostNumber = 0xffffffffu;

class RealisationWork {
 public:
  // Of one size, as all of a block.
  struct Record {
    std::map<std::uint32_t, WrappingNumbers> numbers;
    PercolationCounts counts;
    Record& operator+=(Record&& more) {
      numbers.merge(more.numbers);
      counts += more.counts;
      return *this;
    }
  };
  explicit RealisationWork(std::span<const PercolationSystem* const> systems) : systems_(systems) {}

  class Runner {
   public:
    explicit Runner(std::span<const PercolationSystem* const> systems) : systems_(systems), made_(systems.size()) {}
    Record run(std::uint64_t begin, std::uint64_t end, const std::atomic<bool>& is_over) {
      Record record;
      const std::size_t size = begin >> 32;
      if (size >= systems_.size())
        throw InputError("the leader asks for a size that is none - give all ranks the same sizes");
      if (made_[size] == nullptr) made_[size] = std::make_unique<Realisation>(*systems_[size]);
      for (std::uint64_t k = begin; k < end && !is_over; ++k) {
        const auto realisation = static_cast<std::uint32_t>(k & kMostNumber);
        const std::optional<WrappingNumbers> numbers =
            made_[size]->run(realisation, [&is_over] { return is_over.load(); });
        if (!numbers) break;
        record.numbers.emplace(realisation, *numbers);
        record.counts += made_[size]->counts();
      }
      return record;
    }

   private:
    std::span<const PercolationSystem* const> systems_;
    std::vector<std::unique_ptr<Realisation>> made_;  // in the memory of the size's last one
  };
  std::unique_ptr<Runner> make() const { return std::make_unique<Runner>(systems_); }
  std::uint64_t grain() const { return 1; }

  std::string text(std::uint64_t begin, std::uint64_t /*end*/, Record&& record) const {
    MadeRealisations made{
        static_cast<std::uint32_t>(begin >> 32), static_cast<std::uint32_t>(begin & kMostNumber), {}, record.counts};
    for (const auto& [realisation, numbers] : record.numbers) made.numbers.push_back(numbers);
    return made_text(made);
  }

 private:
  std::span<const PercolationSystem* const> systems_;
};

}  // namespace

std::string made_text(const MadeRealisations& made) {
  const auto add = [](std::string& text, std::uint64_t n) { text += ' ' + std::to_string(n); };
  std::string text = "realisations";
  for (const std::uint64_t n :
       {std::uint64_t{made.size}, std::uint64_t{made.first}, std::uint64_t{made.numbers.size()}}) {
    add(text, n);
  }
  text += "\ncounts";
  add(text, made.counts.n_bodies);
  add(text, made.counts.n_undecided);
  for (const SceneCounts::Stage& stage : made.counts.stages.stages) {
    add(text, stage.seen);
    add(text, stage.settled);
  }
  for (const WrappingNumbers& numbers : made.numbers) {
    text += "\nwraps";
    for (const std::uint32_t n : numbers.along) add(text, n);
  }
  return text + "\n";
}

MadeRealisations read_made(std::string_view text) {
  RunStateWords from(text);
  MadeRealisations made;
  from.line("realisations");
  made.size = static_cast<std::uint32_t>(from.count(kMostSizes));
  made.first = static_cast<std::uint32_t>(from.count(kMostRealisations));
  const std::uint64_t n = from.count(kMostRealisations);
  from.line("counts");
  made.counts.n_bodies = from.count();
  made.counts.n_undecided = from.count();
  for (SceneCounts::Stage& stage : made.counts.stages.stages) {
    stage.seen = from.count();
    stage.settled = from.count();
  }
  for (std::uint64_t k = 0; k < n; ++k) {
    from.line("wraps");
    WrappingNumbers numbers;
    for (std::uint32_t& along : numbers.along) along = static_cast<std::uint32_t>(from.count(kMostNumber));
    made.numbers.push_back(numbers);
  }
  from.end();
  return made;
}

void make_realisations_for_leader(std::span<const PercolationSystem* const> systems, int n_threads, Ranks& ranks) {
  RealisationWork work(systems);
  RankCrew<RealisationWork>(work, n_threads, ranks).go();
}

}  // namespace vex
