#include "apps/common/choices.h"

#include <algorithm>

#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"

namespace vex {

void require_one_of(const std::string& word, const char* option, std::initializer_list<std::string_view> built,
                    std::initializer_list<std::string_view> planned) {
  if (std::ranges::find(built, word) != built.end()) return;
  const std::string name = word.substr(0, word.find(':'));
  if (std::ranges::find(planned, name) != planned.end()) not_built_yet(std::string(option) + " " + word);
  std::string choices;
  for (const std::string_view choice : built) choices += (choices.empty() ? "" : ", ") + std::string(choice);
  throw UsageError("not a choice (\"" + word + "\" for " + option + ") - there are " + choices);
}

}  // namespace vex
