// Every pair of a scene's bodies, copies in the box included, by brute force; and what of a scene's answers is not so.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "tests/referees/random_scenes.h"

namespace vex {

/// In the order of ScenePairs.
struct EveryPair {
  std::vector<ScenePair> pairs, undecided;
  std::uint64_t n_asked = 0;     // pairs whose balls meet
  std::uint64_t n_own = 0;       // of the pairs: bodies with copies of themselves
  std::uint64_t n_repeated = 0;  // of the pairs: with another copy of the same two bodies before
};

/// Asks `overlap` of every two bodies whose balls are within the margin of each other, and of every copy: whether they
/// are within the margin, in the pose Scene::relative_pose tells.
EveryPair every_pair(const Scene& scene, double margin = 0.0);

// Empty where the scene answers as brute force does; otherwise what is wrong, in a line.

/// overlapping_pairs and any_overlap.
std::string fault_of_pairs(Scene& scene, const EveryPair& every);
/// pairs_within.
std::string fault_within(Scene& scene, double margin);
/// distances_within: against `distance` of every pair, which knows nothing of margins.
std::string fault_of_distances(Scene& scene, double margin);
/// contact_manifolds.
std::string fault_of_manifolds(Scene& scene, double margin);
/// overlaps_of, of every body.
std::string fault_of_single_bodies(Scene& scene, const EveryPair& every);
/// would_overlap of a body at a pose: the same as moving it there and asking brute force. It is moved back.
std::string fault_of_trial_move(Scene& scene, BodyId body, const Pose& pose);
/// Clusters, by a search through the graph of brute force's pairs: labels, sizes, offsets, wrapping.
std::string fault_of_clusters(Scene& scene, const EveryPair& every, double distance = 0.0);
/// overlaps_of_added from this body on, of pairs and of clusters that grow by them.
std::string fault_of_added(Scene& scene, const EveryPair& every, BodyId first);
/// All of the above.
std::string fault_of_scene(Scene& scene, const RandomScene& made, const EveryPair& every, std::mt19937_64& random);

}  // namespace vex
