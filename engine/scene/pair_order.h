// Pairs that threads have found, in the order of their bodies' numbers (internal).
#pragma once

#include <span>
#include <vector>

#include "engine/scene/pair_search.h"

namespace vex {

/// All pairs of one list of each search, sorted; bodies' numbers are below `end`; 0 where they may be any.
void sort_pairs(std::span<PairSearch> searches, LargeVector<ScenePair> PairSearch::*list, BodyId end, int n_threads,
                std::vector<ScenePair>& out);

/// Pairs whose second bodies have numbers from `first` to below `end`, in the order of these; then by a, and image.
void sort_by_second(std::span<const ScenePair> found, BodyId first, BodyId end, std::vector<ScenePair>& out);

}  // namespace vex
