#include "apps/vex_merge/documents.h"

#include <algorithm>
#include <array>
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

std::string content_of(const std::string& path) {
  constexpr std::size_t kMost = std::size_t{1} << 28;
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  // A piece at a time: of a file without an end no more than is refused is read.
  for (std::array<char, 1 << 16> piece; file.read(piece.data(), piece.size()) || file.gcount() > 0;) {
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMost) refuse_document("a file is too large for a document", path, kDocumentAdvice);
  }
  if (!file.is_open() || file.bad() || text.empty()) {
    refuse_document("a document cannot be read", path + ": " + (errno != 0 ? std::strerror(errno) : "it is empty"),
                    kDocumentAdvice);
  }
  return text;
}

/// Sees, while a document is read, that it stays one of a few values beside its text: a value takes up to 84 bytes, and
/// a key of an object is compared with all before it. What vex writes has a value in some thirty characters.
class DocumentBounds {
 public:
  DocumentBounds(const std::string& path, std::size_t size) : path_(path), most_values_(kFewValues + size / 16) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& /*parsed*/) {
    using Event = Json::parse_event_t;
    constexpr int kDeepest = 64;
    constexpr std::size_t kMostKeys = 1000;
    if (depth > kDeepest) refuse("more than " + std::to_string(kDeepest) + " levels deep");
    if (++n_events_ > most_values_) refuse("more than " + std::to_string(most_values_) + " values in so short a text");
    if (event == Event::object_start) n_keys_.push_back(0);
    if (event == Event::object_end) n_keys_.pop_back();
    if (event == Event::key && ++n_keys_.back() > kMostKeys) {
      refuse("an object of more than " + std::to_string(kMostKeys) + " keys");
    }
    return true;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    refuse_document("a document is of no program of vex: it has " + what, path_, kDocumentAdvice);
  }

  static constexpr std::size_t kFewValues = std::size_t{1} << 20;
  const std::string& path_;
  const std::size_t most_values_;
  std::size_t n_events_ = 0;
  std::vector<std::size_t> n_keys_;  // of the objects that are open
};

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
    refuse_document("a document's tally has other trials than it says", path, "it is damaged");
  }
  return state;
}

std::string trials_text(std::uint64_t begin, std::uint64_t end) {
  return end - begin == 1 ? "trial " + std::to_string(begin)
                          : "trials " + std::to_string(begin) + " ... " + std::to_string(end - 1);
}

}  // namespace

void refuse_document(const std::string& problem, const std::string& file, const std::string& advice) {
  throw InputError(problem + " (" + printable(file) + ") - " + advice);
}

std::string_view program_of(DocumentKind kind) {
  switch (kind) {
    case DocumentKind::estimate: return "vex_mesh";
    case DocumentKind::virial: return "vex_virial";
    case DocumentKind::percolation: return "vex_percolate";
  }
  return "";
}

Document read_document(const std::string& path) {
  const std::string text = content_of(path);
  Document document{path, DocumentKind::estimate, Json::parse(text, DocumentBounds(path, text.size()), false)};
  const Json& json = document.json;
  if (json.is_discarded()) refuse_document("a document is no JSON, or cut off", path, kDocumentAdvice);
  const auto has = [&json](const char* key) { return json.is_object() && json.contains(key); };
  if (has("estimate") && json["estimate"].is_object()) {
    if (!has("tally")) {
      refuse_document("a document has no tally: nothing was sampled, or by a version of vex before --first-trial", path,
                      kDocumentAdvice);
    }
  } else if (has("coefficients") || has("mixture")) {
    document.kind = DocumentKind::virial;
  } else if (has("eta_c")) {
    document.kind = DocumentKind::percolation;
    if (!has("tally")) {
      refuse_document("a document of vex_percolate without its realisations", path,
                      "run it with --first-realisation, 0 for the first part");
    }
  } else {
    refuse_document("a document is not of vex_mesh, vex_virial or vex_percolate", path, kDocumentAdvice);
  }
  return document;
}

void require_every_trial_once(std::vector<TrialRange> ranges, const MergeOptions& options, const std::string& of) {
  std::ranges::sort(ranges, {}, &TrialRange::begin);
  std::string missing;
  const auto miss = [&](std::uint64_t begin, std::uint64_t end) {
    missing += (missing.empty() ? "" : ", ") + trials_text(begin, end);
  };
  const std::uint64_t begin = options.is_part ? ranges.front().begin : 0;
  std::uint64_t end = begin;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const TrialRange& range = ranges[k];
    if (range.begin < end) {
      throw InputError(trials_text(range.begin, std::min(end, range.end)) + of + " are in two documents (" +
                       printable(ranges[k - 1].file) + " and " + printable(range.file) + ") - give each trial once");
    }
    if (range.begin > end) miss(end, range.begin);
    end = range.end;
  }
  if (options.trials && end - begin < *options.trials) miss(end, begin + *options.trials);
  if (!missing.empty()) {
    throw InputError("trials" + of + " are in no document (" + missing + ") - " +
                     (missing.find(',') == std::string::npos && ranges.front().begin > 0 && !options.trials
                          ? "add their documents, or give --part for a result that begins behind trial 0"
                          : "add their documents"));
  }
  if (options.trials && end - begin > *options.trials) {
    throw InputError("more trials" + of + " than asked for (" + std::to_string(end - begin) + ", and --trials " +
                     std::to_string(*options.trials) + ") - leave out the others' documents");
  }
}

void require_same_run(const std::vector<std::string>& of_first, const std::string& file_of_first,
                      const std::vector<std::string>& of, const std::string& file) {
  for (std::size_t k = 0; k < std::max(of.size(), of_first.size()); ++k) {
    const std::string mine = k < of.size() ? of[k] : "nothing more",
                      its = k < of_first.size() ? of_first[k] : "nothing more";
    if (mine == its) continue;
    throw InputError("documents of unlike runs (" + printable(file) + " has \"" + printable(mine) + "\", and " +
                     printable(file_of_first) + " \"" + printable(its) + "\") - give those of one run");
  }
}

void require_ended_by_trials(bool complete, const std::string& stopped_by, std::uint64_t end, const std::string& file) {
  if (stopped_by == "trials" && complete) return;
  refuse_document(
      "a document of a run that was ended by \"" + printable(stopped_by) + "\" before trial " + std::to_string(end),
      file, "only ranges that --trials ended are added: finish an interrupted one with --resume");
}

MergedTally merge_tallies(const std::vector<TallyOfFile>& tallies, const MergeOptions& options, const std::string& name,
                          std::uint64_t driver_trials_of_one) {
  struct Part {
    std::size_t number;
    RunState state;
  };
  std::vector<Part> parts;
  std::vector<TrialRange> ranges;
  MergedTally merged;
  for (const auto& [file, tally] : tallies) {
    const std::vector<std::string> of = tally->at("of").get<std::vector<std::string>>();
    parts.push_back({parts.size(), state_of(*tally, file)});
    const RunState& state = parts.back().state;
    ranges.push_back({file, state.first_trial / driver_trials_of_one, state.end() / driver_trials_of_one});
    if (parts.size() == 1) merged.of = of;
    require_same_run(merged.of, tallies.front().first, of, file);
  }
  require_every_trial_once(ranges, options, name);
  std::ranges::sort(parts, {}, [](const Part& part) { return part.state.first_trial; });
  merged.first = parts.front().number;
  merged.state = std::move(parts.front().state);
  for (std::size_t k = 1; k < parts.size(); ++k) merged.state.append(std::move(parts[k].state));
  return merged;
}

}  // namespace vex
