#include "engine/sampling/rank_worker.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/ranks.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

using RankClock = std::chrono::steady_clock;

double seconds_between(RankClock::time_point from, RankClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

class RankWorker {
 public:
  RankWorker(RunnerFactory& factory, const MonteCarloSettings& settings)
      : factory_(factory), settings_(settings), ranks_(*settings.ranks) {}

  void go() {
    {
      std::vector<std::jthread> threads;
      try {
        start_threads(threads, settings_.n_threads, [this](int) { work(); });
        if (threads.empty()) throw UsageError("this system starts no thread beside a rank's first - start fewer ranks");
        note_threads(settings_.n_threads, static_cast<int>(threads.size()));
        exchange_messages();
      } catch (...) {
        fail(std::current_exception());
      }
      stop();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  // A block of the leader's, of which threads take pieces.
  struct Order {
    std::uint64_t begin, end, next;
    std::uint64_t n_done = 0;
    BlockRecord record;
    RankClock::time_point start;
  };
  static constexpr double kPieceSeconds = 0.01;
  static constexpr auto kBetweenMessages = std::chrono::milliseconds(1);

  void work() {
    try {
      const std::unique_ptr<TrialRunner> runner = factory_.make();
      std::uint64_t most = 16 * factory_.grain();
      std::unique_lock lock(mutex_);
      while (!is_over_) {
        const auto order = std::ranges::find_if(orders_, [](const Order& one) { return one.next < one.end; });
        if (order == orders_.end()) {
          arrived_.wait(lock);
          continue;
        }
        if (order->next == order->begin) order->start = RankClock::now();
        const std::uint64_t begin = order->next, end = begin + std::min(most, order->end - begin);
        order->next = end;
        lock.unlock();
        const RankClock::time_point start = RankClock::now();
        BlockRecord done = runner->run(begin, end);
        const double seconds = seconds_between(start, RankClock::now());
        if (end - begin == most && seconds < 0.5 * kPieceSeconds) most *= 2;
        if (seconds > kPieceSeconds && most > factory_.grain()) most /= 2;
        lock.lock();
        order->record += std::move(done);
        order->n_done += end - begin;
        if (order->n_done == order->end - order->begin) done_.notify_all();
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void fail(const std::exception_ptr& failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = failure;
    is_over_ = true;
    arrived_.notify_all();
    done_.notify_all();
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    arrived_.notify_all();
  }

  // A block takes so long: a fifth of a second, and with very many ranks so much longer that no more than 2000 records
  // a second come to the leader (docs/scaling.md).
  double order_seconds() const { return std::max(0.2, 5e-4 * ranks_.n_ranks()); }

  void exchange_messages() {
    std::uint64_t most = 16 * factory_.grain() * static_cast<std::uint64_t>(settings_.n_threads);
    std::size_t n_asked = 0;
    while (true) {
      std::optional<Order> finished;
      std::size_t n_in_stock = 0;
      {
        std::unique_lock lock(mutex_);
        if (is_over_) return;
        done_.wait_for(lock, kBetweenMessages);
        const auto whole =
            std::ranges::find_if(orders_, [](const Order& one) { return one.n_done == one.end - one.begin; });
        if (whole != orders_.end()) {
          finished = std::move(*whole);
          orders_.erase(whole);
        }
        for (const Order& one : orders_) n_in_stock += one.next < one.end ? 1 : 0;
      }
      if (finished) {
        const double seconds = seconds_between(finished->start, RankClock::now());
        if (finished->end - finished->begin == most && seconds < 0.5 * order_seconds()) most *= 2;
        if (seconds > order_seconds() && most > factory_.grain()) most /= 2;
        hand_in(std::move(*finished));
      }
      if (n_in_stock + n_asked < 2) {
        ranks_.ask(most);
        ++n_asked;
      }
      const Ranks::Arrived arrived = ranks_.receive();
      if (arrived.is_over) return;
      if (!arrived.block) continue;
      --n_asked;
      const std::lock_guard lock(mutex_);
      orders_.push_back({arrived.block->begin, arrived.block->end, arrived.block->begin, 0, {}, {}});
      arrived_.notify_all();
    }
  }

  void hand_in(Order&& order) {
    RunState state;
    state.first_trial = order.begin;
    state.done = std::move(order.record);
    state.done.keep_first();
    if (!settings_.integrand) {
      state.domain = settings_.domain.kind;
      state.domain_volume = settings_.domain.volume;
    }
    ranks_.hand_in(state);
  }

  RunnerFactory& factory_;
  const MonteCarloSettings& settings_;
  Ranks& ranks_;
  std::mutex mutex_;
  std::condition_variable arrived_, done_;
  std::list<Order> orders_;  // a thread keeps hold of the one that it has a piece of
  bool is_over_ = false;
  std::exception_ptr failure_;
};

}  // namespace

void work_for_leader(RunnerFactory& factory, const MonteCarloSettings& settings) { RankWorker(factory, settings).go(); }

}  // namespace vex
