// What every mode of vex_trial_bench is told, and what it hands back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vex {

struct BenchSettings {
  std::uint64_t seed = 1;
  int n_rounds = 11;
  double least_turn_ms = 25.0;
  std::optional<std::size_t> n_poses;  // of each pair; none: as many as the mode has time for
  std::size_t most_vertices = 1'000'000;
  std::size_t most_peer_vertices = 1'000'000;
  int n_threads = 2;
};

struct BenchReport {
  std::string markdown;  // for docs/performance.md
  nlohmann::ordered_json rows;
  std::string picture{};  // SVG, of the mode that draws
};

/// A table of Markdown, the first column flush left.
class MarkdownTable {
 public:
  explicit MarkdownTable(const std::vector<std::string>& heads);
  void add(const std::vector<std::string>& cells);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// 131 072.
std::string grouped(std::uint64_t n);
/// Three significant digits, without an exponent.
std::string three_digits(double value);
std::string percent(double share);

/// processor, compiler, optimised, instruction_sets, with what else the machine and the build have to say.
nlohmann::ordered_json machine_json();
/// The same as a line.
std::string machine_line();

}  // namespace vex
