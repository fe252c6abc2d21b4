// JSON documents of runs that made ranges of one run's trials, read and held against each other.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/vex_merge/options.h"
#include "engine/sampling/run_state.h"

namespace vex {

/// Which program wrote it.
enum class DocumentKind : std::uint8_t { estimate, virial, percolation };
std::string_view program_of(DocumentKind kind);

struct Document {
  std::string file;
  DocumentKind kind;
  nlohmann::ordered_json json;
};

inline constexpr const char* kDocumentAdvice = "give what vex_mesh, vex_virial or vex_percolate wrote with --json";
[[noreturn]] void refuse_document(const std::string& problem, const std::string& file, const std::string& advice);

/// Throws InputError where it cannot be read, is no JSON, or of none of these programs.
Document read_document(const std::string& path);

/// Trials begin ... end - 1 of a file.
struct TrialRange {
  std::string file;
  std::uint64_t begin, end;
};
/// Throws InputError where trials are in none of the ranges or in two, naming which, or are not as many as was asked.
/// `of`: " of B3", of which of several such runs they are.
void require_every_trial_once(std::vector<TrialRange> ranges, const MergeOptions& options, const std::string& of = "");

/// Throws InputError where what two documents are of differs, naming the first line that does.
void require_same_run(const std::vector<std::string>& of_first, const std::string& file_of_first,
                      const std::vector<std::string>& of, const std::string& file);
/// Trials of a run that an error or a time ended are no range: one run would have ended elsewhere.
void require_ended_by_trials(bool complete, const std::string& stopped_by, std::uint64_t end, const std::string& file);

/// All ranges of one run as one.
struct MergedTally {
  RunState state;
  std::size_t first = 0;        // the number of the tally that begins first
  std::vector<std::string> of;  // of which run they are
};
/// A file, and in its document the tally (tally_json, estimate_report.h).
using TallyOfFile = std::pair<std::string, const nlohmann::ordered_json*>;
/// Throws InputError where one is damaged, where two are of unlike runs, and as `require_every_trial_once`. What the
/// user calls a trial may be several of the driver's.
MergedTally merge_tallies(const std::vector<TallyOfFile>& tallies, const MergeOptions& options,
                          const std::string& name = "", std::uint64_t driver_trials_of_one = 1);

/// What is told of the whole.
struct MergedReport {
  nlohmann::ordered_json document;  // one run's, but for the command; seconds are the sum, threads those of the first
  std::string text;
  bool disagrees = false;  // with the formula
};
/// All of the kind. Throws InputError as above, and where a document lacks what its program writes.
MergedReport merged_estimate(const std::vector<Document>& documents, const MergeOptions& options);
MergedReport merged_virial(const std::vector<Document>& documents, const MergeOptions& options);
MergedReport merged_percolation(const std::vector<Document>& documents, const MergeOptions& options);

}  // namespace vex
