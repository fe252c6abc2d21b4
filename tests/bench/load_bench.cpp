// What a command costs besides its trials: start-up, reading and checking meshes, hulls, streams of poses. One command:
// build/release/bin/vex_load_bench. Markdown, for docs/performance.md, and JSON.
//
// Every command is a process of its own; its time is the processor's, of the process and of the file reader that it
// starts, as the system counts it when it ends. With --beside each takes its turn with the same program of another
// build. Meshes and poses are made in a temporary folder.
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "apps/common/common_options.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "apps/common/option_parser.h"
#include "apps/common/output_file.h"
#include "apps/common/processor.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"
#include "engine/support/direction_map.h"
#include "meshes/assimp_input.h"
#include "meshes/assimp_reader.h"
#include "meshes/convexity.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/isolated_reader.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/reader.h"
#include "meshes/weld.h"
#include "shapes/polytope.h"
#include "tests/bench/rounds.h"
#include "tests/unit/meshes/soups.h"
#include "tests/unit/meshes/temporary_folder.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSteps = "steps";  // of --only: the table of the steps of one mesh
constexpr int kNotStarted = 127;         // the exit code, as a shell's
constexpr double kSizes[] = {100.0, 1e4, 1e6};

struct Settings {
  int n_rounds = 7;
  int n_triangles = 1'000'000;  // of the largest mesh; as many points of a hull, rows of a stream
  std::string beside;           // a folder of programs, or none
  std::string only;             // rows whose name holds this
  bool prints = true;           // tables; not where the document is standard output

  bool wants(const std::string& name) const { return name.find(only) != std::string::npos; }
  bool wants_steps() const { return only.empty() || only == kSteps; }
  void print(const std::string& text) const {
    if (prints) std::printf("%s", text.c_str()), std::fflush(stdout);
  }
};

struct Command {
  std::string name, program;
  std::vector<std::string> words;
  double n = 1.0;  // of what the time is given for each
};

struct Taken {
  double processor_ns = 0.0, wall_ns = 0.0;
  double peak_bytes = 0.0;  // of the process or of the file reader that it starts, whichever had more
};

double ns_of(const rusage& usage) {
  const auto ns = [](const timeval& t) {
    return 1e9 * static_cast<double>(t.tv_sec) + 1e3 * static_cast<double>(t.tv_usec);
  };
  return ns(usage.ru_utime) + ns(usage.ru_stime);
}

/// Leaves by an exception, so that the temporary folder goes.
void stop_if_interrupted() {
  if (interrupting_signal().load() != 0) throw std::runtime_error("interrupted");
}

/// From now on a signal also wakes whoever waits for a program.
void catch_interrupts_while_waiting() {
  catch_interrupts();
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    action.sa_flags &= ~static_cast<int>(SA_RESTART);
    sigaction(signal, &action, nullptr);
  }
}

/// Runs a program to its end, its output thrown away. A signal to this program ends that one.
Taken run(const std::string& program, const std::vector<std::string>& words) {
  std::vector<std::string> all = {program};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // A process starts with the peak of the one that it is a copy of: this one's meshes must not be in it. (posix_spawn
  // would share this one's memory, and its peak of all times.)
  malloc_trim(0);
  const double start = wall_ns();
  const pid_t id = fork();
  if (id < 0) throw std::runtime_error("no process can be started");
  if (id == 0) {
    const int nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0 && dup2(nothing, STDOUT_FILENO) >= 0 && dup2(nothing, STDERR_FILENO) >= 0) {
      execv(program.c_str(), pointers.data());
    }
    _exit(kNotStarted);
  }
  int status = 0;
  rusage usage{};
  while (wait4(id, &status, 0, &usage) < 0 && errno == EINTR) kill(id, SIGTERM);
  const double wall = wall_ns() - start;
  stop_if_interrupted();
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotStarted) {
    throw UsageError("a program is missing (" + program + ") - build it");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("a program failed (" + program + ")");
  return {ns_of(usage), wall, 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

/// Of this process and of those that it started and that have ended.
double own_and_childrens_ns() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  return processor_ns() + ns_of(children);
}

std::string shown(double ns) {
  const char* unit = ns >= 1e9 ? " s" : ns >= 1e6 ? " ms" : ns >= 1e3 ? " us" : " ns";
  return short_number(ns / (ns >= 1e9 ? 1e9 : ns >= 1e6 ? 1e6 : ns >= 1e3 ? 1e3 : 1.0), 3) + unit;
}

std::string mebibytes(double bytes) { return std::to_string(std::lround(bytes / 0x1p20)); }

/// A row of the table: the programs of `beside`, if given, and of this build in turns.
Json measure(const Command& command, const Settings& settings) {
  std::vector<std::string> folders;
  if (!settings.beside.empty()) folders.push_back(settings.beside);
  folders.emplace_back(VEX_PROGRAMS);
  std::vector<Timing> processor(folders.size()), wall(folders.size());
  std::vector<double> peak(folders.size());
  for (int round = -1; round < settings.n_rounds; ++round) {  // the first fills caches and does not count
    for (std::size_t k = 0; k < folders.size(); ++k) {
      const std::size_t which = (k + static_cast<std::size_t>(round + 1)) % folders.size();
      const Taken taken = run(folders[which] + "/" + command.program, command.words);
      if (round < 0) continue;
      processor[which].ns.push_back(taken.processor_ns / command.n);
      wall[which].ns.push_back(taken.wall_ns / command.n);
      peak[which] = std::max(peak[which], taken.peak_bytes);
    }
  }
  const std::size_t own = folders.size() - 1;
  std::string line = "| " + command.name + " | ";
  if (own > 0) line += shown(processor[0].median()) + " | ";
  line += shown(processor[own].median()) + " (" + short_number(100.0 * processor[own].spread(), 2) + " %) | " +
          shown(wall[own].median()) + " | ";
  if (own > 0) line += short_number(ratio(processor[0], processor[own]), 3) + " | " + mebibytes(peak[0]) + " / ";
  line += mebibytes(peak[own]) + " MiB |";
  settings.print(line + "\n");
  Json row = {{"name", command.name},
              {"processor", timing_json(processor[own])},
              {"wall", timing_json(wall[own])},
              {"peak_bytes", peak[own]}};
  if (own > 0) {
    row["beside"] = {{"processor", timing_json(processor[0])}, {"wall", timing_json(wall[0])}, {"peak_bytes", peak[0]}};
    row["times"] = ratio(processor[0], processor[own]);
  }
  return row;
}

std::vector<Command> start_up() {
  const std::vector<std::string> box = {"box:1,1,1"};
  std::vector<Command> commands;
  for (const std::string word : {"--version", "--help"}) {
    for (const std::string program : {"vex_mesh", "vex_pair"}) {
      commands.push_back({program + " " + word, program, {word}});
    }
  }
  commands.push_back({"vex_mesh box:1,1,1 --trials 1", "vex_mesh", {"box:1,1,1", "--trials", "1"}});
  commands.push_back({"vex_pair, one pose",
                      "vex_pair",
                      {"box:1,1,1", "box:1,1,1", "--rotation", "1,0,0,0", "--translation", "0.5,0,0"}});
  return commands;
}

/// An icosahedron's faces cut into n * n on an ellipsoid 3:2:1.5, about so many triangles.
PolygonSoup ellipsoid(double n_triangles) {
  return tests::sphere_soup(std::max(1, static_cast<int>(std::lround(std::sqrt(n_triangles / 20.0)))),
                            [](const Vec3d& v) {
                              return Vec3d{3 * v.x, 2 * v.y, 1.5 * v.z};
                            });
}

std::vector<double> sizes(const Settings& settings) {
  std::vector<double> all;
  for (const double n : kSizes) {
    if (n <= settings.n_triangles) all.push_back(n);
  }
  return all;
}

std::vector<Command> meshes(const Settings& settings, const tests::TemporaryFolder& folder) {
  std::vector<Command> commands;
  const auto add = [&](const std::string& name, const std::string& file, const auto& write, const PolygonSoup& soup) {
    stop_if_interrupted();
    if (settings.wants(name)) commands.push_back({name, "vex_mesh", {folder.file(file, write(soup)), "--trials", "1"}});
  };
  for (const double n : sizes(settings)) {
    const PolygonSoup soup = ellipsoid(n);
    const std::string size = std::to_string(soup.face_sizes.size());
    for (const std::string format : {".ply", ".stl", ".obj", ".off", ".gltf", ".glb", ".dae", ".3mf"}) {
      add(
          size + " triangles, " + format, "e" + size + format,
          [&format](const PolygonSoup& all) { return mesh_bytes(all, format); }, soup);
    }
    add(size + " triangles, .ply as text", "t" + size + ".ply", ply_text, soup);
    add(size + " triangles, .stl as text", "t" + size + ".stl", stl_text, soup);
  }
  const int around = static_cast<int>(672.0 * std::sqrt(settings.n_triangles / 1e6));
  const PolygonSoup capsule = tests::capsule_soup(std::max(8, around), std::max(2, around / 2));
  add(std::to_string(capsule.points.size()) + " vertices, a capsule: reflex by rounding", "capsule.ply", ply_binary,
      capsule);
  return commands;
}

std::vector<Command> hulls(const Settings& settings, const tests::TemporaryFolder& folder) {
  std::vector<Command> commands;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] {
    const Vec3d p{normal(random), normal(random), normal(random)};
    return (1.0 / norm(p)) * p;
  };
  for (double n = 1e4; n <= settings.n_triangles; n *= 10.0) {
    for (const std::string kind : {"in a ball", "in a cube", "on a sphere"}) {
      const std::string name = "hull of " + short_count(n) + " points " + kind;
      stop_if_interrupted();
      if (!settings.wants(name)) continue;
      std::vector<Vec3d> points;
      for (int i = 0; i < static_cast<int>(n); ++i) {
        points.push_back(kind == "in a ball"   ? std::cbrt(0.5 * (uniform(random) + 1.0)) * direction()
                         : kind == "in a cube" ? Vec3d{uniform(random), uniform(random), uniform(random)}
                                               : direction());
      }
      commands.push_back(
          {name,
           "vex_mesh",
           {folder.file(name + ".ply", ply_binary(tests::soup_of(points, {}))), "--hull", "--trials", "1"}});
    }
  }
  return commands;
}

std::vector<Command> streams(const Settings& settings, const tests::TemporaryFolder& folder) {
  struct Row {
    std::string name;
    bool by_quaternion;
    std::vector<std::string> more;
  };
  std::vector<Row> rows = {{"a row of vex_pair, quaternions to screen", true, {}},
                           {"a row of vex_pair, matrices to screen", false, {}},
                           {"a row of vex_pair, matrices to CSV", false, {"--csv"}},
                           {"a row of vex_pair, matrices to JSON lines", false, {"--jsonl"}}};
  std::erase_if(rows, [&](const Row& row) { return !settings.wants(row.name); });
  if (rows.empty()) return {};
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.2, 1.2);
  std::string quaternions = "tx,ty,tz,qw,qx,qy,qz\n";
  std::string matrices = "r11,r12,r13,r21,r22,r23,r31,r32,r33,tx,ty,tz\n";
  const auto append = [](std::string& text, std::initializer_list<double> numbers) {
    for (const double x : numbers) text += shortest_number(x) + ",";
    text.back() = '\n';
  };
  for (int i = 0; i < settings.n_triangles; ++i) {
    stop_if_interrupted();
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    const double tx = uniform(random), ty = uniform(random), tz = uniform(random);
    append(quaternions, {tx, ty, tz, w, x, y, z});
    const Transformd r = rotation_from_quaternion(w, x, y, z);
    append(matrices, {r.row_x.x, r.row_x.y, r.row_x.z, r.row_y.x, r.row_y.y, r.row_y.z, r.row_z.x, r.row_z.y, r.row_z.z,
                      tx, ty, tz});
  }
  const std::string by_quaternion = folder.file("quaternions.csv", quaternions);
  const std::string by_matrix = folder.file("matrices.csv", matrices);
  std::vector<Command> commands;
  for (const Row& row : rows) {
    const std::string& file = row.by_quaternion ? by_quaternion : by_matrix;
    Command command{row.name,
                    "vex_pair",
                    {"box:1,1,1", "box:1,1,1", "--poses", file, "--threads", "1"},
                    static_cast<double>(settings.n_triangles)};
    command.words.insert(command.words.end(), row.more.begin(), row.more.end());
    commands.push_back(std::move(command));
  }
  return commands;
}

/// What the seconds of one mesh go into, each step called by itself in this process; the median of the rounds.
Json stages(const Settings& settings, const tests::TemporaryFolder& folder) {
  Json rows = Json::array();
  for (const double n : sizes(settings)) {
    const auto path = folder.file("stages.ply", ply_binary(ellipsoid(n)));
    std::vector<std::pair<std::string, Timing>> steps;
    for (int round = 0; round < settings.n_rounds; ++round) {
      std::size_t step = 0;
      double start = 0.0;
      const auto begin = [&] { start = own_and_childrens_ns(); };
      const auto end = [&](const char* name) {
        const double taken = own_and_childrens_ns() - start;
        if (step == steps.size()) steps.push_back({name, {}});
        steps[step++].second.ns.push_back(taken);
        stop_if_interrupted();
      };
      begin(), static_cast<void>(read_by_assimp_isolated(prepare_for_assimp(path, ".ply")));
      end("reading by assimp in a process of its own");
      begin(), static_cast<void>(read_by_assimp(path)), end("reading by assimp in this one");
      begin();
      const PolygonSoup soup = read_polygon_soup(path);
      end("reading by the strict reader");
      begin();
      const PolygonSurface surface = weld(soup).surface;
      end("vertices welded, all put in order");
      begin();
      const Triangles triangles = fan_triangles(surface, checked_half_edges(surface));
      end("half-edges paired and checked");
      begin();
      const VolumeAndCentroid solid = volume_and_centroid(triangles);
      end("V and centroid");
      begin(), static_cast<void>(convexity_census(triangles, solid.centroid)), end("convexity");
      begin(), static_cast<void>(surface_area(triangles)), end("S");
      begin(), static_cast<void>(integrated_mean_curvature(triangles)), end("M");
      begin(), static_cast<void>(inscribed_radius(triangles, solid.centroid)), end("inradius, once");
      begin();
      const Polytope body(surface.vertices, solid.centroid.value(), 0.0);
      end("body and circumradius");
      std::vector<double> x, y, z;
      for (const Vec3d& v : surface.vertices) x.push_back(v.x), y.push_back(v.y), z.push_back(v.z);
      begin(), static_cast<void>(DirectionMap(x, y, z)), end("table of directions (where trials follow)");
    }
    settings.print("\n| " + std::to_string(std::lround(n)) + " triangles, step | processor time |\n|---|---:|\n");
    Json row = {{"triangles", n}, {"steps", Json::object()}};
    for (const auto& [name, timing] : steps) {
      settings.print("| " + name + " | " + shown(timing.median()) + " |\n");
      row["steps"][name] = timing_json(timing);
    }
    rows.push_back(row);
  }
  return rows;
}

Json measure_all(const Settings& settings) {
  const tests::TemporaryFolder folder;
  std::vector<Command> commands = start_up();
  for (const auto& more : {meshes(settings, folder), hulls(settings, folder), streams(settings, folder)}) {
    commands.insert(commands.end(), more.begin(), more.end());
  }
  std::erase_if(commands, [&](const Command& command) { return !settings.wants(command.name); });
  if (commands.empty() && !settings.wants_steps()) {
    throw UsageError("no row's name holds this (--only " + settings.only +
                     ") - give a part of a name, such as .ply, hull or matrices, or " + kSteps);
  }
  settings.print(processor() + "; g++ " + __VERSION__ + "\n");
  if (!commands.empty()) {
    const bool beside = !settings.beside.empty();
    settings.print(std::string("\n| what | ") + (beside ? "before | " : "") + "processor time | wall | " +
                   (beside ? "before / now | " : "") + "peak memory |\n|---|---:|---:|---:|" +
                   (beside ? "---:|---:|" : "") + "\n");
  }
  Json rows = Json::array();
  for (const Command& command : commands) rows.push_back(measure(command, settings));
  Json all = {{"commands", rows}};
  if (settings.wants_steps()) all["stages"] = stages(settings, folder);
  return all;
}

struct Words {
  std::string rounds, triangles, beside, only, json;
};

Settings interpret(const Words& words) {
  Settings settings;
  settings.beside = words.beside;
  settings.only = words.only;
  if (!words.rounds.empty()) {
    const std::uint64_t n = parse_positive_count(words.rounds, "--rounds");
    if (n > 10000) throw UsageError("more rounds than anybody waits for (" + words.rounds + ") - at most 10000");
    settings.n_rounds = static_cast<int>(n);
  }
  if (!words.triangles.empty()) {
    const auto n = static_cast<double>(parse_positive_count(words.triangles, "--triangles"));
    if (std::ranges::find(kSizes, n) == std::end(kSizes)) {
      throw UsageError("no mesh of this size is made (--triangles " + words.triangles + ") - give 100, 1e4 or 1e6");
    }
    settings.n_triangles = static_cast<int>(n);
  }
  if (!settings.beside.empty() && settings.only == kSteps) {
    throw UsageError("--beside with --only steps - steps are those of this build alone; leave one of the two out");
  }
  return settings;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  OptionParser options(
      "What a command costs besides its trials. Prints Markdown. Machine at rest, a quarter of an hour.",
      "vex_load_bench");
  Words words;
  options.add_option("--rounds", words.rounds, "Runs of each command that count (default 7)").type_name("N");
  options
      .add_option("--triangles", words.triangles,
                  "Of the largest mesh, points of the largest hull, rows: 100, 1e4 or 1e6 (default)")
      .type_name("N");
  options
      .add_option("--beside", words.beside, "A folder of programs of another build, which take turns with this one's")
      .type_name("DIR");
  options.add_option("--only", words.only, "Only rows whose name holds TEXT; or steps: only these").type_name("TEXT");
  options.add_option("--json", words.json, "Write all figures to FILE (- is standard output, then without tables)")
      .type_name("FILE");
  return run_program(options, argc, argv, [&] {
    Settings settings = interpret(words);
    std::optional<OutputFile> json;
    if (!words.json.empty()) json.emplace(words.json, std::span<const std::string>{});
    settings.prints = !json || !json->is_standard_output();
    catch_interrupts_while_waiting();
    const double start = wall_ns();
    Json measured;
    try {
      measured = measure_all(settings);
    } catch (const std::exception&) {
      // A program that the same signal ended has failed, too, and for this reason.
      if (interrupting_signal().load() == 0) throw;
      std::fprintf(stderr, "vex_load_bench: interrupted - no file was written\n");
      return kSignalBase + interrupting_signal().load();
    }
    Results results("vex_load_bench");
    if (json) {
      Json document = document_head(command_line(argc, argv), {}, true, 1e-9 * (wall_ns() - start));
      document["processor"] = processor();
      document["rounds"] = settings.n_rounds;
      document.update(measured);
      results.write(json, Results::Kind::numbers, [&] { return document.dump(2) + "\n"; });
    }
    return results.exit_code(kSuccess);
  });
}
