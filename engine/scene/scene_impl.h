// What a scene holds: its bodies, and what was made of them for queries, as long as it is true (internal).
#pragma once

#include <functional>
#include <vector>

#include "engine/scene/ball_cells.h"
#include "engine/scene/broad_phases.h"
#include "engine/scene/pair_memory.h"
#include "engine/scene/pair_search.h"
#include "engine/scene/scene.h"

namespace vex {

class Scene::Impl {
 public:
  Impl(std::optional<PeriodicBox> box, const SceneSettings& settings);

  void set(const SceneSettings& settings);
  const SceneSettings& settings() const { return settings_; }
  const SceneBodies& bodies() const { return bodies_; }

  ShapeId add_shape(const ConvexBody& body);
  BodyId add(ShapeId shape, const Pose& pose, const ImageOffset& moved);
  void add(ShapeId shape, std::span<const Pose> poses);
  void remove(BodyId body);
  void clear();
  void expect(std::size_t n_bodies);
  void move(BodyId body, const Pose& pose);
  void move_all(std::span<const Pose> poses);
  /// Throws UsageError where there is no such body.
  void require(BodyId body) const;
  /// Throws UsageError where a judge is being asked: the search that asks it holds what others would change.
  void require_no_judge() const;

  /// Sends all pairs that are within the margin, or may be, through the stages. `on_batch`, where there is one, is
  /// called by the thread that has found new pairs, with its search, and says whether to go on.
  using OnBatch = std::function<bool(PairSearch& search)>;
  using OnBegin = std::function<void(PairSearch& search, int thread)>;
  void find_pairs(double margin, const OnBatch& on_batch, const OnBegin& on_begin = {});
  /// The overlapping pairs, with what is remembered of them where settings have a skin.
  void find_remembered_pairs(ScenePairs& out);
  /// What the threads found, sorted.
  void collect(ScenePairs& out);

  /// The pairs of one body, as if it were at this pose; the search that has found them.
  PairSearch& find_pairs_of(BodyId body, const Transformd& pose);

  /// The pairs of each body from `first` on with those before it; the search that has found them.
  PairSearch& find_pairs_of_added(BodyId first, Clusters* joined, const PairJudge* judge);

  /// The tree of the bodies as they are.
  const BodyTree& tree();
  struct Visit;
  /// `itself`: the body that asks, or kNoBody.
  SceneNeighbour nearest(const ConvexBody& visitor, const Pose& pose, BodyId itself);
  /// The first contact with a body's copy, no later than a time, in the body's frame.
  using Cast = std::function<FirstContact(BodyId body, const ImageOffset& image, double last)>;
  /// What a box of these half extents meets first whose middle is at `from` + t `dir`; it is in a ball of radius
  /// `reach`.
  SceneHit cast(const Vec3d& from, const Vec3d& dir, const Vec3d& half_extents, double reach, double until,
                const Cast& cast);

  PairSearch& search(double margin, int thread) { return searches(margin)[static_cast<std::size_t>(thread)]; }
  ScenePairs& pairs_buffer() { return pairs_buffer_; }
  // A thread each; they keep their memory.
  std::vector<Clusters>& cluster_parts(int n_threads);
  std::vector<std::vector<ScenePair>>& cluster_news(int n_threads);
  std::vector<ManifoldMemory>& manifold_memories(int n_threads) {
    const auto n = static_cast<std::size_t>(n_threads);
    if (manifold_memories_.size() < n) manifold_memories_.resize(n);
    return manifold_memories_;
  }

 private:
  // How far apart the centres of bodies may be that are this near each other. Throws InputError where it is too far.
  double checked_reach(double margin) const;
  std::span<PairSearch> last_searches();
  // Undecided pairs and counts.
  void collect_rest(ScenePairs& out);
  // For n_searches_ threads: each with its search, which has begun.
  void on_searches(const PairQuestion& asked, PairKeeper* keeper,
                   const std::function<void(PairSearch& search, int thread)>& work);
  // For a query at a place as far out as this, of a body that is not turned or may be.
  BallCellsOfScene& ball_cells(double farthest, bool is_upright);
  void keep_in_cells(BodyId body);
  // Of all bodies that wait for it.
  void keep_waiting_in_cells();
  // By the broad phase, which is prepared; or of each body from `first` on with those before it. For a search that has
  // begun, and is finished later.
  void find_all_pairs(PairSearch& search);
  void find_pairs_one_by_one(BodyId first, const BallCellsOfScene& cells, PairSearch& search);
  std::vector<PairSearch>& searches(double margin) { return searches_[margin > 0.0 ? 1 : 0]; }
  PairQuestion question(double margin);
  // Of pairs whose places are numbers of bodies.
  PairQuestion question_of_cells(const BallCellsOfScene& cells);

  SceneBodies bodies_;
  SceneSettings settings_;

  BroadPhases phases_;

  PairMemory memory_;
  BallCellsOfScene cells_;
  bool are_cells_true_ = false;
  BodyId waiting_from_ = 0;  // bodies from this number on are not in the cells yet, once these are true
  std::size_t n_in_cells_ = 0, n_expected_ = 0;
  bool are_cells_as_expected_ = false;  // they are what they would be for another set of bodies
  bool are_some_turned_ = false;        // of bodies and visitors, since cells were found to be for others alone

  std::vector<PairSearch> searches_[2];  // one a thread: without and with a margin
  bool last_had_margin_ = false;         // of the last query, and its threads
  int n_searches_ = 1;
  PairSearch single_;

  ScenePairs pairs_buffer_;
  std::vector<Clusters> cluster_parts_;
  std::vector<std::vector<ScenePair>> cluster_news_;
  std::vector<ManifoldMemory> manifold_memories_;
};

}  // namespace vex
