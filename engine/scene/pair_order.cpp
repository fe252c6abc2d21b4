#include "engine/scene/pair_order.h"

#include <algorithm>
#include <utility>

#include "engine/scene/threads.h"

namespace vex {
namespace {

// Below this many pairs a comparison sort is as fast.
constexpr std::size_t kFew = 4096;
constexpr std::size_t kBodiesABucket = 4096;

// Pairs of one body.
bool comes_before(const ScenePair& p, const ScenePair& q) { return p.b != q.b ? p.b < q.b : p.image < q.image; }
void sort_run(std::span<ScenePair> pairs) {
  if (pairs.size() > 16) {
    std::sort(pairs.begin(), pairs.end(), comes_before);
    return;
  }
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const ScenePair pair = pairs[k];
    std::size_t to = k;
    for (; to > 0 && comes_before(pair, pairs[to - 1]); --to) pairs[to] = pairs[to - 1];
    pairs[to] = pair;
  }
}

// Pairs whose first bodies are `first` and the next kBodiesABucket - 1.
void sort_bucket(std::span<ScenePair> pairs, BodyId first) {
  if (pairs.size() >> 32 != 0) return std::sort(pairs.begin(), pairs.end());  // more than is counted here
  static thread_local std::vector<ScenePair> unsorted;                        // memory that a thread keeps
  unsorted.assign(pairs.begin(), pairs.end());
  std::uint32_t next[kBodiesABucket] = {};
  for (const ScenePair& pair : unsorted) ++next[pair.a - first];
  std::uint32_t sum = 0;
  for (std::uint32_t& place : next) sum += std::exchange(place, sum);
  for (const ScenePair& pair : unsorted) pairs[next[pair.a - first]++] = pair;
  // What was the next place of a body's pairs is now the end of them.
  std::size_t begin = 0;
  for (const std::size_t end : next) {
    if (end - begin > 1) sort_run(pairs.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace

// Counting sort by the first body: first into buckets of bodies with neighbouring numbers, then within each, so that
// what is counted and written at once stays in a core's own cache. Then the few pairs of each body by comparison.
void sort_pairs(std::span<PairSearch> searches, LargeVector<ScenePair> PairSearch::*list, BodyId end, int n_threads,
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
  const std::size_t n_buckets = (std::size_t{end} - 1) / kBodiesABucket + 1;
  static thread_local std::vector<std::size_t> places, ends;
  places.assign(n_buckets * searches.size(), 0);
  ends.resize(n_buckets);
  // Of the calling thread, for all.
  std::size_t* const place_of = places.data();
  share_parts(n_threads, searches.size(), [&](std::size_t which) {
    std::size_t* const count = place_of + n_buckets * which;
    for (const ScenePair& pair : searches[which].*list) ++count[pair.a / kBodiesABucket];
  });
  std::size_t sum = 0;
  for (std::size_t bucket = 0; bucket < n_buckets; ++bucket) {
    for (std::size_t which = 0; which < searches.size(); ++which) {
      sum += std::exchange(places[n_buckets * which + bucket], sum);
    }
    ends[bucket] = sum;
  }
  share_parts(n_threads, searches.size(), [&](std::size_t which) {
    std::size_t* const next = place_of + n_buckets * which;
    for (const ScenePair& pair : searches[which].*list) out[next[pair.a / kBodiesABucket]++] = pair;
  });
  const std::size_t* const end_of = ends.data();
  share_parts(n_threads, n_buckets, [&](std::size_t bucket) {
    const std::size_t first = bucket == 0 ? 0 : end_of[bucket - 1];
    sort_bucket({out.data() + first, end_of[bucket] - first}, static_cast<BodyId>(bucket * kBodiesABucket));
  });
}

}  // namespace vex
