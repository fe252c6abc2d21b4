#include "apps/vex_stress/options.h"

#include <algorithm>

#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "apps/peers/peers.h"
#include "apps/referees/specialised_backend.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// The random numbers of a stratum are kept apart from those of the next one by the upper bits of their index.
constexpr std::uint64_t kMostPairs = 16'000'000;

// The engine's own is always there, and first.
std::vector<BackendKind> backends_named(const std::vector<std::string>& names) {
  std::vector<BackendKind> all = all_backends();
  all.push_back(specialised_backend());
  if (names.empty()) return all;
  for (const std::string& name : names) {
    if (std::ranges::any_of(all, [&name](const BackendKind& kind) { return kind.name == name; })) continue;
    for (const PeerName& peer : kPeerNames) {
      if (name == peer.name) {
        throw UsageError("a backend that this build leaves out (\"" + name + "\" for --backend) - build with " +
                         std::string(peer.build_option));
      }
    }
    std::string known;
    for (const BackendKind& kind : all) known += (known.empty() ? "" : ", ") + kind.name;
    throw UsageError("no such backend (\"" + name + "\" for --backend) - there are " + known);
  }
  std::erase_if(all, [&names](const BackendKind& kind) {
    return kind.name != "gjk" && std::ranges::find(names, kind.name) == names.end();
  });
  return all;
}

std::vector<Stratum> strata_named(const std::vector<std::string>& prefixes) {
  std::vector<Stratum> all = all_strata();
  if (prefixes.empty()) return all;
  const auto begins = [](const Stratum& stratum, const std::string& prefix) {
    return !prefix.empty() && stratum.name.rfind(prefix, 0) == 0;
  };
  for (const std::string& prefix : prefixes) {
    if (std::ranges::none_of(all, [&](const Stratum& stratum) { return begins(stratum, prefix); })) {
      throw UsageError("no such stratum (\"" + prefix + "\" for --stratum) - vex_stress --list names them");
    }
  }
  std::erase_if(all, [&](const Stratum& stratum) {
    return std::ranges::none_of(prefixes, [&](const std::string& prefix) { return begins(stratum, prefix); });
  });
  return all;
}

}  // namespace

void declare_options(OptionParser& options, StressCommandLine& words) {
  const std::string strata = "Strata";
  options.add_option("--stratum", words.strata, "Only strata whose names begin so; may be given several times")
      .type_name("NAME")
      .group(strata);
  options
      .add_option("--backend", words.backends,
                  "Only this one beside the engine's own: ccd-gjk, ccd-mpr, fcl, specialised, or gjk for the engine "
                  "alone; may be given several times (default: all that this build has)")
      .type_name("NAME")
      .group(strata);
  options.add_option("--pairs", words.pairs, "Poses of every stratum, written like 1e4 (default 1000)")
      .type_name("N")
      .group(strata);
  options.add_flag("--list", words.list, "Name the strata and stop").group(strata);
  declare_seed_and_threads(options, words, "Sampling");
  const std::string output = "Output";
  options
      .add_option("--json", words.json,
                  "Write one JSON document; - is standard output, where then nothing else is printed")
      .type_name("FILE")
      .group(output);
  options.add_option("--plot", words.plot, "Draw the shares of wrong and undecided answers (SVG)")
      .type_name("FILE")
      .group(output);
  options.add_flag("--quiet", words.quiet, "Print no report and draw no progress bar").group(output);

  options.footer(
      "Every pose is judged by a referee in exact arithmetic, which uses nothing of the engine's queries.\n\n"
      "Exit codes:"
      "\n  0  success: no answer of the engine is wrong, unproven, given up, or undecided where it must not be"
      "\n  1  one is, or a fault of the program"
      "\n  2  wrong usage"
      "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (what was done is reported)");
}

StressOptions interpret(const StressCommandLine& words) {
  StressOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.pairs = words.pairs.empty() ? 1000 : parse_positive_count(words.pairs, "--pairs");
  if (options.pairs > kMostPairs) {
    throw UsageError("too many pairs (" + words.pairs + " for --pairs) - at most " + short_count(kMostPairs) +
                     " a stratum");
  }
  options.plot = words.plot;
  if (words.list && !(words.json.empty() && words.plot.empty())) {
    throw UsageError("nothing to write to --json or --plot - --list names the strata and measures nothing");
  }
  options.list = words.list;
  options.strata = strata_named(words.strata);
  options.backends = backends_named(words.backends);
  return options;
}

}  // namespace vex
