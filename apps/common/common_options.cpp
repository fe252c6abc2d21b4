#include "apps/common/common_options.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {

void declare_seed_and_threads(OptionParser& options, CommonWords& words, const std::string& group) {
  options.add_option("--seed", words.seed, "The same seed gives the same result on any number of threads (default 1)")
      .type_name("N")
      .group(group);
  options.add_option("--threads", words.threads, "Threads (default: all cores)").type_name("N").group(group);
}

void declare_json_and_quiet(OptionParser& options, CommonWords& words, const std::string& quiet) {
  const std::string output = "Output";
  options
      .add_option("--json", words.json,
                  "Write one JSON document; - is standard output, where then nothing else is printed")
      .type_name("FILE")
      .group(output);
  options.add_flag("--quiet", words.quiet, quiet).group(output);
}

void declare_output(OptionParser& options, CommonWords& words) {
  declare_json_and_quiet(options, words, "Print no report and draw no progress bar");
  options
      .add_option("--max-z", words.max_z,
                  "Exit with 4 where Monte Carlo and exact value differ by more standard errors (default 6)")
      .type_name("Z")
      .group("Output");
}

CommonOptions interpret_common(const CommonWords& words) {
  CommonOptions options;
  if (!words.seed.empty()) options.seed = parse_count(words.seed, "--seed");
  options.n_threads = parse_threads(words.threads);
  if (!words.max_z.empty()) options.max_z = parse_positive_number(words.max_z, "--max-z");
  options.json = words.json;
  options.quiet = words.quiet;
  return options;
}

nlohmann::ordered_json document_head(const std::string& command, const CommonOptions& options, bool complete,
                                     double seconds) {
  return {{"version", version()}, {"stream_version", kStreamVersion}, {"command", command},
          {"seed", options.seed}, {"threads", options.n_threads},     {"complete", complete},
          {"seconds", seconds}};
}

std::string document_text(const nlohmann::ordered_json& document) {
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return *value;
}

std::vector<double> twelve_numbers(const Transformd& pose) {
  return {pose.row_x.x, pose.row_x.y, pose.row_x.z, pose.row_y.x,       pose.row_y.y,       pose.row_y.z,
          pose.row_z.x, pose.row_z.y, pose.row_z.z, pose.translation.x, pose.translation.y, pose.translation.z};
}

}  // namespace vex
