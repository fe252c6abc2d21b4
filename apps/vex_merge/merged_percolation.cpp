#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/numbers.h"
#include "apps/vex_merge/documents.h"
#include "apps/vex_percolate/realisations_file.h"
#include "apps/vex_percolate/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using PercolationJson = nlohmann::ordered_json;

// As much of the run as its thresholds hang on, without bodies and realisations.
PercolateRun run_of(const Document& one) {
  const PercolationJson& document = one.json;
  PercolateRun run;
  run.options.law = document.at("orientations").get<std::string>();
  run.options.is_part = true;
  run.is_isotropic = document.at("isotropic").get<bool>();
  run.mean_volume = document.at("mean_volume").get<double>();
  run.extent = document.at("size_unit").get<double>();
  if (document.at("excluded_volume").is_null()) {
    run.excluded_volume.reason = document.contains("excluded_volume_reason")
                                     ? document.at("excluded_volume_reason").get<std::string>()
                                     : "it is not in the documents";
  } else {
    run.excluded_volume.value = document.at("excluded_volume").get<double>();
    run.excluded_volume.std_error = document.at("excluded_volume_std_error").get<double>();
  }
  if (!(run.mean_volume >= 0.0 && run.extent > 0.0)) {
    refuse_document("a document of bodies without a size", one.file, "it is damaged");
  }
  return run;
}

// The realisations of a document.
PercolateRun part_of(const Document& document, const std::vector<std::string>& of) {
  const PercolationJson& tally = document.json.at("tally");
  PercolateRun part = run_of(document);
  const std::uint64_t first = tally.at("first_realisation").get<std::uint64_t>(),
                      n = tally.at("realisations").get<std::uint64_t>();
  if (first > kMostRealisations || n < 1 || n > kMostRealisations - first) {
    refuse_document("a document of realisations that are none", document.file, "it is damaged");
  }
  part.options.first_realisation = static_cast<std::uint32_t>(first);
  for (const PercolationJson& size : document.json.at("sizes")) {
    SizeRun one{size.at("size").get<double>(), size.at("box").get<double>(), {}, {}, {}};
    if (!(one.size > 0.0 && one.edge > 0.0)) {
      refuse_document("a document of cubes that are none", document.file, "it is damaged");
    }
    part.sizes.push_back(std::move(one));
  }
  if (part.sizes.empty()) refuse_document("a document without sizes", document.file, "it is damaged");
  const std::vector<std::string> lines = tally.at("state").get<std::vector<std::string>>();
  read_realisations(document.file + ", tally", lines, of, part);
  for (const SizeRun& size : part.sizes) {
    if (size.found.size() == n) continue;
    refuse_document("a document's sizes have other numbers of realisations than it says", document.file,
                    "it is damaged");
  }
  return part;
}

}  // namespace

MergedReport merged_percolation(const std::vector<Document>& documents, const MergeOptions& options) {
  std::vector<PercolateRun> parts;
  std::vector<TrialRange> ranges;
  const std::vector<std::string> of = documents.front().json.at("tally").at("of").get<std::vector<std::string>>();
  for (const Document& one : documents) {
    const PercolationJson& tally = one.json.at("tally");
    require_same_run(of, documents.front().file, tally.at("of").get<std::vector<std::string>>(), one.file);
    parts.push_back(part_of(one, of));
    const PercolateRun& part = parts.back();
    const std::uint64_t end = part.first_realisation() + part.sizes.front().found.size();
    require_ended_by_trials(one.json.at("complete") == true, one.json.at("complete") == true ? "trials" : "interrupted",
                            end, one.file);
    ranges.push_back({one.file, part.first_realisation(), end});
    for (std::size_t k = 0; k < part.sizes.size(); ++k) {
      if (part.sizes.size() == parts.front().sizes.size() && part.sizes[k].edge == parts.front().sizes[k].edge)
        continue;
      refuse_document("a document of other cubes than " + documents.front().file + " has", one.file,
                      "give those of one run");
    }
  }
  require_every_trial_once(ranges, options);
  std::vector<std::size_t> order(parts.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&parts](std::size_t k) { return parts[k].first_realisation(); });
  PercolateRun whole = std::move(parts[order.front()]);
  for (std::size_t k = 1; k < order.size(); ++k) {
    PercolateRun& next = parts[order[k]];
    for (std::size_t size = 0; size < whole.sizes.size(); ++size) {
      std::vector<WrappingNumbers>& found = whole.sizes[size].found;
      found.insert(found.end(), next.sizes[size].found.begin(), next.sizes[size].found.end());
      whole.sizes[size].counts += next.sizes[size].counts;
    }
    whole.seconds_before += next.seconds_before;
  }
  find_thresholds(whole);
  MergedReport all{documents[order.front()].json, {}};
  // The lines that realisations are of: this run has no bodies to say them.
  set_found(all.document, whole, of);
  all.document["seconds"] = whole.seconds_before;
  const std::uint64_t end = whole.first_realisation() + whole.sizes.front().found.size();
  all.text = "realisations " + std::to_string(whole.first_realisation()) + " ... " + std::to_string(end - 1) +
             " of each size\n";
  const std::optional<CriticalValues> values = critical_values(whole);
  if (!values) {
    all.text += "   the threshold is not known: " + whole.no_threshold_reason + "\n";
  } else if (values->eta) {
    all.text += "   eta_c " + with_error(values->eta->value, values->eta->std_error) + "\n";
  } else {
    all.text += "   n_c " + with_error(values->number_density.value, values->number_density.std_error) + "\n";
  }
  all.text += "   time " + short_number(whole.seconds_before, 3) + " s, of all runs\n";
  return all;
}

}  // namespace vex
