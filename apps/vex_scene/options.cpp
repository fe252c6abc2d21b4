#include "apps/vex_scene/options.h"

#include <algorithm>
#include <array>

#include "apps/common/choices.h"
#include "apps/common/instruction_sets.h"
#include "apps/common/numbers.h"
#include "apps/common/pose_numbers.h"
#include "apps/common/scene_gltf.h"
#include "apps/vex_scene/scene_file.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string or_default(const std::string& word, const char* otherwise) { return word.empty() ? otherwise : word; }

SceneQuery query_named(const std::string& word) {
  require_one_of(word, "--query", {"pairs", "within", "any", "clusters", "counts"});
  for (const SceneQuery query :
       {SceneQuery::pairs, SceneQuery::within, SceneQuery::any, SceneQuery::clusters, SceneQuery::counts}) {
    if (name_of(query) == word) return query;
  }
  return SceneQuery::pairs;
}

BroadPhase broad_phase_named(const std::string& word) {
  require_one_of(word, "--broad-phase", {"automatic", "grid", "tree"});
  return word == "grid" ? BroadPhase::grid : word == "tree" ? BroadPhase::tree : BroadPhase::automatic;
}

PeriodicBox box_of(const std::string& word) {
  const auto n_numbers = 1 + std::ranges::count(word, ',');
  if (n_numbers != 3 && n_numbers != 6) {
    throw UsageError("wrong number of numbers (" + std::to_string(n_numbers) +
                     " for --box) - give the edges Lx,Ly,Lz, or edges and tilts Lx,Ly,Lz,xy,xz,yz");
  }
  std::array<double, 6> numbers{};
  read_numbers(word, "--box", std::span(numbers).first(static_cast<std::size_t>(n_numbers)));
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

double distance_of(const SceneCommandLine& words, SceneQuery query) {
  if (query == SceneQuery::within && words.distance.empty()) {
    throw UsageError("not given (--query within) - add --distance D");
  }
  if (words.distance.empty()) return 0.0;
  if (query != SceneQuery::within && query != SceneQuery::clusters) {
    throw UsageError("a distance goes with --query within or clusters (--distance with --query " +
                     std::string(name_of(query)) + ") - add --query within, or leave it out");
  }
  const double distance = pose_number(words.distance, "--distance");
  if (distance < 0.0) throw UsageError("a distance below 0 (" + words.distance + " for --distance) - give 0 or more");
  return distance;
}

std::map<std::string, std::string, std::less<>> named_bodies_of(const std::vector<std::string>& words) {
  std::map<std::string, std::string, std::less<>> named;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == word.size()) {
      throw UsageError("not a name and a body (\"" + word + "\" for --body) - write NAME=TEXT, like cube=box:1,1,1");
    }
    const std::string name = word.substr(0, equals);
    if (without_blanks(name).size() != name.size()) {
      throw UsageError("a name with blanks at its ends (\"" + name + "\" for --body) - leave them out");
    }
    if (!named.emplace(name, word.substr(equals + 1)).second) {
      throw UsageError("a name is given twice (" + name + " for --body) - choose another one");
    }
  }
  return named;
}

// The body's text has commas of its own: the count stands before the first one, eta behind the last.
RandomScene random_scene_of(const std::string& word) {
  const std::size_t first = word.find(','), last = word.rfind(',');
  if (first == std::string::npos || first == last || last == first + 1) {
    throw UsageError("not a random scene (\"" + word + "\" for --random) - write N,BODY,ETA, like 1e5,box:1,1,1,0.2");
  }
  RandomScene scene;
  scene.n_bodies = parse_positive_count(std::string_view(word).substr(0, first), "N of --random");
  scene.body = word.substr(first + 1, last - first - 1);
  scene.eta = parse_positive_number(std::string_view(word).substr(last + 1), "ETA of --random");
  return scene;
}

void require_one_scene(const SceneCommandLine& words) {
  if (words.file.empty() && words.random.empty()) {
    throw UsageError("no scene is given - give FILE (- is standard input), or --random N,BODY,ETA");
  }
  if (!words.file.empty() && !words.random.empty()) {
    throw UsageError("two scenes (" + words.file + ", and " + words.random + " for --random) - choose one");
  }
  if (!words.random.empty() && !words.box.empty()) {
    throw UsageError("a random scene makes its own box (--box with --random) - leave out --box");
  }
}

// Standard output has one content.
void require_one_standard_output(const SceneCommandLine& words, SceneQuery query) {
  if (words.jsonl && words.csv) throw UsageError("two forms of the same rows (--jsonl and --csv) - choose one");
  const char* const rows = words.jsonl ? "--jsonl" : words.csv ? "--csv" : nullptr;
  if (rows != nullptr && query == SceneQuery::counts) {
    throw UsageError("counts have no rows (" + std::string(rows) + " with --query counts) - leave it out");
  }
  for (const auto& [path, option] :
       {std::pair{&words.json, "--json"}, {&words.save, "--save"}, {&words.svg, "--svg"}}) {
    if (rows == nullptr || *path != "-") continue;
    throw UsageError("standard output is asked for twice (" + std::string(option) + " - and " + rows +
                     ") - write one of them into a file");
  }
}

void declare_scene(OptionParser& options, SceneCommandLine& words) {
  options
      .add_option("FILE", words.file,
                  std::string("A body a row, below the header ") + kSceneHeaders +
                      "; - is standard input. A body is what other programs take: box:1,2,3 (in quotation marks, for "
                      "its commas), a mesh file, or a name that --body gives")
      .type_name("");
  const std::string scene = "Scene";
  options.add_option("--body", words.named_bodies, "Let NAME stand for this body in FILE; may be given several times")
      .type_name("NAME=TEXT")
      .group(scene);
  options
      .add_option("--box", words.box,
                  "Space is periodic, in a cell of these edges; with tilts, of the vectors (Lx, 0, 0), (xy Ly, Ly, 0), "
                  "(xz Lz, yz Lz, Lz). Without it space is open")
      .type_name("Lx,Ly,Lz[,xy,xz,yz]")
      .group(scene);
  options
      .add_option("--random", words.random,
                  "Instead of FILE: N copies of a body, isotropic and uniform in a periodic cube of edge L, with "
                  "N V/L^3 = ETA")
      .type_name("N,BODY,ETA")
      .group(scene);
  options
      .add_option("--save", words.save,
                  "Write the scene as it could be read as FILE, with the same pairs; of a random one, --box is said")
      .type_name("FILE.csv")
      .group(scene);
}

void declare_query(OptionParser& options, SceneCommandLine& words) {
  const std::string query = "Query";
  options
      .add_option("--query", words.query,
                  "pairs (all that overlap, the default), within (all within --distance, with their distances), any "
                  "(whether two overlap; ends at the first), clusters (of overlapping bodies), or counts (how many "
                  "pairs overlap, without listing them)")
      .type_name("NAME")
      .group(query);
  options
      .add_option(
          "--distance", words.distance,
          "For --query within: the largest, 0 or more. For clusters: bodies are connected that are no farther apart "
          "(default 0)")
      .type_name("D")
      .group(query);
  options
      .add_option("--broad-phase", words.broad_phase,
                  "How near pairs are found: grid (of cells as large as the largest body), tree (of boxes), or "
                  "automatic (by the work that each is expected to be; default); changes nothing but the time")
      .type_name("NAME")
      .group(query);
  declare_instruction_set(options, words.isa, query, "the kernels that decide pairs by packets");
  declare_seed_and_threads(options, words, query);
}

}  // namespace

void declare_options(OptionParser& options, SceneCommandLine& words) {
  declare_scene(options, words);
  declare_query(options, words);
  declare_body_options(options, words);
  const std::string output = "Output";
  options.add_flag("--csv", words.csv, "Print rows as columns of CSV: the default").group(output);
  options.add_flag("--jsonl", words.jsonl, "Print rows as objects of JSON, one a line").group(output);
  declare_json_and_quiet(options, words, "Print no summary: only rows");
  options
      .add_option(
          "--gltf", words.gltf,
          "Write the scene as binary glTF 2.0, which viewers show: the largest cluster, or the bodies of pairs, "
          "stand out")
      .type_name("FILE.glb")
      .group(output);
  options
      .add_option("--svg", words.svg, "Draw how many pairs came to each stage of the search, and how many it settled")
      .type_name("FILE.svg")
      .group(output);
  options.footer(
      named_bodies_help() +
      "\n\nRows: a,b,image_x,image_y,image_z of pairs, with a < b: body a, counted from 0, and the copy of body b that "
      "is so many vectors of the box away from where FILE puts it; a = b for a body that meets its own copy. within "
      "adds distance; clusters gives body,cluster; any gives verdict. Pairs of which nothing is proven are listed, "
      "too: then, and only then, a last column says verdict."
      "\n\nNumbers may be decimal (0.1) or hexadecimal (0x1.999999999999ap-4)."
      "\n\nExit codes:"
      "\n  0  success; undecided verdicts are answers, too"
      "\n  1  a fault of the program"
      "\n  2  wrong usage"
      "\n  3  input refused: a row (its line is named), a body, a box; a body larger than the box allows"
      "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (rows end at the end of a row; --json says "
      "that it is not complete)");
}

std::vector<std::string> SceneOptions::bodies_of_command_line() const {
  std::vector<std::string> bodies;
  for (const auto& [name, text] : named_bodies) bodies.push_back(text);
  if (random) bodies.push_back(random->body);
  return bodies;
}

SceneOptions interpret(const SceneCommandLine& words) {
  require_one_scene(words);
  SceneOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.query = query_named(or_default(words.query, "pairs"));
  require_one_standard_output(words, options.query);
  require_glb_name(words.gltf, "--gltf");
  options.file = words.file;
  options.named_bodies = named_bodies_of(words.named_bodies);
  if (!words.random.empty()) {
    options.random = random_scene_of(words.random);
    const auto named = options.named_bodies.find(options.random->body);
    if (named != options.named_bodies.end()) options.random->body = named->second;
  }
  if (!words.box.empty()) options.box = box_of(words.box);
  options.distance = distance_of(words, options.query);
  options.settings.broad_phase = broad_phase_named(or_default(words.broad_phase, "automatic"));
  options.settings.instruction_set = instruction_set_named(words.isa);
  options.settings.n_threads = options.n_threads;
  options.rows = words.jsonl ? RowFormat::jsonl : RowFormat::csv;
  options.dump_vertices = words.dump_vertices;
  if (options.dump_vertices && options.json.empty()) {
    throw UsageError("rows have no place for a body's vertices (--dump-vertices) - add --json FILE");
  }
  options.save = words.save;
  options.gltf = words.gltf;
  options.svg = words.svg;
  options.body_words = words;
  return options;
}

}  // namespace vex
