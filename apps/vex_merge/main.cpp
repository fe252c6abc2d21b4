// vex_merge FILES...: one result from runs of vex_mesh that made ranges of its trials.
#include <cmath>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/vex_merge/merged_document.h"

namespace vex {
namespace {

std::string report_text(const MergedTrials& merged, const MergedResult& all, const MergeOptions& options) {
  const ExcludedVolume& result = all.result;
  const Tally& tally = result.record.tally;
  std::string text = std::to_string(options.files.size()) + (options.files.size() == 1 ? " document" : " documents") +
                     ", trials " + std::to_string(merged.state.first_trial) + " ... " +
                     std::to_string(merged.state.end() - 1) + ", " + std::string(result.estimator->name) + "\n";
  text += "   <V_ex>, Monte Carlo               " + with_error(result.value, result.std_error) + "\n";
  if (result.estimator->samples_poses) {
    text += "   hits / trials                     " + std::to_string(tally.n_hits) + " / " +
            std::to_string(tally.n_trials) + "\n";
  } else {
    text += "   values                            " + std::to_string(tally.n_trials) + "\n";
  }
  if (tally.n_undecided > 0) text += "   undecided                         " + std::to_string(tally.n_undecided) + "\n";
  text += "   time                              " + short_number(result.record.seconds, 3) + " s, of all runs\n";
  if (!result.z) return text + "z: none - " + result.z_reason + "\n";
  return text + "z = " + short_number(*result.z, 3) + " standard errors between Monte Carlo and " +
         (result.reference->kind == Reference::Kind::formula ? "formula" : "exact average") +
         (std::fabs(*result.z) > options.max_z ? ": THEY DISAGREE" : ": they agree") + "\n";
}

int run_vex_merge(const MergeCommandLine& words, const std::string& command) {
  const MergeOptions options = interpret(words);
  CommandFiles files(options.files);
  const std::optional<OutputFile> json = files.output("--json", options.json);
  if (!options.quiet) files.print_report();
  const MergedTrials merged = merge_documents(options);
  const MergedResult all = merged_result(merged, command);
  Results results("vex_merge");
  if (!options.quiet && !files.own_standard_output()) results.print(report_text(merged, all, options));
  results.write(json, Results::Kind::numbers, [&] { return document_text(all.document); });
  const bool disagrees = all.result.z && std::fabs(*all.result.z) > options.max_z;
  return results.exit_code(disagrees ? kDisagreement : kSuccess);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "One result from JSON documents of vex_mesh for disjoint ranges of trials: exactly that of one run.",
      "vex_merge");
  vex::MergeCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_merge(words, vex::command_line(argc, argv)); });
}
