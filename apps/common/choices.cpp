#include "apps/common/choices.h"

#include <algorithm>

#include "engine/numeric/errors.h"

namespace vex {

void require_one_of(const std::string& word, const char* option, const std::vector<std::string_view>& choices) {
  if (std::ranges::find(choices, word) != choices.end()) return;
  std::string list;
  for (const std::string_view choice : choices) list += (list.empty() ? "" : ", ") + std::string(choice);
  throw UsageError("not a choice (\"" + word + "\" for " + option + ") - there are " + list);
}

}  // namespace vex
