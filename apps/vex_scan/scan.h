// The cases of a scan: every pair of bodies with every combination of the variables' values, each as the command line
// that vex_mesh would be given.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/vex_mesh/options.h"

namespace vex {

/// The words of the command line, as they stand: those of a run, of which `a`, `b` and `json` belong to no case.
struct ScanCommandLine : CommandLine {
  std::vector<std::string> bodies, ranges;
  std::string angle, with, csv, jsonl, plot;
  bool pairs = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, ScanCommandLine& words);

struct ScanVariable {
  std::string name;
  std::vector<std::string> values;  // decimals
};

/// Of --angle.
inline constexpr const char* kAngle = "angle";

/// The columns that every row has besides the variables.
const std::vector<std::string>& columns_of_results();

struct Scan {
  ScanCommandLine words;
  std::vector<ScanVariable> variables;                     // the last one changes from case to case
  std::vector<std::pair<std::string, std::string>> pairs;  // texts, not filled yet; the second empty: the first again
  std::uint64_t seed = 1;

  std::size_t n_cases() const;
};

struct ScanCase {
  std::vector<std::string> values;  // of the variables
  CommandLine words;                // filled
  std::uint64_t seed = 0;

  const std::string& a() const { return words.a; }
  const std::string& b() const { return words.b.empty() ? words.a : words.b; }
};

/// Throws UsageError where the words of the scan itself mean nothing. Those of single cases are not looked at.
Scan interpret(const ScanCommandLine& words);

ScanCase case_of(const Scan& scan, std::size_t index);

/// What the case's words mean, its own seed among them. Throws UsageError where they mean nothing.
Options options_of(const ScanCase& one);

/// The same whatever other cases there are: it follows from the scan's seed and the case's bodies, law and values
/// alone. Below 2^53, so that every reader of JSON gives it back.
std::uint64_t seed_of_case(std::uint64_t seed, const Scan& scan, const ScanCase& one);

}  // namespace vex
