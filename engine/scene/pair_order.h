// Pairs that threads have found, in the order of their bodies' numbers (internal).
#pragma once

#include <span>
#include <vector>

#include "engine/scene/pair_search.h"

namespace vex {

/// All pairs of one list of each search, sorted; bodies' numbers are below `end`; 0 where they may be any.
void sort_pairs(std::span<PairSearch> searches, LargeVector<ScenePair> PairSearch::*list, BodyId end, int n_threads,
                std::vector<ScenePair>& out);

}  // namespace vex
