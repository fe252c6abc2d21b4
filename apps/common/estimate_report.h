// What JSON says of an estimate as far as it follows from the trials: of one run, or of several put together.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "shapes/estimators/excluded_volume.h"

namespace vex {

inline constexpr DecidedBy kAllDecidedBy[] = {DecidedBy::outer_bound,   DecidedBy::inner_bound, DecidedBy::gjk,
                                              DecidedBy::double_double, DecidedBy::exact,       DecidedBy::peer};

/// In length^3, of hit or miss: of shells what lies between the balls.
double sampling_volume(const ExcludedVolume& result);

/// Sets in `estimate`: value and errors, counts, times, who decided.
void set_tallied(nlohmann::ordered_json& estimate, const ExcludedVolume& result);

/// Sets `z` in the document, and `z_reason` where there is none.
void set_comparison(nlohmann::ordered_json& document, const ExcludedVolume& result);

/// `tally`: which trials these are of which run (`of`), and all that they brought, in full (run_state_text.h): what
/// vex_merge adds.
nlohmann::ordered_json tally_json(const std::vector<std::string>& of, const ExcludedVolume& result);
nlohmann::ordered_json tally_json(const std::vector<std::string>& of, const RunState& state);

/// `names`: of the run's backend, then of those it was checked against.
nlohmann::ordered_json disagreements_json(const RunRecord& record, const std::vector<std::string>& names);

/// Why an incomplete run ended, for a line of a report; empty of a complete one.
std::string why_incomplete(StopReason reason);

nlohmann::ordered_json verification_json(const RunRecord& record);

}  // namespace vex
