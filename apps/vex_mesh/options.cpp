#include "apps/vex_mesh/options.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "apps/common/choices.h"
#include "apps/common/numbers.h"
#include "apps/common/orientations.h"
#include "apps/common/run_program.h"
#include "apps/peers/peers.h"
#include "apps/referees/specialised_backend.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// The engine's own first, then the peers, and the tests made for one kind of pair.
std::vector<BackendKind> every_backend() {
  std::vector<BackendKind> kinds = all_backends();
  kinds.push_back(specialised_backend());
  return kinds;
}

// `ccd` means `ccd-mpr`. Throws UsageError where there is no such backend, or this build was made without it.
BackendKind backend_named(const std::string& word) {
  const std::string name = word == "ccd" ? "ccd-mpr" : word;
  std::string choices;
  for (BackendKind& kind : every_backend()) {
    if (kind.name == name) return std::move(kind);
    choices += (choices.empty() ? "" : ", ") + kind.name;
  }
  for (const PeerName& peer : kPeerNames) {
    if (peer.name == name) {
      throw UsageError("this build is without " + name + " (" + word + " for --backend) - build it with -D" +
                       std::string(peer.build_option) + "=ON");
    }
  }
  throw UsageError("not a choice (\"" + word + "\" for --backend) - there are " + choices);
}

InstructionSet instruction_set_named(const std::string& name) {
  if (name == "best") return best_instruction_set();
  require_one_of(name, "--isa", {"best", "scalar", "sse2", "avx2", "avx512"}, {});
  for (const InstructionSet set : instruction_sets()) {
    if (name_of(set) == name) return set;
  }
  throw UsageError("this machine or build has none (\"" + name + "\" for --isa) - its best is " +
                   std::string(name_of(best_instruction_set())));
}

// The one asked for; hit-or-miss where an option is about its poses; otherwise none. Throws UsageError where they
// contradict each other.
std::optional<Estimator> estimator_of(const CommandLine& words) {
  const std::optional<Estimator> estimator = estimator_named(words.estimator);
  const bool is_peer = !words.backend.empty() && words.backend != gjk_backend().name;
  for (const auto& [given, option] :
       std::initializer_list<std::pair<bool, const char*>>{{is_peer, "--backend"},
                                                           {words.cross_check, "--cross-check"},
                                                           {words.verify, "--verify"},
                                                           {words.no_quick_verdicts, "--no-quick-verdicts"}}) {
    if (!given) continue;
    if (!estimator) return Estimator::hit_or_miss;
    if (!samples_poses(*estimator)) {
      throw UsageError(std::string(option) + " is about overlap verdicts, of which this estimator asks none (\"" +
                       words.estimator + "\" for --estimator) - use hit-or-miss, hit-or-miss-fitted or stratified");
    }
  }
  if (words.domain.empty()) return estimator;
  if (estimator && *estimator != Estimator::hit_or_miss) {
    throw UsageError("only hit-or-miss has a choice of domains (\"" + words.domain + "\" for --domain with " +
                     words.estimator + ") - leave out --domain");
  }
  return Estimator::hit_or_miss;
}

}  // namespace

void declare_options(OptionParser& options, CommandLine& words) {
  options.add_option("A", words.a, kBodyHelp).type_name("").required();
  options.add_option("B", words.b, "The second body; without it, A again").type_name("");

  const std::string stop =
      "When to stop (whichever comes first; without any, --rel-error 1e-4, or 1e-3 where hit or miss is asked for)";
  options.add_option("--trials", words.trials, "Stop after this many trials, written like 1e7")
      .type_name("N")
      .group(stop);
  options.add_option("--rel-error", words.relative_error, "Stop at this standard error relative to the estimate")
      .type_name("E")
      .group(stop);
  options.add_option("--seconds", words.seconds, "Stop after this time").type_name("S").group(stop);
  options.add_option("--max-trials", words.max_trials, "Give up after this many trials (default 1e11)")
      .type_name("N")
      .group(stop);

  const std::string sampling = "Sampling";
  options
      .add_option(
          "--orientations", words.orientations,
          "isotropic (default); aligned; fixed:W,X,Y,Z, B's quaternion in A's frame; cone:DEG, both z axes within this "
          "angle of +-z; onsager:ALPHA, both z axes by the density cosh(ALPHA cos theta)")
      .type_name("LAW")
      .group(sampling);
  options
      .add_option(
          "--estimator", words.estimator,
          "radial (by ray casts), hit-or-miss (the paper's), hit-or-miss-fitted (its domain fitted to each trial's "
          "orientation), stratified (hit or miss in shells), mixed-volume or mean-width (by the formula's own "
          "geometry); "
          "the default is chosen by a pilot among those that run GJK, and named in the report")
      .type_name("NAME")
      .group(sampling);
  options
      .add_option("--sequence", words.sequence,
                  "random, or sobol: quasi-random points, 32 times scrambled (default but for hit or miss)")
      .type_name("NAME")
      .group(sampling);
  options
      .add_option("--domain", words.domain, "Sampling domain of hit-or-miss: ball, box, or best (default): the smaller")
      .type_name("NAME")
      .group(sampling);
  options
      .add_option("--control-variate", words.control_variate,
                  "A simpler body, like A and B and with a formula of its own, whose known mean makes the error of "
                  "radial or mixed-volume smaller; given twice: like A, and like B. The run then leans on that formula")
      .type_name("BODY")
      .group(sampling);
  declare_seed_and_threads(options, words, sampling);

  const std::string query = "Overlap query";
  options
      .add_option(
          "--backend", words.backend,
          "gjk (default); ccd-gjk or ccd-mpr (libccd; ccd means ccd-mpr); fcl; specialised (tests made for two boxes, "
          "ellipsoids or capsules, or a sphere and one of them)")
      .type_name("NAME")
      .group(query);
  options
      .add_flag("--no-quick-verdicts", words.no_quick_verdicts,
                "Do not let the circumscribed and inscribed balls decide")
      .group(query);
  options
      .add_option(
          "--isa", words.isa,
          "Instruction set of the kernels that draw poses and decide them by packets: scalar (none), sse2, avx2, "
          "avx512, or the best that this machine has (default); changes nothing but the time")
      .type_name("NAME")
      .group(query);
  options.add_flag("--cross-check", words.cross_check, "Ask every backend about every pose and list each disagreement")
      .group(query);
  options
      .add_flag("--verify", words.verify,
                "Prove every verdict again from its certificate, in exact arithmetic: some hundred times slower")
      .group(query);

  declare_options_of_two_bodies(options, words);
  declare_output(options, words);

  const std::string later = "Not built yet";
  options.add_option("--checkpoint", words.checkpoint, "Save the run's state").type_name("FILE").group(later);
  options.add_option("--resume", words.resume, "Continue a saved run").type_name("FILE").group(later);

  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused"
                 "\n  4  Monte Carlo and formula disagree"
                 "\n  130, 143  interrupted (what was done is reported)");
}

Options interpret(const CommandLine& words) {
  for (const auto& [given, option] : std::initializer_list<std::pair<bool, const char*>>{
           {!words.checkpoint.empty(), "--checkpoint"}, {!words.resume.empty(), "--resume"}}) {
    if (given) not_built_yet(option);
  }
  const auto or_default = [](const std::string& word, const char* value) { return word.empty() ? value : word; };
  const std::string domain = or_default(words.domain, "best");
  const std::string backend = or_default(words.backend, "gjk");
  const std::string orientations = or_default(words.orientations, "isotropic");
  if (!words.estimator.empty()) {
    require_one_of(words.estimator, "--estimator",
                   {"hit-or-miss", "hit-or-miss-fitted", "stratified", "radial", "mixed-volume", "mean-width"}, {});
  }
  if (!words.sequence.empty()) require_one_of(words.sequence, "--sequence", {"random", "sobol"}, {});
  require_one_of(domain, "--domain", {"ball", "box", "best"}, {});

  Options options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.a = words.a;
  options.b = words.b.empty() ? words.a : words.b;
  if (!words.trials.empty()) options.stop.trials = parse_positive_count(words.trials, "--trials");
  if (!words.relative_error.empty())
    options.stop.relative_error = parse_positive_number(words.relative_error, "--rel-error");
  if (!words.seconds.empty()) options.stop.seconds = parse_positive_number(words.seconds, "--seconds");
  if (!words.max_trials.empty()) options.stop.max_trials = parse_positive_count(words.max_trials, "--max-trials");
  options.estimator = estimator_of(words);
  if (!words.sequence.empty()) options.sequence = words.sequence == "sobol" ? Sequence::sobol : Sequence::random;
  if (domain != "best") options.domain = domain == "ball" ? Domain::Kind::ball : Domain::Kind::box;
  options.control_variate = words.control_variate;
  if (options.control_variate.size() > 2) {
    throw UsageError("too many bodies (" + options.control_variate.back() + " for --control-variate) - at most two");
  }
  if (!options.control_variate.empty() && !options.estimator) options.estimator = Estimator::radial;
  options.law = parse_orientations(orientations, "--orientations");
  options.instruction_set = instruction_set_named(or_default(words.isa, "best"));
  options.backend = backend_named(backend);
  options.is_cross_check = words.cross_check;
  if (words.cross_check) {
    for (BackendKind& kind : every_backend()) {
      if (kind.name != options.backend.name) options.cross_check.push_back(std::move(kind));
    }
  }
  // The engine's own by the kernels that were asked for, whether it answers or checks.
  const auto set_kernels = [&options](BackendKind& kind) {
    if (kind.name == gjk_backend().name) kind = gjk_backend(options.instruction_set);
  };
  set_kernels(options.backend);
  std::ranges::for_each(options.cross_check, set_kernels);
  options.verify = words.verify;
  options.quick_verdicts = !words.no_quick_verdicts;
  std::vector<std::string> bodies = {words.a};
  if (!words.b.empty()) bodies.push_back(words.b);
  bodies.insert(bodies.end(), words.control_variate.begin(), words.control_variate.end());
  options.bodies = interpret_bodies(words, bodies);
  options.dump_vertices = words.dump_vertices;
  return options;
}

}  // namespace vex
