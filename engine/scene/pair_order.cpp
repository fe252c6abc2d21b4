#include "engine/scene/pair_order.h"

#include <algorithm>
#include <utility>

#include "engine/scene/short_sort.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// Below this many pairs a comparison sort is as fast.
constexpr std::size_t kFew = 4096;
constexpr std::size_t kBodiesABucket = 4096;
// Counting costs more than comparing where there are so many bodies a pair.
constexpr std::size_t kManyBodies = 16;
constexpr std::size_t kMostCounted = ~std::uint32_t{0};

// Pairs that have one of their bodies in common, by the other one.
template <BodyId ScenePair::*kOther>
void sort_run(std::span<ScenePair> pairs) {
  sort_short(pairs, [](const ScenePair& p, const ScenePair& q) {
    return p.*kOther != q.*kOther ? p.*kOther < q.*kOther : p.image < q.image;
  });
}

// Counting sort by the numbers of one of the bodies, `first` being the lowest, then each body's pairs by comparison.
// `next` has an entry of 0 for each number.
template <BodyId ScenePair::*kBody, BodyId ScenePair::*kOther>
void sort_by(BodyId first, std::span<const ScenePair> unsorted, std::span<std::uint32_t> next, ScenePair* to) {
  for (const ScenePair& pair : unsorted) ++next[pair.*kBody - first];
  std::uint32_t sum = 0;
  for (std::uint32_t& place : next) sum += std::exchange(place, sum);
  for (const ScenePair& pair : unsorted) to[next[pair.*kBody - first]++] = pair;
  // What was the next place of a body's pairs is now the end of them.
  std::size_t begin = 0;
  for (const std::size_t end : next) {
    if (end - begin > 1) sort_run<kOther>({to + begin, end - begin});
    begin = end;
  }
}

// Pairs whose first bodies are `first` and the next kBodiesABucket - 1.
void sort_bucket(std::span<ScenePair> pairs, BodyId first) {
  if (pairs.size() > kMostCounted) return std::sort(pairs.begin(), pairs.end());
  static thread_local std::vector<ScenePair> unsorted;  // memory that a thread keeps
  unsorted.assign(pairs.begin(), pairs.end());
  std::uint32_t next[kBodiesABucket] = {};
  sort_by<&ScenePair::a, &ScenePair::b>(first, unsorted, next, pairs.data());
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

void sort_by_second(std::span<const ScenePair> found, BodyId first, BodyId end, std::vector<ScenePair>& out) {
  const std::size_t n = std::size_t{end} - first;
  if (found.size() < n / kManyBodies || found.size() > kMostCounted) {
    out.assign(found.begin(), found.end());
    std::sort(out.begin(), out.end(),
              [](const ScenePair& p, const ScenePair& q) { return p.b != q.b ? p.b < q.b : p < q; });
    return;
  }
  static thread_local std::vector<std::uint32_t> next;  // memory that a thread keeps
  next.assign(n, 0);
  out.resize(found.size());
  sort_by<&ScenePair::b, &ScenePair::a>(first, found, next, out.data());
}

}  // namespace vex
