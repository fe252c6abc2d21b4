// Documents of runs that should be equal but for times.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace vex::golden {

/// Without commands, threads, and all that a clock told, wherever it stands; of a state's lines also without the
/// checksum of those that tell a time.
inline nlohmann::json without_times(nlohmann::json document) {
  if (document.is_object()) {
    for (const char* const key : {"command", "threads", "seconds", "trials_per_second", "seconds_to_this_error"}) {
      document.erase(key);
    }
    for (auto& [key, value] : document.items()) value = without_times(value);
  } else if (document.is_array()) {
    nlohmann::json kept = nlohmann::json::array();
    for (const nlohmann::json& value : document) {
      const std::string line = value.is_string() ? value.get<std::string>() : "";
      const auto begins_with = [&line](const char* begin) { return line.starts_with(begin); };
      if (begins_with("seconds ") || begins_with("# seconds: ") || begins_with("# end, ")) continue;
      kept.push_back(without_times(value));
    }
    document = std::move(kept);
  }
  return document;
}

}  // namespace vex::golden
