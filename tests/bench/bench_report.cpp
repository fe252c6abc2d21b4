#include "tests/bench/bench_report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "engine/numeric/instruction_set.h"
#include "tests/bench/best_peers.h"

namespace vex {
namespace {

#ifdef __OPTIMIZE__
constexpr bool kOptimised = true;
#else
constexpr bool kOptimised = false;
#endif

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

MarkdownTable::MarkdownTable(const std::vector<std::string>& heads) {
  text_ = line_of(heads) + "|---|";
  for (std::size_t k = 1; k < heads.size(); ++k) text_ += "---:|";
  text_ += "\n";
}

void MarkdownTable::add(const std::vector<std::string>& cells) { text_ += line_of(cells); }

std::string grouped(std::uint64_t n) {
  std::string text = std::to_string(n);
  if (text.size() <= 4) return text;
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, " ");
  return text;
}

std::string three_digits(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return "-";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(value))), 0, 12);
  return fixed_number(decimals, value);
}

std::string percent(double share) {
  const double value = 100.0 * share;
  return (value == 0.0 || value >= 9.95 ? fixed_number(0, value) : short_number(value, 2)) + " %";
}

nlohmann::ordered_json machine_json() {
  std::vector<std::string> sets;
  for (const InstructionSet set : instruction_sets()) sets.emplace_back(name_of(set));
  return {{"processor", processor()},
          {"compiler", compiler()},
          {"optimised", kOptimised},
          {"instruction_sets", sets},
          {"fcl", fcl_version().empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(fcl_version())}};
}

std::string machine_line() {
  std::string sets;
  for (const InstructionSet set : instruction_sets()) sets += (sets.empty() ? "" : ", ") + std::string(name_of(set));
  return processor() + "; " + compiler() + (kOptimised ? "" : ", NOT OPTIMISED") + "; " + sets;
}

}  // namespace vex
