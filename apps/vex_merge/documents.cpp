#include "apps/vex_merge/documents.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/run_state_text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kAdvice = "give what vex_mesh wrote with --json";

[[noreturn]] void refuse(const std::string& problem, const std::string& file, const std::string& advice) {
  throw InputError(problem + " (" + printable(file) + ") - " + advice);
}

struct Range {
  std::string file;
  RunState state;
};

std::string content_of(const std::string& path) {
  constexpr std::size_t kMost = std::size_t{1} << 28;
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  // A piece at a time: of a file without an end no more than is refused is read.
  for (std::string piece(1 << 20, '\0');
       file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0;) {
    text.append(piece, 0, static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMost) refuse("a file is too large for a document", path, kAdvice);
  }
  if (!file.is_open() || file.bad() || text.empty()) {
    refuse("a document cannot be read", path + ": " + (errno != 0 ? std::strerror(errno) : "it is empty"), kAdvice);
  }
  return text;
}

Json document_of(const std::string& path) {
  Json document = Json::parse(content_of(path), nullptr, false);
  if (document.is_discarded()) refuse("a document is no JSON, or cut off", path, kAdvice);
  if (!document.is_object() || !document.contains("estimate") || !document["estimate"].is_object()) {
    refuse("a document is not of vex_mesh", path, kAdvice);
  }
  if (!document.contains("tally")) {
    refuse("a document has no tally: nothing was sampled, or by a version of vex before --first-trial", path, kAdvice);
  }
  return document;
}

RunState state_of(const Json& tally, const std::string& path) {
  std::string text;
  for (const Json& line : tally.at("state")) text += line.get<std::string>() + "\n";
  RunState state;
  try {
    state = read_run_state(text);
  } catch (const InputError& error) {
    throw InputError(printable(path) + ", tally: " + error.what());
  }
  if (state.done.tally.n_trials == 0 || tally.at("first_trial") != state.first_trial ||
      tally.at("trials") != state.done.tally.n_trials) {
    refuse("a document's tally has other trials than it says", path, "it is damaged");
  }
  return state;
}

// Trials of a run that an error or a time ended are no range: one run would have ended elsewhere.
void require_ended_by_trials(const Json& document, const RunState& state, const std::string& path) {
  const std::string stopped_by = document.at("estimate").at("stopped_by").get<std::string>();
  if (document.at("estimate").at("trials") != state.done.tally.n_trials) {
    refuse("a document's estimate is of other trials than its tally", path, "it is damaged");
  }
  if (stopped_by == "trials" && document.at("complete") == true) return;
  refuse("a document of a run that was ended by \"" + printable(stopped_by) + "\" before trial " +
             std::to_string(state.end()),
         path, "only ranges that --trials ended are added: finish an interrupted one with --resume");
}

// Of a document's entries those that all ranges have in common, besides what `of` says in more detail.
void require_same_run(const MergedTrials& first, const Json& document, const std::string& path_of_first,
                      const std::string& path) {
  const std::vector<std::string> of = document.at("tally").at("of").get<std::vector<std::string>>();
  for (std::size_t k = 0; k < std::max(of.size(), first.of.size()); ++k) {
    const std::string mine = k < of.size() ? of[k] : "nothing more",
                      its = k < first.of.size() ? first.of[k] : "nothing more";
    if (mine != its) {
      throw InputError("documents of unlike runs (" + printable(path) + " has \"" + printable(mine) + "\", and " +
                       printable(path_of_first) + " \"" + printable(its) + "\") - give those of one run");
    }
  }
  for (const char* const key : {"estimator", "sequence", "backend", "orientations", "domain", "quick_verdicts"}) {
    if (document.at("estimate").at(key) == first.first.at("estimate").at(key)) continue;
    throw InputError("documents of unlike runs (" + printable(path) + " has another " + key + " than " +
                     printable(path_of_first) + ") - give those of one run");
  }
}

std::string trials_text(std::uint64_t begin, std::uint64_t end) {
  return end - begin == 1 ? "trial " + std::to_string(begin)
                          : "trials " + std::to_string(begin) + " ... " + std::to_string(end - 1);
}

void require_every_trial_once(const std::vector<Range>& ranges, const MergeOptions& options) {
  std::string missing;
  const auto miss = [&missing](std::uint64_t begin, std::uint64_t end) {
    missing += (missing.empty() ? "" : ", ") + trials_text(begin, end);
  };
  std::uint64_t end = options.is_part ? ranges.front().state.first_trial : 0;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const RunState& state = ranges[k].state;
    if (state.first_trial < end) {
      throw InputError(trials_text(state.first_trial, std::min(end, state.end())) + " are in two documents (" +
                       printable(ranges[k - 1].file) + " and " + printable(ranges[k].file) +
                       ") - give each trial once");
    }
    if (state.first_trial > end) miss(end, state.first_trial);
    end = state.end();
  }
  const std::uint64_t begin = options.is_part ? ranges.front().state.first_trial : 0;
  if (options.trials && end - begin < *options.trials) miss(end, begin + *options.trials);
  if (!missing.empty()) {
    throw InputError("trials are in no document (" + missing + ") - " +
                     (missing.find(',') == std::string::npos && ranges.front().state.first_trial > 0 && !options.trials
                          ? "add their documents, or give --part for a result that begins behind trial 0"
                          : "add their documents"));
  }
  if (options.trials && end - begin > *options.trials) {
    throw InputError("more trials than asked for (" + std::to_string(end - begin) + ", and --trials " +
                     std::to_string(*options.trials) + ") - leave out the others' documents");
  }
}

}  // namespace

MergedTrials merge_documents(const MergeOptions& options) {
  MergedTrials merged;
  std::vector<Range> ranges;
  for (const std::string& path : options.files) {
    try {
      Json document = document_of(path);
      ranges.push_back({path, state_of(document.at("tally"), path)});
      const RunState& state = ranges.back().state;
      require_ended_by_trials(document, state, path);
      if (ranges.size() == 1) {
        merged.of = document.at("tally").at("of").get<std::vector<std::string>>();
      } else {
        require_same_run(merged, document, ranges.front().file, path);
      }
      if (ranges.size() == 1 || state.first_trial < merged.first.at("tally").at("first_trial").get<std::uint64_t>()) {
        merged.first = std::move(document);
      }
    } catch (const Json::exception& error) {
      refuse("a document lacks what vex_mesh writes", path + ": " + error.what(), kAdvice);
    }
  }
  std::ranges::sort(ranges, {}, [](const Range& range) { return range.state.first_trial; });
  require_every_trial_once(ranges, options);
  merged.state = std::move(ranges.front().state);
  for (std::size_t k = 1; k < ranges.size(); ++k) merged.state.append(std::move(ranges[k].state));
  return merged;
}

}  // namespace vex
