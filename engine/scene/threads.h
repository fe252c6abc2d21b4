// Work shared among threads (internal): the one place that starts threads. A system that gives fewer than were asked
// for (`ulimit -u`, a filter of system calls, memory) costs time and nothing else.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "engine/numeric/interruption.h"

namespace vex {

/// Fewer threads than were asked for.
struct ThreadShortage {
  int n_wanted = 0, n_had = 0;  // n_had with the caller's own, where that works too
};

/// The worst one that this process has had so far; none where it always had all. For a note to the user.
std::optional<ThreadShortage> thread_shortage();

/// For `thread_shortage`.
void note_threads(int n_wanted, int n_had);

/// Starts threads behind those that are there, each for work(k), k being its place among them, until there are
/// `n_wanted`, or the system gives no more.
template <class Work>
void start_threads(std::vector<std::jthread>& threads, int n_wanted, const Work& work) {
  try {
    threads.reserve(static_cast<std::size_t>(n_wanted));
    while (static_cast<int>(threads.size()) < n_wanted) threads.emplace_back(work, static_cast<int>(threads.size()));
  } catch (const std::exception&) {
    // A std::system_error where the system refuses, std::bad_alloc where there is no memory for one more. What it would
    // have done is done by the others, or by whoever called.
  }
}

/// work(k) for k = 0 ... n - 1, each on a thread of its own, the first on the caller's, whose Interruption all of them
/// heed. The first exception is thrown again once all have ended, one that tells more than that the work was
/// interrupted before others: a failure ends the rest of the work by an interruption.
template <class Work>
void on_threads(int n, Work&& work) {
  if (n <= 1) {
    work(0);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(n)), interruptions(failures.size());
  const auto guarded = [&](int k) {
    try {
      work(k);
    } catch (const Interrupted&) {
      interruptions[static_cast<std::size_t>(k)] = std::current_exception();
    } catch (...) {
      failures[static_cast<std::size_t>(k)] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    start_threads(threads, n - 1, [&, interruption = Interruption::current()](int k) {
      const SharedInterruption shared(interruption);
      guarded(k + 1);
    });
    note_threads(n, static_cast<int>(threads.size()) + 1);
    guarded(0);
    // What a thread that cannot be had would have done is done here, after the caller's own part.
    for (int k = static_cast<int>(threads.size()) + 1; k < n; ++k) guarded(k);
  }
  for (const auto* const of_threads : {&failures, &interruptions}) {
    for (const std::exception_ptr& failure : *of_threads) {
      if (failure) std::rethrow_exception(failure);
    }
  }
}

/// work(part) for every part in [0, n_parts), by at most `n_threads`; which of them takes a part is open. Each asks
/// before a part whether the work is to end, so that whoever shares work must be fit to do it anew.
template <class Work>
void share_parts(int n_threads, std::size_t n_parts, const Work& work) {
  std::atomic<std::size_t> next{0};
  const std::size_t n = std::min(static_cast<std::size_t>(std::max(n_threads, 1)), n_parts);
  on_threads(static_cast<int>(n), [&](int) {
    for (std::size_t part = next++; part < n_parts; part = next++) {
      end_if_interrupted();
      work(part);
    }
  });
}

/// work(first, last) for ranges that make up [0, n): about four a thread, or more where an interruption would wait long
/// for one; none of fewer than `least` but the last, each of a multiple of `least`.
template <class Work>
void share_range(int n_threads, std::size_t n, std::size_t least, const Work& work) {
  const std::size_t n_parts = n_threads > 1 ? 4 * static_cast<std::size_t>(n_threads) : 1;
  constexpr std::size_t kMost = std::size_t{1} << 16;
  const std::size_t part = std::max<std::size_t>((std::min(n / n_parts, kMost) + least) / least, 1) * least;
  share_parts(n_threads, (n + part - 1) / part, [&](std::size_t k) { work(k * part, std::min(n, (k + 1) * part)); });
}

/// The k-th of n parts of 0 ... size, in order: its first and its end.
struct Part {
  std::size_t first, end;
};
inline Part part_of(std::size_t size, int k, int n) {
  const auto at = [&](int j) { return size * static_cast<std::size_t>(j) / static_cast<std::size_t>(n); };
  return {at(k), at(k + 1)};
}

}  // namespace vex
