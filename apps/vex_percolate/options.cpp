#include "apps/vex_percolate/options.h"

#include <algorithm>
#include <filesystem>

#include "apps/common/backends.h"
#include "apps/common/instruction_sets.h"
#include "apps/common/numbers.h"
#include "apps/common/orientation_options.h"
#include "apps/common/pose_numbers.h"
#include "apps/common/scene_gltf.h"
#include "apps/common/text.h"
#include "apps/referees/wrong_tests.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/poses/orientation_law_text.h"

namespace vex {
namespace {

constexpr const char* kUniformAngle = "uniform-angle";
constexpr const char* kOneSided = "one-sided-edges";
constexpr double kSmallestSize = 2.0, kLeastFraction = 1e-100, kMostFraction = 1e100;

std::vector<double> sizes_of(const std::string& word) {
  if (word.empty()) return {4.0, 6.0, 12.0};
  std::vector<double> sizes;
  for (std::size_t begin = 0; begin <= word.size();) {
    const std::size_t comma = std::min(word.find(',', begin), word.size());
    const std::string one = word.substr(begin, comma - begin);
    const double size = parse_positive_number(one, "--sizes");
    if (size < kSmallestSize) {
      throw UsageError("a cube of less than two extents of a body (" + one + " for --sizes) - give 2 or more");
    }
    if (std::ranges::find(sizes, size) != sizes.end()) {
      throw UsageError("a size is given twice (" + one + " for --sizes) - give unlike ones");
    }
    sizes.push_back(size);
    begin = comma + 1;
  }
  if (sizes.size() > kMostSizes) throw UsageError("too many sizes (--sizes) - give at most 64");
  std::ranges::sort(sizes);
  return sizes;
}

std::vector<BodyFraction> bodies_of(const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError("no body is given - name one, like box:1,1,1");
  std::vector<BodyFraction> bodies;
  std::size_t n_fractions = 0;
  for (const std::string& word : words) {
    const BodyText body = body_and_fraction(word);
    if (body.fraction) ++n_fractions;
    if (body.fraction && !(*body.fraction > 0.0)) {
      throw UsageError("a fraction that is not above 0 (" + word + ") - leave the body out, or give it a share");
    }
    if (body.fraction && !(*body.fraction >= kLeastFraction && *body.fraction <= kMostFraction)) {
      throw UsageError("a fraction out of range (" + word +
                       ") - only ratios of fractions count: give numbers between 1e-100 and 1e100");
    }
    bodies.push_back({body.text, body.fraction.value_or(1.0)});
  }
  if (n_fractions != 0 && n_fractions != words.size()) {
    throw UsageError("some bodies have a fraction and others have none - write BODY:FRACTION for each, or for none");
  }
  return bodies;
}

void declare_stop_rules(OptionParser& options, PercolateCommandLine& words) {
  const std::string stop = "When to stop (whichever comes first; without any, --realisations 2000)";
  options
      .add_option("--realisations", words.realisations,
                  "Stop after this many of each size, written like 1e5; a threshold needs 50")
      .type_name("N")
      .group(stop);
  options
      .add_option("--std-error", words.std_error,
                  "Stop at this standard error of eta_c, that of the extrapolation included")
      .type_name("E")
      .group(stop);
  options.add_option("--seconds", words.seconds, "Stop after this time").type_name("S").group(stop);
}

void declare_system(OptionParser& options, PercolateCommandLine& words) {
  const std::string system = "System";
  options
      .add_option(
          "--sizes", words.sizes,
          "Edges of the periodic cube, in units of the largest body's extent (twice its circumradius); default "
          "4,6,12. From several sizes the threshold is extrapolated to infinite space; a law that is not isotropic "
          "needs two or more, best three")
      .type_name("L1,L2,...")
      .group(system);
  options
      .add_option("--orientations", words.orientations,
                  std::string("How each body is turned: isotropic (default); aligned; or its axis by ") +
                      kAxisLawsHelp +
                      "; or uniform-angle, theta itself uniform, which is not isotropic and has been taken for it")
      .type_name("LAW")
      .group(system);
  declare_axis(options, words.axis, system);
  options
      .add_option("--shell", words.shell,
                  "Bodies are connected where their gap is at most this: each has a soft shell of half of it")
      .type_name("D")
      .group(system);
  options
      .add_option("--backend", words.backend,
                  "What decides overlap: gjk (default, proven, by packets), one of vex_mesh's, or one-sided-edges, for "
                  "boxes: whether an edge of the later body meets the earlier one, a test that misses overlaps and has "
                  "been used")
      .type_name("NAME")
      .group(system);
  declare_instruction_set(options, words.isa, system);
  declare_seed_and_threads(options, words, system);
}

void declare_outputs(OptionParser& options, PercolateCommandLine& words) {
  const std::string output = "Output";
  declare_json_and_quiet(options, words, "Print no report");
  options.add_option("--plot", words.plot, "Draw the wrapping probability against eta for each size, and the threshold")
      .type_name("FILE.svg")
      .group(output);
  options.add_option("--csv", words.csv, "Write of each realisation with how many bodies a cluster first wrapped")
      .type_name("FILE.csv")
      .group(output);
  options
      .add_option(
          "--gltf", words.gltf,
          "Write the first realisation of the smallest size, with just so many bodies that a cluster first wraps along "
          "an axis, as binary glTF 2.0, which viewers show: that cluster stands out")
      .type_name("FILE.glb")
      .group(output);
  options
      .add_option("--report", words.report,
                  "Write a page to look at in a browser, which needs no other file and no network: the bodies to turn, "
                  "all numbers with their meaning, the curves and the way to infinite size; - is standard output")
      .type_name("FILE.html")
      .group(output);
  // A saved state is the same as --csv writes, which --resume takes as well.
  const std::string parts = "A run in parts";
  declare_checkpoint(options, words, parts);
  options
      .add_option("--first-realisation", words.first_realisation,
                  "Begin with this realisation of each size, and make --realisations of them: a part of a run, whose "
                  "--json has them all, and which vex_merge puts together with others")
      .type_name("N")
      .group(parts);
}

}  // namespace

BodyText body_and_fraction(const std::string& word) {
  const std::size_t colon = word.rfind(':');
  std::error_code error;
  if (colon == std::string::npos || std::filesystem::exists(word, error)) return {word, std::nullopt};
  const std::string before = word.substr(0, colon), behind = word.substr(colon + 1);
  if (!is_a_number(behind)) return {word, std::nullopt};
  // A name alone has no sizes yet: `sphere:1` is a body, not a sphere of the fraction 1.
  const std::string core = before.substr(before.rfind(',') == std::string::npos ? 0 : before.rfind(',') + 1);
  const bool lacks_sizes = core.find(':') == std::string::npos && names_a_shape(core + ":");
  const bool is_radius = before == "rounded";
  if (before.empty() || lacks_sizes || is_radius) return {word, std::nullopt};
  const bool is_named = before.find(':') != std::string::npos;
  if (!is_named && !std::filesystem::exists(before, error)) return {word, std::nullopt};
  return {before, parse_number(behind, "the fraction of " + before)};
}

void declare_options(OptionParser& options, PercolateCommandLine& words) {
  options
      .add_option("BODY", words.bodies,
                  "A mesh file, - for standard input, or a named body such as box:1,2,3; several are a mixture, each "
                  "with its part of the number of bodies behind a colon: sphere:0.5:0.3 (equal parts without)")
      .type_name("...")
      .required();
  declare_stop_rules(options, words);
  declare_system(options, words);
  declare_body_options(options, words);
  declare_outputs(options, words);
  options.footer(
      named_bodies_help() +
      "\n\neta = n V, the number density times the (mean) volume; phi = 1 - exp(-eta), the share of space that "
      "the bodies cover; B = n <V_ex>, the number of others that a body overlaps."
      "\n\nExit codes:"
      "\n  0  success"
      "\n  1  a fault of the program"
      "\n  2  wrong usage"
      "\n  3  input refused: a body, a file to resume from"
      "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (what was done is reported)");
}

PercolateOptions interpret(const PercolateCommandLine& words) {
  PercolateOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.bodies = bodies_of(words.bodies);
  require_glb_name(words.gltf, "--gltf");
  std::vector<std::string> texts;
  for (const BodyFraction& body : options.bodies) texts.push_back(body.text);
  options.body_options = interpret_bodies(words, texts);
  options.sizes = sizes_of(words.sizes);
  if (!words.realisations.empty()) {
    options.realisations = parse_positive_count(words.realisations, "--realisations");
    // One alone has no error; as a part of a run, for vex_merge, it needs none.
    const std::uint64_t fewest = words.first_realisation.empty() ? 2 : 1;
    if (*options.realisations < fewest || *options.realisations > kMostRealisations) {
      throw UsageError("out of range (" + words.realisations + " for --realisations) - give " + std::to_string(fewest) +
                       " to " + std::to_string(kMostRealisations));
    }
  }
  if (!words.std_error.empty()) options.std_error = parse_positive_number(words.std_error, "--std-error");
  if (!words.seconds.empty()) options.seconds = parse_positive_number(words.seconds, "--seconds");
  if (!words.first_realisation.empty()) {
    const std::uint64_t first = parse_count(words.first_realisation, "--first-realisation");
    if (!options.realisations || options.std_error || options.seconds) {
      throw UsageError("a part of a run ends by its number of realisations alone (--first-realisation " +
                       words.first_realisation + ") - give --realisations, and no other rule");
    }
    if (first > kMostRealisations - *options.realisations) {
      throw UsageError("out of range (" + words.first_realisation + " for --first-realisation) - there are " +
                       std::to_string(kMostRealisations));
    }
    options.first_realisation = static_cast<std::uint32_t>(first);
    options.is_part = true;
  }
  if (!options.realisations && !options.std_error && !options.seconds) options.realisations = 2000;
  options.law = words.orientations.empty() ? "isotropic" : words.orientations;
  if (options.law == kUniformAngle) {
    options.orientations.uniform_polar_angle = true;
    if (!words.axis.empty()) throw UsageError("uniform-angle is about z (--axis " + words.axis + ") - name no axis");
  } else {
    options.orientations.law = law_of_bodies(options.law, words.axis, kUniformAngle);
    if (const std::optional<std::string> file = file_of_law(options.law)) options.law_files = {*file};
    options.law = options.orientations.law.name();
  }
  if (!words.shell.empty()) options.shell = parse_number(words.shell, "--shell");
  if (options.shell < 0.0) {
    throw UsageError("a shell below 0 (" + words.shell + " for --shell) - give the largest gap that connects");
  }
  options.instruction_set = instruction_set_named(words.isa);
  options.backend_name = words.backend.empty() ? gjk_backend().name : words.backend;
  BackendKind one_sided = one_sided_backend();
  one_sided.name = kOneSided;
  BackendKind backend = backend_named(options.backend_name, {one_sided});
  options.backend_name = backend.name;
  if (backend.name != gjk_backend().name) options.backend = std::move(backend);
  options.dump_vertices = words.dump_vertices;
  options.plot = words.plot;
  options.csv = words.csv;
  options.gltf = words.gltf;
  options.report = words.report;
  options.checkpoint = interpret_checkpoint(words);
  return options;
}

}  // namespace vex
