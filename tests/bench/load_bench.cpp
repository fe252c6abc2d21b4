// What a command costs besides its trials: start-up, reading and checking meshes, hulls, streams of poses. One command:
// build/release/bin/vex_load_bench. Markdown, for docs/performance.md, and JSON.
//
// Every command is a process of its own; its time is the processor's, of the process and of the file reader that it
// starts, as the system counts it when it ends. With --beside each takes its turn with the same program of another
// build. Meshes and poses are made in a temporary folder.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/option_parser.h"
#include "apps/common/output_file.h"
#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"
#include "meshes/convexity.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/isolated_reader.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/reader.h"
#include "meshes/weld.h"
#include "shapes/direction_map.h"
#include "shapes/polytope.h"
#include "tests/bench/processor.h"
#include "tests/bench/rounds.h"
#include "tests/unit/meshes/soups.h"
#include "tests/unit/meshes/temporary_folder.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  int n_rounds = 7;
  int n_triangles = 1'000'000;  // of the largest mesh; as many points of a hull, rows of a stream
  std::string beside;           // a folder of programs, or none
  std::string only;             // rows whose name holds this

  bool wants(const std::string& name) const { return name.find(only) != std::string::npos; }
};

struct Command {
  std::string name, program;
  std::vector<std::string> words;
  double n = 1.0;  // of what the time is given for each
};

struct Taken {
  double processor_ns = 0.0, wall_ns = 0.0;
};

double ns_of(const rusage& usage) {
  const auto ns = [](const timeval& t) {
    return 1e9 * static_cast<double>(t.tv_sec) + 1e3 * static_cast<double>(t.tv_usec);
  };
  return ns(usage.ru_utime) + ns(usage.ru_stime);
}

/// Runs a program to its end, its output thrown away.
Taken run(const std::string& program, const std::vector<std::string>& words) {
  std::vector<std::string> all = {program};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  }
  const double start = wall_ns();
  pid_t id = 0;
  const int error = posix_spawn(&id, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw UsageError("a program is missing (" + program + ") - build it");
  int status = 0;
  rusage usage{};
  wait4(id, &status, 0, &usage);
  const double wall = wall_ns() - start;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("a program failed (" + program + ")");
  return {ns_of(usage), wall};
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

/// A row of the table: the programs of `beside`, if given, and of this build in turns.
Json measure(const Command& command, const Settings& settings) {
  std::vector<std::string> folders;
  if (!settings.beside.empty()) folders.push_back(settings.beside);
  folders.emplace_back(VEX_PROGRAMS);
  std::vector<Timing> processor(folders.size()), wall(folders.size());
  for (int round = -1; round < settings.n_rounds; ++round) {  // the first fills caches and does not count
    for (std::size_t k = 0; k < folders.size(); ++k) {
      const std::size_t which = (k + static_cast<std::size_t>(round + 1)) % folders.size();
      const Taken taken = run(folders[which] + "/" + command.program, command.words);
      if (round < 0) continue;
      processor[which].ns.push_back(taken.processor_ns / command.n);
      wall[which].ns.push_back(taken.wall_ns / command.n);
    }
  }
  const std::size_t own = folders.size() - 1;
  std::string line = "| " + command.name + " | ";
  if (own > 0) line += shown(processor[0].median()) + " | ";
  line += shown(processor[own].median()) + " (" + short_number(100.0 * processor[own].spread(), 2) + " %) | " +
          shown(wall[own].median()) + " |";
  if (own > 0) line += " " + short_number(ratio(processor[0], processor[own]), 3) + " |";
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  Json row = {{"name", command.name}, {"processor", timing_json(processor[own])}, {"wall", timing_json(wall[own])}};
  if (own > 0) {
    row["beside"] = {{"processor", timing_json(processor[0])}, {"wall", timing_json(wall[0])}};
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
  for (const double n : {100.0, 1e4, 1e6}) {
    if (n <= settings.n_triangles) all.push_back(n);
  }
  return all;
}

std::vector<Command> meshes(const Settings& settings, const tests::TemporaryFolder& folder) {
  std::vector<Command> commands;
  const auto add = [&](const std::string& name, const std::string& file, const auto& write, const PolygonSoup& soup) {
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
  const std::string name_of_row = "a row of vex_pair, ";
  if (name_of_row.find(settings.only) == std::string::npos) return {};
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
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    const double tx = uniform(random), ty = uniform(random), tz = uniform(random);
    append(quaternions, {tx, ty, tz, w, x, y, z});
    const Transformd r = rotation_from_quaternion(w, x, y, z);
    append(matrices, {r.row_x.x, r.row_x.y, r.row_x.z, r.row_y.x, r.row_y.y, r.row_y.z, r.row_z.x, r.row_z.y, r.row_z.z,
                      tx, ty, tz});
  }
  const std::string by_quaternion = folder.file("quaternions.csv", quaternions);
  const std::string by_matrix = folder.file("matrices.csv", matrices);
  const double n = settings.n_triangles;
  const auto command = [n, &name_of_row](const std::string& name, const std::string& file,
                                         std::vector<std::string> more) {
    std::vector<std::string> words = {"box:1,1,1", "box:1,1,1", "--poses", file, "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return Command{name_of_row + name, "vex_pair", words, n};
  };
  return {command("quaternions to screen", by_quaternion, {}), command("matrices to screen", by_matrix, {}),
          command("matrices to CSV", by_matrix, {"--csv"}), command("matrices to JSON lines", by_matrix, {"--jsonl"})};
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
      };
      begin(), static_cast<void>(read_polygon_soup_isolated(path)), end("reading in a process of its own");
      begin();
      const PolygonSoup soup = read_polygon_soup(path);
      end("reading in this one (assimp)");
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
    std::printf("\n| %.0f triangles, step | processor time |\n|---|---:|\n", n);
    Json row = {{"triangles", n}, {"steps", Json::object()}};
    for (const auto& [name, timing] : steps) {
      std::printf("| %s | %s |\n", name.c_str(), shown(timing.median()).c_str());
      row["steps"][name] = timing_json(timing);
    }
    std::fflush(stdout);
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
  const bool beside = !settings.beside.empty();
  std::printf("| what | %sprocessor time | wall |%s\n|---|---:|---:|%s\n", beside ? "before | " : "",
              beside ? " before / now |" : "", beside ? "---:|---:|" : "");
  Json rows = Json::array();
  for (const Command& command : commands) {
    if (settings.wants(command.name)) rows.push_back(measure(command, settings));
  }
  Json all = {{"commands", rows}};
  if (settings.only.empty() || settings.only == "steps") all["stages"] = stages(settings, folder);
  return all;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  OptionParser options("What a command costs besides its trials. Prints Markdown. Machine at rest, minutes.",
                       "vex_load_bench");
  std::string rounds, triangles, json_file;
  Settings settings;
  options.add_option("--rounds", rounds, "Runs of each command that count (default 7)").type_name("N");
  options.add_option("--triangles", triangles, "Of the largest mesh, points of the largest hull, rows (default 1e6)")
      .type_name("N");
  options
      .add_option("--beside", settings.beside,
                  "A folder of programs of another build, which take turns with this one's")
      .type_name("DIR");
  options.add_option("--only", settings.only, "Only rows whose name holds TEXT; or steps: only these")
      .type_name("TEXT");
  options.add_option("--json", json_file, "Write all figures to FILE").type_name("FILE");
  return run_program(options, argc, argv, [&] {
    constexpr std::uint64_t kMost = 10'000'000;
    if (!rounds.empty()) {
      settings.n_rounds = static_cast<int>(std::min(kMost, parse_positive_count(rounds, "--rounds")));
    }
    if (!triangles.empty()) {
      settings.n_triangles = static_cast<int>(std::min(kMost, parse_positive_count(triangles, "--triangles")));
    }
    std::optional<OutputFile> json;
    if (!json_file.empty()) json.emplace(json_file, std::span<const std::string>{});
    std::printf("%s; g++ %s\n\n", processor().c_str(), __VERSION__);
    const double start = wall_ns();
    const Json measured = measure_all(settings);
    if (json) {
      Json document = document_head(command_line(argc, argv), {}, true, 1e-9 * (wall_ns() - start));
      document["processor"] = processor();
      document["rounds"] = settings.n_rounds;
      document.update(measured);
      json->write(document.dump(2) + "\n");
    }
    return kSuccess;
  });
}
