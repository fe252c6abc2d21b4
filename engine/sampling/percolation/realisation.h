// One realisation of percolation: bodies are placed one after another, and it is recorded with which body a cluster of
// overlapping bodies first wraps around the periodic cube.
//
// M. E. J. Newman and R. M. Ziff, "Fast Monte Carlo algorithm for site or bond percolation", Phys. Rev. E 64, 016706
// (2001).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/query/overlap_backend.h"
#include "engine/sampling/percolation/placements.h"
#include "engine/scene/scene.h"

namespace vex {

/// How many bodies there were when a cluster first wrapped along x, y and z.
struct WrappingNumbers {
  std::array<std::uint32_t, 3> along{};

  std::uint32_t any() const { return std::min(along[0], std::min(along[1], along[2])); }
  /// Along all three, by whatever clusters.
  std::uint32_t all() const { return std::max(along[0], std::max(along[1], along[2])); }
  friend bool operator==(const WrappingNumbers&, const WrappingNumbers&) = default;
};

/// What realisations did, added up. The batch of bodies in which a cluster first wraps is looked at twice
/// (Realisation::run), and both times count.
struct PercolationCounts {
  std::uint64_t n_bodies = 0;     // placed
  std::uint64_t n_undecided = 0;  // pairs that would have changed a cluster, had they been proven to overlap
  SceneCounts stages;

  /// Pairs whose circumscribed balls may meet, each image for itself; those of them that were not tested because their
  /// bodies were in one cluster already with the same offset; and the others, by whatever test.
  std::uint64_t n_seen() const { return stages[SceneStage::balls].seen - stages[SceneStage::balls].settled; }
  std::uint64_t n_skipped() const { return stages[SceneStage::joined].settled; }
  std::uint64_t n_tested() const { return n_seen() - n_skipped(); }

  PercolationCounts& operator+=(const PercolationCounts& other);
};

struct PercolationSystem {
  Placements placements;
  double edge;             // of the periodic cube
  std::uint32_t size = 0;  // its number among the sizes: other sizes draw other bodies
  InstructionSet instruction_set = best_instruction_set();
  /// Decides whether two bodies are connected, the one placed first being A; none: the engine, by packets.
  std::optional<BackendKind> backend{};
  std::uint32_t most_bodies = 1u << 30;  // a realisation that needs more is refused
  std::uint32_t usual_bodies = 0;        // about as many as one takes, or 0: it is made faster by that alone
  /// So many bodies are placed before any pair is looked for, and none of their pairs is left out. It changes nothing
  /// but the time, and what is counted.
  std::uint32_t at_once = 0;
};

/// With how many at once nearly all realisations end: told from some of a small cube, always the same ones. 0 where it
/// would not pay.
std::uint32_t best_at_once(const PercolationSystem& system);

/// Whether to stop; called by several threads at once.
using StopQuestion = std::function<bool()>;

/// Makes realisations one after another, in the same memory; one thread's. Holds a reference.
class Realisation {
 public:
  explicit Realisation(const PercolationSystem& system);
  Realisation(const Realisation&) = delete;
  Realisation& operator=(const Realisation&) = delete;

  /// Places bodies until clusters wrap along all three axes. A pair of which it is not proven whether it overlaps does
  /// not connect, and is counted. Throws UsageError where `most_bodies` do not wrap. Nothing where `stop` says so.
  std::optional<WrappingNumbers> run(std::uint32_t realisation, const StopQuestion& stop = {});
  /// Of the last one.
  const PercolationCounts& counts() const { return counts_; }

  /// Places its first n bodies and joins all their pairs: for a look at them.
  void place_and_join(std::uint32_t realisation, std::uint32_t n);
  const Scene& scene() const { return scene_; }
  Clusters& clusters() { return clusters_; }

 private:
  void begin();
  void place(std::uint32_t realisation, std::uint32_t n);
  Outcome ask_backend(ShapeId a, ShapeId b, const Transformd& a_from_b);
  void ask_pairs(BodyId first, Clusters* joined);
  void ask_and_join_in_order(BodyId first, WrappingNumbers& numbers);
  void note_wrapping(const ScenePair& pair, WrappingNumbers& numbers);

  const PercolationSystem& system_;
  Scene scene_;
  std::vector<ShapeId> shapes_;
  Clusters clusters_;
  ScenePairs pairs_;
  PairJudge judge_;                                        // of a backend
  std::vector<std::unique_ptr<OverlapBackend>> backends_;  // of every two shapes
  std::vector<ScenePair> news_;                            // what changed the clusters, all of it among them
  Placements::Many placed_;
  PercolationCounts counts_;
};

class Ranks;

/// What was finished since the last call, in the order of realisations, and what it took.
using OnRealisations = std::function<void(std::span<const WrappingNumbers> finished, const PercolationCounts& counts)>;

/// Realisations first ... first + n - 1, by so many threads. Each is told of once, in their order, as soon as all
/// before it are finished, by any thread, one at a time; after `stop` said so up to the first that was not finished.
/// Throws UsageError for no threads, and beyond kMostRealisations. `ranks`: other processes take part, which
/// `make_realisations_for_leader` makes realisations on; between Ranks::begin and Ranks::end.
void run_realisations(const PercolationSystem& system, std::uint32_t first, std::uint32_t n, int n_threads,
                      const OnRealisations& on_finished, const StopQuestion& stop = {}, Ranks* ranks = nullptr);

/// On a rank that does not lead: makes what the leader gives, of any of the systems, by their numbers, until it says
/// that this is all.
void make_realisations_for_leader(std::span<const PercolationSystem* const> systems, int n_threads, Ranks& ranks);

/// The same, all at once; in their order, the same for any number of threads. Fewer
/// where `stop` said so: then those up to the first that was not finished. `counts` grows by theirs.
std::vector<WrappingNumbers> run_realisations(const PercolationSystem& system, std::uint32_t first, std::uint32_t n,
                                              int n_threads, PercolationCounts& counts, const StopQuestion& stop = {});

}  // namespace vex
