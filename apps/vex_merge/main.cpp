// vex_merge FILES...: one result from runs that made ranges of its trials.
#include <string>
#include <vector>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "apps/vex_merge/documents.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// A tally names its seed, too; the merged document takes over what stands beside the tally, so that has to agree as
// well.
void require_same_seed(const Document& first, const Document& other) {
  const auto seed_of = [](const Document& one) { return std::vector{"seed: " + one.json.at("seed").dump()}; };
  require_same_run(seed_of(first), first.file, seed_of(other), other.file);
}

MergedReport merge(const MergeOptions& options, const std::string& command) {
  std::vector<Document> documents;
  try {
    for (const std::string& path : options.files) {
      documents.push_back(read_document(path));
      if (documents.back().kind == documents.front().kind) {
        require_same_seed(documents.front(), documents.back());
        continue;
      }
      throw InputError("documents of unlike programs (" + printable(documents.front().file) + " is of " +
                       std::string(program_of(documents.front().kind)) + ", " + printable(path) + " of " +
                       std::string(program_of(documents.back().kind)) + ") - give those of one run");
    }
    const auto merged = [&] {
      switch (documents.front().kind) {
        case DocumentKind::virial: return merged_virial(documents, options);
        case DocumentKind::percolation: return merged_percolation(documents, options);
        case DocumentKind::estimate: break;
      }
      return merged_estimate(documents, options);
    };
    MergedReport all = merged();
    all.document["command"] = command;
    all.text = plural(documents.size(), "document", "documents") + ", " + all.text;
    return all;
  } catch (const nlohmann::json::exception& error) {
    throw InputError("a document lacks what its program writes (" + std::string(error.what()) + ") - " +
                     kDocumentAdvice);
  }
}

int run_vex_merge(const MergeCommandLine& words, const std::string& command) {
  const MergeOptions options = interpret(words);
  CommandFiles files(options.files);
  const std::optional<OutputFile> json = files.output("--json", options.json);
  if (!options.quiet) files.print_report();
  const MergedReport all = merge(options, command);
  Results results("vex_merge");
  if (!options.quiet && !files.own_standard_output()) results.print(all.text);
  results.write(json, Results::Kind::numbers, [&] { return document_text(all.document); });
  return results.exit_code(all.disagrees ? kDisagreement : kSuccess);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "One result from JSON documents of vex_mesh, vex_virial or vex_percolate for disjoint ranges of trials, or "
      "realisations: exactly that of one run.",
      "vex_merge");
  vex::MergeCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_merge(words, vex::command_line(argc, argv)); });
}
