// Runs whose results were kept: hits, sums and errors of every estimator must stay what they were, to the last bit,
// whatever is changed in how they are computed. Where the draw is changed on purpose, stream_version is another one, and
// reference_runs.csv is made anew (its columns are the options of vex_mesh and what its --json says).
#include <gtest/gtest.h>

#include <charconv>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {
namespace {

struct Row {
  std::string a, b, law, estimator, sequence, seed, trials, excluded_volume, std_error, hits, undecided;
};

std::vector<Row> rows() {
  std::ifstream file(std::string(VEX_SOURCE_DIR) + "/tests/regression/reference_runs.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);  // the names of the columns
  while (std::getline(file, line)) {
    std::vector<std::string> words(1);
    for (const char c : line) {
      if (c == ';') {
        words.emplace_back();
      } else {
        words.back() += c;
      }
    }
    if (words.size() != 11) throw std::runtime_error("not a row: " + line);
    rows.push_back({words[0], words[1], words[2], words[3], words[4], words[5], words[6], words[7], words[8], words[9],
                    words[10]});
  }
  return rows;
}

template <class Number>
Number number(const std::string& text) {
  Number value{};
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || last != text.data() + text.size()) throw std::runtime_error("no number: " + text);
  return value;
}

OrientationLaw law_of(const std::string& text) {
  static const std::map<std::string, OrientationLaw> kLaws = {
      {"isotropic", OrientationLaw::isotropic()},
      {"aligned", OrientationLaw::aligned()},
      {"fixed:0.5,0.1,-0.2,0.7", OrientationLaw::fixed(0.5, 0.1, -0.2, 0.7)},
      {"cone:30", OrientationLaw::cone(30.0)},
      {"onsager:5", OrientationLaw::onsager(5.0)}};
  return kLaws.at(text);
}

/// A mesh of meshes/data or a named body, once each: what was asked of a body before changes nothing.
const Body& body_of(const std::string& text) {
  static std::map<std::string, Body> known;
  if (const auto found = known.find(text); found != known.end()) return found->second;
  const std::optional<RoundedText> round = parse_rounded(text);
  const std::string core(round ? round->body : std::string_view(text));
  const auto make = [&]() -> Body {
    if (!core.ends_with(".obj")) return parse_shape(text);
    const Body mesh = load(std::string(VEX_SOURCE_DIR) + "/meshes/data/" + core);
    return round ? rounded(mesh, round->radius, text) : mesh;
  };
  return known.emplace(text, make()).first->second;
}

TEST(ReferenceRuns, AreTheSameToTheLastBit) {
  const std::vector<Row> all = rows();
  ASSERT_GT(all.size(), 300U);
  int threads = 0;
  for (const Row& row : all) {
    SCOPED_TRACE(row.a + " " + row.b + " " + row.law + " " + row.estimator + " " + row.sequence);
    threads = threads % 3 + 1;
    const ExcludedVolume r =
        excluded_volume(body_of(row.a), body_of(row.b),
                        {.trials = number<std::uint64_t>(row.trials),
                         .law = law_of(row.law),
                         .estimator = row.estimator,
                         .sequence = row.sequence == "sobol" ? Sequence::sobol : Sequence::random,
                         .seed = number<std::uint64_t>(row.seed),
                         .threads = threads,
                         .exact_average = false});
    EXPECT_EQ(r.value, number<double>(row.excluded_volume));
    EXPECT_EQ(r.std_error, number<double>(row.std_error));
    EXPECT_EQ(r.record.tally.n_undecided, number<std::uint64_t>(row.undecided));
    EXPECT_EQ(row.hits.empty(), !r.estimator->samples_poses);
    if (!row.hits.empty()) {
      EXPECT_EQ(r.record.tally.n_hits, number<std::uint64_t>(row.hits));
    }
  }
}

}  // namespace
}  // namespace vex
