// What a scene answered, in terms of the file that it was read from.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/vex_scene/loaded_bodies.h"
#include "apps/vex_scene/options.h"
#include "engine/scene/scene.h"

namespace vex {

/// A pair, with the image of b counted from where the file puts b, seen from where it puts a; and what is known of it.
struct FoundPair {
  ScenePair pair;
  double distance = 0.0;  // of --query within
  bool is_undecided = false;
};

/// A cluster, by its number.
struct FoundCluster {
  std::uint32_t label = 0, n_bodies = 0;
  std::array<bool, 3> wraps{};  // along the vectors of the box

  bool wraps_at_all() const { return wraps[0] || wraps[1] || wraps[2]; }
};

struct Findings {
  bool is_complete = false;  // false: interrupted, and then nothing below is known
  std::vector<FoundPair>
      pairs;  // of pairs and within, sorted by a, b, image; of every query but `any` those that are undecided
  std::uint64_t n_pairs = 0;                 // proven
  std::optional<std::uint64_t> n_undecided;  // pairs; none where `any` ended at an overlap
  SceneAnswer answer;                        // of any; its pair as the file has it
  std::vector<std::uint32_t> labels;         // of clusters: the cluster of each body
  std::vector<FoundCluster> clusters;        // in the order of their labels
  std::uint32_t largest_cluster = 0;         // the first of the largest, where there are bodies
  SceneCounts counts;
  double build_seconds = 0.0, query_seconds = 0.0;

  std::size_t n_wrapping_clusters() const;
};

/// The bodies of `input`, by their numbers. Throws InputError with the line of a body that no scene takes.
Scene scene_of(const SceneInput& input, const std::vector<LoadedBody>& bodies, const std::optional<PeriodicBox>& box,
               const SceneSettings& settings);

/// Asks the scene.
Findings ask(Scene& scene, SceneQuery query, double distance);

}  // namespace vex
