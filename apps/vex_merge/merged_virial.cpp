#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/vex_merge/documents.h"
#include "apps/vex_virial/report.h"

namespace vex {
namespace {

using VirialJson = nlohmann::ordered_json;

double number_of(const VirialJson& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

RunRecord whole_record(RunState&& state) {
  RunRecord record;
  record.first_trial = state.first_trial;
  record.seconds = state.seconds;
  record.stopped_by = StopReason::trials;
  record.complete = true;
  static_cast<BlockRecord&>(record) = std::move(state.done);
  return record;
}

// B3 may be of single triangles, of which each is a sample.
std::uint64_t driver_trials_of_one(const VirialJson& entry) {
  const bool is_of_triangles = entry.at("samples") == entry.at("tally").at("trials");
  return is_of_triangles ? VirialCoefficient::kTrianglesOfBunch : 1;
}

// Which of the coefficients it is, in a message.
std::string name_of_entry(const VirialJson& entry, bool is_mixture) {
  return is_mixture ? " of B_" + entry.at("bodies").get<std::string>()
                    : " of B" + std::to_string(entry.at("n").get<int>());
}

}  // namespace

MergedReport merged_virial(const std::vector<Document>& documents, const MergeOptions& options) {
  const bool is_mixture = documents.front().json.contains("mixture");
  const char* const list = is_mixture ? "mixture" : "coefficients";
  const std::size_t n_entries = documents.front().json.at(list).size();
  if (n_entries == 0) refuse_document("a document without coefficients", documents.front().file, kDocumentAdvice);
  std::vector<MergedTally> merged;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;  // of what users call trials
  for (std::size_t k = 0; k < n_entries; ++k) {
    const std::string name = name_of_entry(documents.front().json.at(list).at(k), is_mixture);
    const std::uint64_t of_one = driver_trials_of_one(documents.front().json.at(list).at(k));
    std::vector<TallyOfFile> tallies;
    for (const Document& one : documents) {
      if (!one.json.contains(list) || one.json.at(list).size() != n_entries) {
        refuse_document("a document of other coefficients than " + documents.front().file + " has", one.file,
                        "give those of one run");
      }
      const VirialJson& entry = one.json.at(list).at(k);
      const VirialJson& tally = entry.at("tally");
      require_ended_by_trials(
          entry.at("complete") == true, entry.at("stopped_by").get<std::string>(),
          (tally.at("first_trial").get<std::uint64_t>() + tally.at("trials").get<std::uint64_t>()) / of_one, one.file);
      tallies.emplace_back(one.file, &tally);
    }
    merged.push_back(merge_tallies(tallies, options, name, of_one));
    ranges.push_back({merged.back().state.first_trial / of_one, merged.back().state.end() / of_one});
    // One document is the first of all coefficients: all have the same ranges.
    if (ranges.back() != ranges.front() || merged.back().first != merged.front().first) {
      refuse_document("a document of other trials" + name + " than of the first coefficient", documents.front().file,
                      "it is damaged");
    }
  }
  MergedReport all{documents[merged.front().first].json, {}};
  VirialJson& document = all.document;
  VirialCoefficients found;
  double seconds = 0.0;
  std::string lines;
  if (!is_mixture) {
    found.b2 = number_of(document.at("b2"));
    found.b2_std_error = number_of(document.at("b2_std_error"));
    found.b2_per_volume = number_of(document.at("b2_per_volume"));
  }
  const auto [first, end] = ranges.front();
  for (std::size_t k = 0; k < n_entries; ++k) {
    VirialJson& entry = document.at(list).at(k);
    RunRecord record = whole_record(std::move(merged[k].state));
    seconds += record.seconds;
    if (is_mixture) {
      MixedVirial one;
      one.name = entry.at("bodies").get<std::string>();
      one.b2_product = number_of(entry.at("b2_product"));
      one.b2_relative_error = number_of(entry.at("b2_relative_error"));
      one.record = std::move(record);
      one.conclude();
      lines += "   B_" + one.name + " " + with_error(one.value, one.std_error) + "\n";
      entry = mixed_json(one, merged[k].of);
    } else {
      VirialCoefficient one;
      one.n = entry.at("n").get<int>();
      if (one.n < 3 || one.n > 8)
        refuse_document("a coefficient that is none", documents.front().file, "it is damaged");
      one.record = std::move(record);
      one.conclude(found.b2_per_volume, found.b2_relative_error());
      lines += "   B" + std::to_string(one.n) + "/B2^" + std::to_string(one.n - 1) + " " +
               with_error(one.reduced, one.std_error) + "\n";
      entry = coefficient_json(one, merged[k].of);
      found.higher.push_back(std::move(one));
    }
  }
  document["seconds"] = seconds;
  if (!is_mixture) {
    for (VirialJson& row : document.at("compressibility")) {
      row["series"] = number_or_null(found.compressibility_factor(row.at("phi").get<double>()));
    }
  }
  all.text = "trials " + std::to_string(first) + " ... " + std::to_string(end - 1) + " of each coefficient\n" + lines +
             "   time " + short_number(seconds, 3) + " s, of all runs\n";
  return all;
}

}  // namespace vex
