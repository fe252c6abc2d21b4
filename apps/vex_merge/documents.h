// JSON documents of runs that made ranges of one run's trials, read and held against each other.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/vex_merge/options.h"
#include "engine/sampling/run_state.h"

namespace vex {

/// All ranges as one.
struct MergedTrials {
  RunState state;
  nlohmann::ordered_json first;  // the document of the first range, whose other entries are those of all
  std::vector<std::string> of;   // of which run they are
};

/// Reads the documents, puts them in order and adds them. Throws InputError where one is none, or damaged, or of a run
/// that was not ended by its number of trials; where two are of unlike runs; and where trials are in none of them or in
/// two, naming which.
MergedTrials merge_documents(const MergeOptions& options);

}  // namespace vex
