// What vex_percolate says of a run: on the screen, as a document, and as pictures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/vex_percolate/percolate_run.h"

namespace vex {

/// What follows from the threshold, where it is known.
struct CriticalValues {
  Estimated number_density;
  std::optional<Estimated> eta, phi;  // none of flat bodies
  std::optional<Estimated> b;         // n <V_ex>; none where <V_ex> is not known
};
std::optional<CriticalValues> critical_values(const PercolateRun& run);

std::string report_text(const PercolateRun& run);

/// Sets what follows from the realisations; of a part of a run (PercolateOptions::is_part) these as well, which are of
/// what `of` says (system_lines).
void set_found(nlohmann::ordered_json& document, const PercolateRun& run, const std::vector<std::string>& of);
/// The document of --json.
std::string report_json(const PercolateRun& run);

/// The wrapping probability against eta, a curve a size and criterion, and the threshold.
std::string picture_of(const PercolateRun& run);

/// Where R by `x` of the smallest size, the widest curve, goes from one to the other end, of a run with a threshold:
/// eta, or the number density of flat bodies.
std::pair<double, double> plotted_range(const PercolateRun& run);

/// One page of HTML. `document_text`: what --json writes of the same run.
std::string html_report(const PercolateRun& run, const std::string& document_text);

/// The first realisation of the smallest size with so many bodies that a cluster wraps along some axis for the first
/// time; that cluster stands out.
std::string sample_gltf(const PercolateRun& run);

}  // namespace vex
