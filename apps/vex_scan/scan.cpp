#include "apps/vex_scan/scan.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/common/case_seed.h"
#include "apps/common/number_range.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// Of JSON lines, besides the columns.
constexpr const char* kMoreKeys[] = {
    "input",     "seed",   "orientations", "order_parameter", "reference_kind", "reference_error",
    "estimator", "trials", "complete",     "disagreements",   "unproven"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name(std::string_view text) {
  return !text.empty() && is_letter(text[0]) &&
         std::ranges::all_of(text, [](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

ScanVariable variable_of(const std::string& word, const std::vector<ScanVariable>& others) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  if (equals == std::string::npos || !is_name(name)) {
    throw UsageError("not a variable with its range (\"" + word +
                     "\" for --for) - write NAME=FROM:TO:STEP, as in L=1:20:1, the name of letters and digits");
  }
  const std::vector<std::string>& columns = columns_of_results();
  if (name == kAngle || std::ranges::find(columns, name) != columns.end() ||
      std::ranges::find(kMoreKeys, name) != std::end(kMoreKeys)) {
    throw UsageError("a variable with the name of a column (" + name + " for --for) - choose another name");
  }
  for (const ScanVariable& other : others) {
    if (other.name == name) throw UsageError("a variable is given twice (" + name + " for --for) - give it once");
  }
  return {name, numbers_of_range(word.substr(equals + 1), "--for")};
}

/// The next {NAME} from `at` on; other braces are letters.
struct Placeholder {
  std::size_t begin, size;
  std::string name;
};
std::optional<Placeholder> next_placeholder(const std::string& text, std::size_t at) {
  for (; (at = text.find('{', at)) != std::string::npos; ++at) {
    const std::size_t end = text.find('}', at);
    if (end == std::string::npos) return std::nullopt;
    const std::string name = text.substr(at + 1, end - at - 1);
    if (is_name(name)) return Placeholder{at, end + 1 - at, name};
  }
  return std::nullopt;
}

/// A file of this very name is that file.
bool is_literal(const std::string& text) {
  std::error_code error;
  return text.find('{') == std::string::npos || std::filesystem::exists(text, error);
}

void fill(std::string& text, const std::vector<ScanVariable>& variables, const std::vector<std::string>& values) {
  if (is_literal(text)) return;
  std::size_t at = 0;
  while (const std::optional<Placeholder> found = next_placeholder(text, at)) {
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (variables[k].name != found->name) continue;
      text.replace(found->begin, found->size, values[k]);
      at = found->begin + values[k].size();
    }
  }
}

/// Every variable fills something, and everything that is to be filled has a variable.
void require_placeholders_that_meet(const Scan& scan) {
  std::vector<bool> is_used(scan.variables.size(), false);
  const auto look_at = [&](const std::string& text) {
    if (is_literal(text)) return;
    std::size_t at = 0;
    while (const std::optional<Placeholder> found = next_placeholder(text, at)) {
      at = found->begin + found->size;
      bool is_known = false;
      for (std::size_t k = 0; k < scan.variables.size(); ++k) {
        if (scan.variables[k].name != found->name) continue;
        is_used[k] = is_known = true;
      }
      if (!is_known) {
        throw UsageError("no --for gives its values ({" + found->name + "} in " + text + ") - add --for " +
                         found->name + "=FROM:TO:STEP");
      }
    }
  };
  for (const auto& [a, b] : scan.pairs) {
    look_at(a);
    look_at(b);
  }
  CommandLine words = scan.words;
  for (const std::string* const word : words_of_run(words)) look_at(*word);
  for (std::size_t k = 0; k < scan.variables.size(); ++k) {
    const std::string& name = scan.variables[k].name;
    if (is_used[k] || name == kAngle) continue;
    throw UsageError("a variable that fills nothing (" + name + " for --for) - write {" + name +
                     "} in a body or in an option");
  }
}

ScanVariable angle_of(const ScanCommandLine& words) {
  if (!words.orientations.empty()) {
    throw UsageError("--angle is a law of orientations itself (--orientations " + words.orientations +
                     ") - leave out one of them");
  }
  for (const auto& [word, option] :
       {std::pair{&words.orientations_a, "--orientations-a"}, std::pair{&words.orientations_b, "--orientations-b"}}) {
    if (word->empty()) continue;
    throw UsageError("--angle is a law of orientations itself (" + std::string(option) + " " + *word +
                     ") - leave out one of them");
  }
  ScanVariable angle{kAngle, numbers_of_range(words.angle, "--angle")};
  for (const std::string* const end : {&angle.values.front(), &angle.values.back()}) {
    const double degrees = parse_number(*end, "--angle");
    if (degrees >= 0.0 && degrees <= 180.0) continue;
    throw UsageError("not an angle between two axes (" + *end + " of \"" + words.angle +
                     "\" for --angle) - give degrees from 0 to 180");
  }
  return angle;
}

std::vector<std::pair<std::string, std::string>> pairs_of(const ScanCommandLine& words) {
  const std::vector<std::string>& bodies = words.bodies;
  if (bodies.empty()) throw UsageError("no body is given - name one, like box:1,1,1");
  if (words.pairs && !words.with.empty()) {
    throw UsageError("all pairs, and each with one body (--pairs, --with " + words.with + ") - leave out one of them");
  }
  if (words.pairs && bodies.size() > kMostCases) throw UsageError("too many bodies (--pairs) - give fewer");
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    pairs.emplace_back(bodies[i], words.with);
    if (!words.pairs) continue;
    for (std::size_t j = i + 1; j < bodies.size(); ++j) pairs.emplace_back(bodies[i], bodies[j]);
    if (pairs.size() > kMostCases) throw UsageError("too many pairs (--pairs) - give fewer bodies");
  }
  return pairs;
}

void require_no_standard_input(const Scan& scan) {
  std::vector<std::string> texts = scan.words.bodies;
  texts.push_back(scan.words.with);
  texts.insert(texts.end(), scan.words.control_variate.begin(), scan.words.control_variate.end());
  for (const std::string& text : texts) {
    if (text != "-" && !(text.starts_with("rounded:") && text.ends_with(",-"))) continue;
    throw UsageError("standard input can be read only once (" + text + ") - give a file");
  }
}

}  // namespace

const std::vector<std::string>& columns_of_results() {
  static const std::vector<std::string> columns = {"a", "b",  "excluded_volume", "std_error", "reference",
                                                   "z", "b2", "reduced",         "seconds",   "error"};
  return columns;
}

std::size_t Scan::n_cases() const {
  std::size_t n = pairs.size();
  for (const ScanVariable& variable : variables) {
    n *= variable.values.size();
    if (n > kMostCases) return n;
  }
  return n;
}

Scan interpret(const ScanCommandLine& words) {
  Scan scan;
  scan.words = words;
  if (!words.seed.empty()) scan.seed = parse_count(words.seed, "--seed");
  if (words.dump_vertices) throw UsageError("a scan lists no vertices (--dump-vertices) - ask vex_mesh for them");
  for (const std::string& range : words.ranges) scan.variables.push_back(variable_of(range, scan.variables));
  if (!words.angle.empty()) scan.variables.push_back(angle_of(words));
  scan.pairs = pairs_of(words);
  require_no_standard_input(scan);
  require_placeholders_that_meet(scan);
  if (scan.n_cases() > kMostCases) {
    throw UsageError("too many cases (more than " + std::to_string(kMostCases) +
                     ") - give wider steps or fewer bodies");
  }
  return scan;
}

ScanCase case_of(const Scan& scan, std::size_t index) {
  ScanCase one;
  one.words = scan.words;
  one.values.resize(scan.variables.size());
  for (std::size_t k = scan.variables.size(); k-- > 0;) {
    const std::vector<std::string>& values = scan.variables[k].values;
    one.values[k] = values[index % values.size()];
    index /= values.size();
    if (scan.variables[k].name == kAngle) one.words.orientations = "angle:" + one.values[k];
  }
  std::tie(one.words.a, one.words.b) = scan.pairs[index];
  fill(one.words.a, scan.variables, one.values);
  fill(one.words.b, scan.variables, one.values);
  if (one.words.b == one.words.a) one.words.b.clear();
  for (std::string* const word : words_of_run(one.words)) fill(*word, scan.variables, one.values);
  // --unit and --format are for the files among the bodies of a scan.
  if (!names_a_mesh(one.words.a) && (one.words.b.empty() || !names_a_mesh(one.words.b)) &&
      std::ranges::any_of(scan.words.bodies, names_a_mesh)) {
    one.words.unit.clear();
    one.words.format.clear();
  }
  one.seed = seed_of_case(scan.seed, scan, one);
  return one;
}

Options options_of(const ScanCase& one) {
  Options options = interpret(one.words);
  options.seed = options.settings.seed = one.seed;
  return options;
}

std::uint64_t seed_of_case(std::uint64_t seed, const Scan& scan, const ScanCase& one) {
  std::string text = one.words.a + "\n" + one.b() + "\n" + one.words.orientations + "\n";
  for (std::size_t k = 0; k < scan.variables.size(); ++k) text += scan.variables[k].name + "=" + one.values[k] + "\n";
  CommandLine words = one.words;
  for (const std::string* const word : words_of_bodies_laws(words)) text += word->empty() ? "" : *word + "\n";
  return seed_of_text(seed, text);
}

}  // namespace vex
