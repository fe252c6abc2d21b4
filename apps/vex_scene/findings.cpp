#include "apps/vex_scene/findings.h"

#include <algorithm>
#include <chrono>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// Bodies were moved into the box, a by i_a and b by i_b: from b as the file has it, seen from a as the file has it, the
// copy is i_b - i_a farther. The order of pairs stays: that is one number for all images of two bodies.
ScenePair as_in_the_file(const Scene& scene, ScenePair pair) {
  const ImageOffset of_a = scene.image(pair.a), of_b = scene.image(pair.b);
  for (std::size_t k = 0; k < 3; ++k) pair.image[k] += of_b[k] - of_a[k];
  return pair;
}

void merge_undecided(const Scene& scene, const std::vector<ScenePair>& undecided, Findings& found) {
  found.n_undecided = undecided.size();
  if (undecided.empty()) return;
  for (const ScenePair& pair : undecided) found.pairs.push_back({as_in_the_file(scene, pair), 0.0, true});
  const auto middle = found.pairs.end() - static_cast<std::ptrdiff_t>(undecided.size());
  std::inplace_merge(found.pairs.begin(), middle, found.pairs.end(),
                     [](const FoundPair& x, const FoundPair& y) { return x.pair < y.pair; });
}

void ask_pairs(Scene& scene, bool are_listed, Findings& found) {
  ScenePairs answer;
  scene.overlapping_pairs(answer);
  found.n_pairs = answer.pairs.size();
  if (are_listed) {
    found.pairs.reserve(answer.pairs.size() + answer.undecided.size());
    for (const ScenePair& pair : answer.pairs) found.pairs.push_back({as_in_the_file(scene, pair)});
  }
  merge_undecided(scene, answer.undecided, found);
  found.counts = answer.counts;
}

void ask_within(Scene& scene, double distance, Findings& found) {
  SceneDistances answer;
  scene.distances_within(distance, answer);
  found.pairs.reserve(answer.entries.size());
  for (const SceneDistances::Entry& entry : answer.entries) {
    found.pairs.push_back({as_in_the_file(scene, entry.pair), std::max(0.0, entry.separation.signed_distance)});
  }
  found.n_pairs = answer.entries.size();
  merge_undecided(scene, answer.undecided, found);
  found.counts = answer.counts;
}

void ask_any(Scene& scene, Findings& found) {
  found.answer = scene.any_overlap();
  if (found.answer.outcome != Outcome::disjoint) found.answer.pair = as_in_the_file(scene, found.answer.pair);
  found.n_undecided = found.answer.n_undecided;
  found.counts = found.answer.counts;
}

void ask_clusters(Scene& scene, double distance, Findings& found) {
  Clusters clusters;
  scene.clusters(clusters, distance);
  merge_undecided(scene, clusters.undecided, found);
  found.counts = clusters.counts;
  found.labels = clusters.labels();
  found.clusters.resize(clusters.n_clusters());
  for (std::uint32_t body = 0; body < found.labels.size(); ++body) {
    FoundCluster& cluster = found.clusters[found.labels[body]];
    if (cluster.n_bodies++ > 0) continue;
    cluster.label = found.labels[body];
    cluster.wraps = clusters.wraps(body);
  }
  const auto largest = std::ranges::max_element(found.clusters, {}, &FoundCluster::n_bodies);
  if (largest != found.clusters.end()) found.largest_cluster = largest->label;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::size_t Findings::n_wrapping_clusters() const {
  return static_cast<std::size_t>(std::ranges::count_if(clusters, &FoundCluster::wraps_at_all));
}

Scene scene_of(const SceneInput& input, const std::vector<LoadedBody>& bodies, const std::optional<PeriodicBox>& box,
               const SceneSettings& settings) {
  Scene scene = box ? Scene(*box, settings) : Scene(settings);
  std::vector<ShapeId> shapes;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    try {
      shapes.push_back(scene.add_shape(bodies[k].shape.body));
    } catch (const InputError& error) {
      const std::uint64_t line = input.shapes()[k].line;
      const std::string place = line == 0 ? bodies[k].source : input.source() + ", line " + std::to_string(line);
      throw InputError(place + ": " + error.what());
    }
  }
  for (std::size_t k = 0; k < input.n_bodies(); ++k) {
    try {
      scene.add(shapes[input.shapes_of_bodies[k]], input.poses[k]);
    } catch (const InputError& error) {
      throw InputError(input.place_of(k) + ": " + error.what());
    }
  }
  return scene;
}

Findings ask(Scene& scene, SceneQuery query, double distance) {
  Findings found;
  const auto start = std::chrono::steady_clock::now();
  switch (query) {
    case SceneQuery::pairs: ask_pairs(scene, true, found); break;
    case SceneQuery::within: ask_within(scene, distance, found); break;
    case SceneQuery::any: ask_any(scene, found); break;
    case SceneQuery::clusters: ask_clusters(scene, distance, found); break;
    case SceneQuery::counts: ask_pairs(scene, false, found); break;
  }
  found.query_seconds = seconds_since(start);
  found.is_complete = true;
  return found;
}

}  // namespace vex
