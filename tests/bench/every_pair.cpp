// Every kind of body with every other: `table` compares Monte Carlo with the formula for each ordered pair,
// `cross-check` asks every backend of this build about the same poses and prints each pose on which they differ.
//
//   vex_every_pair table > docs/every_pair.md
//   vex_every_pair cross-check --poses 1 > docs/cross_check.md
//
// The output is Markdown. Exit code 4 where a pair of the table is off by more than 4.5 standard errors, or where exact
// arithmetic contradicts a verdict of the engine.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "apps/peers/peers.h"
#include "apps/referees/exact_overlap.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/formula.h"

namespace vex {
namespace {

constexpr double kMostStandardErrors = 4.5;

// One of each kind, without symmetry where the kind allows it; the last is a mesh of 300 vertices.
const std::vector<std::string> kKinds = {"sphere:0.6",
                                         "box:0.6,1,1.5",
                                         "ellipsoid:0.4,0.6,1.1",
                                         "capsule:1,0.4",
                                         "cylinder:1,0.5",
                                         "cone:1.2,0.6",
                                         "frustum:1,0.7,0.4",
                                         "hemisphere:0.8",
                                         "disc:0.8",
                                         "plate:1,1.4",
                                         "needle:2",
                                         "tetrahedron:1.5",
                                         "octahedron:1.2",
                                         "dodecahedron:0.5",
                                         "icosahedron:0.8",
                                         "rounded:0.2,box:0.6,0.8,1",
                                         VEX_SOURCE_DIR "/meshes/data/pebble.obj"};

struct Kind {
  std::string name;  // as it is printed: without a mesh's folder
  Body shape;
};

std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (const std::string& text : kKinds) {
    const bool is_file = text.front() == '/';
    kinds.push_back({is_file ? text.substr(text.rfind('/') + 1) : text, load_body(text, {}).shape});
  }
  return kinds;
}

std::string kind_of(const Kind& kind) { return kind.shape.kind == "polyhedron" ? "mesh" : kind.shape.kind; }

// ---------------------------------------------------------------------------------------------------- table

struct Row {
  std::string a, b;
  double formula = 0.0;
  VolumeEstimate found;
  std::uint64_t n_trials = 0;
  std::uint64_t n_undecided = 0;

  bool is_run() const { return n_trials > 0; }
  double z() const { return (found.excluded_volume - formula) / found.std_error; }
};

Row measure(const Kind& a, const Kind& b, std::uint64_t seed, double relative_error, int n_threads) {
  Row row{a.name, b.name, average_excluded_volume(a.shape.measures, b.shape.measures), {}};
  if (row.formula == 0.0) return row;  // two needles
  MonteCarloSettings settings;
  settings.seed = seed;
  settings.n_threads = n_threads;
  // Of two balls every trial in a ball hits; in a box they are a test like any other.
  settings.domain = best_domain(a.shape.body, b.shape.body);
  if (hits_by_construction(a.shape.body, b.shape.body, settings.law, settings.domain)) {
    settings.domain = box_domain(a.shape.body, b.shape.body);
  }
  settings.stop.relative_error = relative_error;
  const RunRecord record = run_monte_carlo(a.shape.body, b.shape.body, settings);
  row.found = hit_or_miss_estimate(record.tally, settings.domain.volume);
  row.n_trials = record.tally.n_trials;
  row.n_undecided = record.tally.n_undecided;
  return row;
}

int print_table(double relative_error, int n_threads) {
  const std::vector<Kind> kinds = all_kinds();
  const std::size_t n = kinds.size();
  std::vector<Row> rows;
  double sum_sq = 0.0, worst = 0.0;
  std::size_t n_run = 0, n_off = 0;
  std::uint64_t n_trials = 0, n_undecided = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      rows.push_back(measure(kinds[i], kinds[j], 1 + i * n + j, relative_error, n_threads));
      const Row& row = rows.back();
      std::fprintf(stderr, "%s  %s  z = %s\n", row.a.c_str(), row.b.c_str(),
                   row.is_run() ? fixed_number(2, row.z()).c_str() : "none");
      if (!row.is_run()) continue;
      ++n_run;
      n_trials += row.n_trials;
      n_undecided += row.n_undecided;
      sum_sq += row.z() * row.z();
      worst = std::max(worst, std::fabs(row.z()));
      if (std::fabs(row.z()) > kMostStandardErrors) ++n_off;
    }
  }

  std::cout << "# Every kind of body with every other\n\n"
            << "Made by `vex_every_pair table` (build/release/bin after `sh tests/run`); seed of the k-th pair: k.\n\n"
            << "z = (Monte Carlo − formula) / standard error of ⟨V_ex⟩, every ordered pair run to a relative standard "
            << "error of " << short_number(relative_error, 3) << ". " << n_run << " pairs, "
            << short_number(static_cast<double>(n_trials), 3) << " trials, " << n_undecided
            << " undecided. Largest |z|: " << fixed_number(2, worst) << " (of " << n_run << " right ones about "
            << fixed_number(1, std::sqrt(2.0 * std::log(static_cast<double>(n_run))))
            << " is to be expected); root mean square: "
            << fixed_number(3, std::sqrt(sum_sq / static_cast<double>(n_run)))
            << ". Two needles exclude no volume, so nothing is run.\n\n| A \\ B |";
  for (const Kind& kind : kinds) std::cout << " " << kind_of(kind) << " |";
  std::cout << "\n|---|";
  for (std::size_t j = 0; j < n; ++j) std::cout << "---:|";
  for (std::size_t i = 0; i < n; ++i) {
    std::cout << "\n| **" << kind_of(kinds[i]) << "** |";
    for (std::size_t j = 0; j < n; ++j) {
      const Row& row = rows[i * n + j];
      std::cout << " " << (row.is_run() ? fixed_number(2, row.z()) : "–") << " |";
    }
  }
  std::cout << "\n\n## The values\n\n| A | B | formula | Monte Carlo | z | trials |\n|---|---|---:|---:|---:|---:|\n";
  for (const Row& row : rows) {
    std::cout << "| " << row.a << " | " << row.b << " | " << short_number(row.formula, 8) << " | ";
    if (row.is_run()) {
      std::cout << with_error(row.found.excluded_volume, row.found.std_error) << " | " << fixed_number(2, row.z())
                << " | " << row.n_trials << " |\n";
    } else {
      std::cout << "no run | – | 0 |\n";
    }
  }
  return n_off == 0 ? kSuccess : kDisagreement;
}

// ---------------------------------------------------------------------------------------------- cross-check

// What one backend said against the engine's proven verdict.
struct Against {
  bool takes_part = false;
  std::uint64_t n_missed = 0;    // disjoint where the engine proves an overlap
  std::uint64_t n_invented = 0;  // overlap where the engine proves that they are apart
  std::uint64_t n_given_up = 0;
};

std::string pose_text(const Transformd& pose) {
  std::string text;
  for (const Vec3d& row : {pose.row_x, pose.row_y, pose.row_z, pose.translation}) {
    text += (text.empty() ? "" : ",") + hex_number(row.x) + "," + hex_number(row.y) + "," + hex_number(row.z);
  }
  return text;
}

// Whether exact arithmetic contradicts the engine; only polytopes can be asked.
bool is_contradicted(const ConvexBody& a, const ConvexBody& b, const Disagreement& found) {
  const std::vector<Vec3d> p = vertices_of(a), q = vertices_of(b);
  if (p.empty() || q.empty() || found.outcomes[0] == Outcome::undecided) return false;
  return exact::overlap(p, exact::placed(q, found.a_from_b)) != (found.outcomes[0] == Outcome::overlap);
}

int print_cross_check(std::uint64_t n_trials, std::uint64_t most_poses, int n_threads) {
  const std::vector<Kind> kinds = all_kinds();
  const std::vector<BackendKind> peers = peer_backends();
  std::vector<Against> totals(peers.size());
  std::uint64_t n_poses = 0, n_undecided = 0;
  std::size_t n_pairs = 0, n_asked = 0, n_contradicted = 0;
  std::string table, poses;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const ConvexBody& a = kinds[i].shape.body;
      const ConvexBody& b = kinds[j].shape.body;
      if (average_excluded_volume(kinds[i].shape.measures, kinds[j].shape.measures) == 0.0) continue;
      MonteCarloSettings settings;
      settings.n_threads = n_threads;
      settings.domain = ball_domain(a, b);
      settings.stop.trials = n_trials;
      std::vector<std::size_t> of_check;  // the peer that stands there
      for (std::size_t k = 0; k < peers.size(); ++k) {
        if (!peers[k].takes(a, b)) continue;
        settings.cross_check.push_back(peers[k]);
        of_check.push_back(k);
      }
      const RunRecord record = run_monte_carlo(a, b, settings);
      ++n_pairs;
      n_poses += record.tally.n_trials;
      n_undecided += record.tally.n_undecided;
      std::vector<Against> against(peers.size());
      for (std::size_t c = 0; c < of_check.size(); ++c) {
        against[of_check[c]].takes_part = true;
        against[of_check[c]].n_given_up = record.comparisons[c].n_undecided;
      }
      std::uint64_t n_listed = 0;
      for (const Disagreement& found : record.disagreements.kept) {
        std::string who;
        for (std::size_t c = 0; c < of_check.size(); ++c) {
          const Outcome theirs = found.outcomes[c + 1];
          if (theirs == Outcome::undecided || theirs == found.outcomes[0]) continue;
          Against& one = against[of_check[c]];
          (theirs == Outcome::overlap ? one.n_invented : one.n_missed) += 1;
          who += " " + peers[of_check[c]].name;
        }
        if (!vertices_of(a).empty() && !vertices_of(b).empty()) ++n_asked;
        if (is_contradicted(a, b, found)) {
          ++n_contradicted;
          who += " - EXACT ARITHMETIC CONTRADICTS THE ENGINE";
        }
        if (n_listed == most_poses) continue;
        ++n_listed;
        poses += "- " + kinds[i].name + " · " + kinds[j].name + ", trial " + std::to_string(found.index) +
                 ": the engine proves " + std::string(name_of(found.outcomes[0])) + ", against" + who + "  \n  `" +
                 pose_text(found.a_from_b) + "`\n";
      }
      if (record.disagreements.n_all > n_listed) {
        poses += "- " + kinds[i].name + " · " + kinds[j].name + ": " + std::to_string(record.disagreements.n_all) +
                 " in all\n";
      }
      table += "| " + kinds[i].name + " | " + kinds[j].name + " | " + std::to_string(record.tally.n_undecided) + " |";
      for (std::size_t k = 0; k < peers.size(); ++k) {
        const Against& one = against[k];
        totals[k].n_missed += one.n_missed;
        totals[k].n_invented += one.n_invented;
        totals[k].n_given_up += one.n_given_up;
        table += !one.takes_part ? " – |"
                                 : " " + std::to_string(one.n_missed) + " / " + std::to_string(one.n_invented) + " / " +
                                       std::to_string(one.n_given_up) + " |";
      }
      table += "\n";
      std::fprintf(stderr, "%s  %s  %llu disputed, %.0f s\n", kinds[i].name.c_str(), kinds[j].name.c_str(),
                   static_cast<unsigned long long>(record.disagreements.n_all), record.seconds);
    }
  }
  std::cout << "# Who disagrees with whom\n\nMade by `vex_every_pair cross-check --poses " << most_poses
            << "` (build/release/bin after `sh "
            << "tests/run`), " << short_number(static_cast<double>(n_trials), 3) << " random poses of each of "
            << n_pairs << " pairs of body kinds, seed 1, centre of B uniform in the ball of the circumradii; "
            << "every backend on the same poses. The engine left " << n_undecided << " of "
            << short_number(static_cast<double>(n_poses), 4) << " undecided and proved the others. Where two polytopes "
            << "are disputed, exact rational arithmetic was asked: of " << n_asked
            << " poses it contradicted the engine on " << n_contradicted
            << ".\n\nFor each peer: overlaps that it misses / overlaps that it invents / poses that it "
            << "gives up, – where it has no such shape.\n\n| A | B | engine undecided |";
  for (const BackendKind& peer : peers) std::cout << " " << peer.name << " |";
  std::cout << "\n|---|---|---:|";
  for (std::size_t k = 0; k < peers.size(); ++k) std::cout << "---:|";
  std::cout << "\n" << table << "| **all** | | " << n_undecided << " |";
  for (const Against& one : totals) {
    std::cout << " " << one.n_missed << " / " << one.n_invented << " / " << one.n_given_up << " |";
  }
  std::cout << "\n\n## The poses\n\nB's pose in A's frame as `--matrix` of the interface writes it, r11, r12, ... r33, "
            << "tx, ty, tz, in hexadecimal; of each pair at most " << most_poses << ".\n\n"
            << (poses.empty() ? "None.\n" : poses);
  return n_contradicted == 0 ? kSuccess : kDisagreement;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options("Every kind of body with every other, as Markdown.", "vex_every_pair");
  std::string what, relative_error = "1e-3", trials = "1e7", poses = "1000", threads;
  options
      .add_option("WHAT", what,
                  "table (Monte Carlo against the formula) or cross-check (every backend on the same poses)")
      .type_name("")
      .required();
  options.add_option("--rel-error", relative_error, "Of each pair of the table (default 1e-3)").type_name("E");
  options.add_option("--trials", trials, "Poses of each pair of the cross-check (default 1e7)").type_name("N");
  options.add_option("--poses", poses, "Disputed poses of each pair that are listed (default 1000)").type_name("N");
  options.add_option("--threads", threads, "Threads (default: all cores)").type_name("N");
  return vex::run_program(options, argc, argv, [&] {
    const int n_threads = vex::parse_threads(threads);
    if (what == "table") return vex::print_table(vex::parse_number(relative_error, "--rel-error"), n_threads);
    if (what == "cross-check")
      return vex::print_cross_check(vex::parse_count(trials, "--trials"), vex::parse_count(poses, "--poses"),
                                    n_threads);
    throw vex::UsageError("not understood (" + what + ") - write table or cross-check");
  });
}
