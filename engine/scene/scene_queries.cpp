// Queries of all pairs that build on the verdicts: distances, contacts, clusters.
#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/scene/scene_impl.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::size_t kBlock = 64;

// work(k, thread) for k below n, blocks of them by whichever thread is free.
template <class Work>
void for_each(std::size_t n, int n_threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const std::size_t n_blocks = (n + kBlock - 1) / kBlock;
  on_threads(static_cast<int>(std::min(static_cast<std::size_t>(n_threads), n_blocks)), [&](int thread) {
    for (std::size_t block = next++; block < n_blocks; block = next++) {
      end_if_interrupted();
      for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, n); ++k) work(k, thread);
    }
  });
}

}  // namespace

void Scene::distances_within(double distance, SceneDistances& out) {
  ScenePairs& near = impl_->pairs_buffer();
  pairs_within(distance, near);
  out.counts = near.counts;
  out.undecided = near.undecided;
  out.entries.resize(near.pairs.size());
  for_each(near.pairs.size(), settings().n_threads, [&](std::size_t k, int) {
    const ScenePair& pair = near.pairs[k];
    out.entries[k] = {
        pair, vex::distance(shape(shape_of(pair.a)), shape(shape_of(pair.b)), Pose::unchecked(relative_pose(pair)))};
  });
}

void Scene::contact_manifolds(SceneManifolds& out, double margin) { contact_manifolds(out, {.margin = margin}); }

void Scene::contact_manifolds(SceneManifolds& out, const ManifoldSettings& asked) {
  check(asked);
  ScenePairs& near = impl_->pairs_buffer();
  pairs_within(asked.margin, near);
  out.counts = near.counts;
  out.undecided = near.undecided;
  out.resize(near.pairs.size());
  std::vector<ManifoldMemory>& memories = impl_->manifold_memories(settings().n_threads);
  for_each(near.pairs.size(), settings().n_threads, [&](std::size_t k, int thread) {
    const ScenePair& pair = near.pairs[k];
    out.entries[k].pair = pair;
    contact_manifold(shape(shape_of(pair.a)), shape(shape_of(pair.b)), Pose::unchecked(relative_pose(pair)), asked,
                     memories[static_cast<std::size_t>(thread)], out.entries[k].manifold);
  });
}

void Scene::clusters(Clusters& out, double distance) {
  // Each thread has clusters of its own, which tell it what it need not test; what joined two of them, or closed a loop
  // around the box, is all that the others need to know.
  const int n_threads = settings().n_threads;
  std::vector<Clusters>& parts = impl_->cluster_parts(n_threads);
  std::vector<std::vector<ScenePair>>& news = impl_->cluster_news(n_threads);
  const auto join = [&](PairSearch& search) {
    const std::size_t thread = static_cast<std::size_t>(&search - &impl_->search(distance, 0));
    news[thread].insert(news[thread].end(), search.pairs.begin(), search.pairs.end());
    search.pairs.clear();
    return true;
  };
  const auto begin = [&](PairSearch& search, int thread) { search.joined = &parts[static_cast<std::size_t>(thread)]; };
  impl_->find_pairs(distance, std::ref(join), std::ref(begin));
  out.reset(end());
  for (BodyId body = 0; body < end(); ++body) {
    if (!has(body)) out.leave_out(body);
  }
  for (const std::vector<ScenePair>& pairs : news) {
    for (const ScenePair& pair : pairs) out.join(pair.a, pair.b, pair.image);
  }
  out.root_at_lowest();
  ScenePairs& rest = impl_->pairs_buffer();
  impl_->collect(rest);
  out.counts = rest.counts;
  // A pair of bodies that are in one cluster anyway may have been asked, or not: that hangs on the order.
  std::copy_if(rest.undecided.begin(), rest.undecided.end(), std::back_inserter(out.undecided),
               [&out](const ScenePair& pair) { return out.would_change(pair.a, pair.b, pair.image); });
}

}  // namespace vex
