// What a rank that does not lead does with its threads, whatever is made (internal).
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
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

/// The threads of a rank that does not lead. `Work` is what they share:
///   Record              what trials brought; a default one of none, `+=` a Record&& of others in any order
///   make()              for the thread that calls; its run(begin, end, is_over) gives the Record of trials begin ...
///                       end - 1, which is not wanted any more once `is_over` says so
///   grain()             blocks begin at multiples of it
///   text(begin, end, Record&&)   what is handed in of a block
template <class Work>
class RankCrew {
 public:
  RankCrew(Work& work, int n_threads, Ranks& ranks) : work_(work), n_threads_(n_threads), ranks_(ranks) {}

  void go() {
    ranks_.begin();
    {
      std::vector<std::jthread> threads;
      try {
        start_threads(threads, n_threads_, [this](int) { work(); });
        if (threads.empty()) throw UsageError("this system starts no thread beside a rank's first - start fewer ranks");
        note_threads(n_threads_, static_cast<int>(threads.size()));
        exchange_messages();
      } catch (...) {
        fail(std::current_exception());
      }
      stop();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }

  // A block of the leader's, of which threads take pieces.
  struct Order {
    std::uint64_t begin, end, next;
    std::uint64_t n_done = 0;
    typename Work::Record record;
    std::chrono::steady_clock::time_point start;
  };
  static constexpr double kPieceSeconds = 0.01;
  static constexpr auto kBetweenMessages = std::chrono::milliseconds(1);

  void work() {
    try {
      const auto runner = work_.make();
      std::uint64_t most = 16 * work_.grain();
      std::unique_lock lock(mutex_);
      while (!is_over_) {
        const auto order = std::ranges::find_if(orders_, [](const Order& one) { return one.next < one.end; });
        if (order == orders_.end()) {
          arrived_.wait(lock);
          continue;
        }
        if (order->next == order->begin) order->start = std::chrono::steady_clock::now();
        const std::uint64_t begin = order->next, end = begin + std::min(most, order->end - begin);
        order->next = end;
        lock.unlock();
        const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        typename Work::Record done = runner->run(begin, end, is_over_);
        const double seconds = seconds_between(start, std::chrono::steady_clock::now());
        if (end - begin == most && seconds < 0.5 * kPieceSeconds) most *= 2;
        if (seconds > kPieceSeconds && most > work_.grain()) most /= 2;
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
    std::uint64_t most = 16 * work_.grain() * static_cast<std::uint64_t>(n_threads_);
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
        const double seconds = seconds_between(finished->start, std::chrono::steady_clock::now());
        if (finished->end - finished->begin == most && seconds < 0.5 * order_seconds()) most *= 2;
        if (seconds > order_seconds() && most > work_.grain()) most /= 2;
        ranks_.hand_in(work_.text(finished->begin, finished->end, std::move(finished->record)));
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

  Work& work_;
  const int n_threads_;
  Ranks& ranks_;
  std::mutex mutex_;
  std::condition_variable arrived_, done_;
  std::list<Order> orders_;            // a thread keeps hold of the one that it has a piece of
  std::atomic<bool> is_over_ = false;  // changed with the lock held
  std::exception_ptr failure_;
};

}  // namespace vex
