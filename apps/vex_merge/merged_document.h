// One result from trials that were put together: what one run of all of them would have said.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/vex_merge/documents.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {

struct MergedResult {
  ExcludedVolume result;
  nlohmann::ordered_json document;  // one run's, but for the command; seconds are the sum, threads those of the first
};

/// Throws InputError where a document lacks what it takes.
MergedResult merged_result(const MergedTrials& merged, const std::string& command);

}  // namespace vex
