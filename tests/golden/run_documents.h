// Documents of vex_mesh that should be equal but for times.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vex::golden {

/// Without the command, the threads, and all that a clock told.
inline nlohmann::json without_times(nlohmann::json document) {
  for (const char* const key : {"command", "threads", "seconds"}) document.erase(key);
  for (const char* const key : {"seconds", "trials_per_second"}) document.at("estimate").erase(key);
  if (document.contains("pilot")) {
    for (nlohmann::json& candidate : document["pilot"]) candidate.erase("seconds_to_this_error");
  }
  nlohmann::json& lines = document.at("tally").at("state");
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].get<std::string>().starts_with("seconds ")) lines.erase(k);
  }
  return document;
}

}  // namespace vex::golden
