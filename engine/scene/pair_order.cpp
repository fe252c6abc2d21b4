#include "engine/scene/pair_order.h"

#include <algorithm>

#include "engine/scene/threads.h"

namespace vex {
namespace {

// Below this many pairs a comparison sort is as fast.
constexpr std::size_t kFew = 4096;

}  // namespace

// Counting sort by the first body, then the few pairs of each by comparison: a body has some neighbours only.
void sort_pairs(std::span<PairSearch> searches, std::vector<ScenePair> PairSearch::*list, BodyId end, int n_threads,
                std::vector<ScenePair>& out) {
  std::size_t n = 0;
  for (const PairSearch& search : searches) n += (search.*list).size();
  out.resize(n);
  if (n < kFew || end == 0) {
    auto to = out.begin();
    for (const PairSearch& search : searches) to = std::copy((search.*list).begin(), (search.*list).end(), to);
    std::sort(out.begin(), out.end());
    return;
  }
  // Each thread has a part of the bodies.
  n_threads = static_cast<int>(std::min(static_cast<std::size_t>(n_threads), std::size_t{end}));
  static thread_local std::vector<std::uint32_t> next;
  next.assign(std::size_t{end} + 1, 0);
  std::uint32_t* const at = next.data();
  const auto each_of = [&](const Part& bodies, const auto& what) {
    for (const PairSearch& search : searches) {
      const std::vector<ScenePair>& pairs = search.*list;
      const auto is_here = [&](std::size_t k) {
        return k < pairs.size() && pairs[k].a >= bodies.first && pairs[k].a < bodies.end;
      };
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (k + 2 * kAhead < pairs.size()) __builtin_prefetch(at + pairs[k + 2 * kAhead].a, 1);
        if (is_here(k + kAhead)) __builtin_prefetch(out.data() + at[pairs[k + kAhead].a], 1);
        if (is_here(k)) what(pairs[k]);
      }
    }
  };
  const auto sort_run = [&out](std::size_t first, std::size_t end_of_run) {
    if (end_of_run - first > 16) {
      std::sort(out.data() + first, out.data() + end_of_run);
      return;
    }
    for (std::size_t k = first + 1; k < end_of_run; ++k) {
      const ScenePair pair = out[k];
      std::size_t to = k;
      for (; to > first && pair < out[to - 1]; --to) out[to] = out[to - 1];
      out[to] = pair;
    }
  };
  on_threads(n_threads, [&](int thread) {
    each_of(part_of(end, thread, n_threads), [&](const ScenePair& pair) { ++at[pair.a]; });
  });
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k <= end; ++k) {
    const std::uint32_t here = at[k];
    at[k] = sum;
    sum += here;
  }
  on_threads(n_threads, [&](int thread) {
    const Part bodies = part_of(end, thread, n_threads);
    each_of(bodies, [&](const ScenePair& pair) { out[at[pair.a]++] = pair; });
    // What was the next place of a body's pairs is now the end of them.
    for (std::size_t k = bodies.first; k < bodies.end; ++k) {
      const std::uint32_t first = k == bodies.first ? (k == 0 ? 0 : std::uint32_t(-1)) : at[k - 1];
      if (first == std::uint32_t(-1)) continue;
      if (at[k] - first > 1) sort_run(first, at[k]);
    }
  });
  // The first body of each thread's part: where its pairs begin is what the part before has left.
  for (int thread = 1; thread < n_threads; ++thread) {
    const Part bodies = part_of(end, thread, n_threads);
    if (bodies.first < bodies.end) sort_run(at[bodies.first - 1], at[bodies.first]);
  }
}

}  // namespace vex
