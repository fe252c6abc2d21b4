#include "engine/scene/scene_impl.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/numeric/number_text.h"
#include "engine/scene/pair_order.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

void check(const SceneSettings& settings) {
  if (!(settings.skin >= 0.0 && settings.skin <= 1e100)) {
    throw UsageError("a scene's skin is " + shortest_number(settings.skin) + " - give a length from 0 to 1e100");
  }
  if (settings.n_threads < 1 || settings.n_threads > 4096) {
    throw UsageError("a scene's number of threads is " + std::to_string(settings.n_threads) +
                     " - give one between 1 and 4096");
  }
  const int phase = static_cast<int>(settings.broad_phase);
  if (phase < static_cast<int>(BroadPhase::automatic) || phase > static_cast<int>(BroadPhase::tree)) {
    throw UsageError("a scene's broad phase is number " + std::to_string(phase) + " - give one that BroadPhase names");
  }
}

}  // namespace

Scene::Impl::Impl(std::optional<PeriodicBox> box, const SceneSettings& settings)
    : bodies_(std::move(box)), settings_(settings) {
  check(settings);
}

void Scene::Impl::set(const SceneSettings& settings) {
  require_no_judge();
  check(settings);
  settings_ = settings;
}

ShapeId Scene::Impl::add_shape(const ConvexBody& body) {
  require_no_judge();
  return bodies_.add_shape(body);
}

BodyId Scene::Impl::add(ShapeId shape, const Pose& pose, const ImageOffset& moved) {
  require_no_judge();
  const BodyId body = bodies_.add(shape, pose, moved);
  phases_.bodies_changed();
  memory_.forget();
  if (are_cells_true_ && body < waiting_from_) keep_in_cells(body);
  return body;
}

// Where numbers are free below the last body's they are taken one by one.
void Scene::Impl::add(ShapeId shape, std::span<const Pose> poses) {
  require_no_judge();
  if (bodies_.size() == bodies_.end()) {
    bodies_.append(shape, poses, {});
    phases_.bodies_changed();
    memory_.forget();
    return;
  }
  bodies_.prepare_for(shape, poses);
  for (const Pose& pose : poses) add(shape, pose, {});
}

// Where memory gives out they are made anew.
void Scene::Impl::keep_in_cells(BodyId body) {
  are_cells_true_ = false;
  if (cells_.takes(bodies_, body)) {
    try {
      cells_.add(bodies_, body);
      are_cells_true_ = true;
    } catch (const std::bad_alloc&) {
    }
  } else if (cells_.are_upright()) {
    are_some_turned_ = true;
  }
}

// Bodies may come in thousands before the first query of one of them, or without any.
void Scene::Impl::keep_waiting_in_cells() {
  for (; are_cells_true_ && waiting_from_ < bodies_.end(); ++waiting_from_) {
    if (bodies_.has(waiting_from_)) keep_in_cells(waiting_from_);
  }
}

void Scene::Impl::require_no_judge() const {
  if (single_.judge != nullptr) {
    throw UsageError(
        "a judge of pairs searches or changes its own scene, which waits for its answer - ask another "
        "scene, or wait until the query has ended");
  }
}

void Scene::Impl::require(BodyId body) const {
  if (!bodies_.has(body)) throw UsageError("a scene has no body " + std::to_string(body) + " - ask `has` first");
}

void Scene::Impl::remove(BodyId body) {
  require_no_judge();
  require(body);
  const bool were_cells_true = are_cells_true_;
  are_cells_true_ = false;  // also where memory gives out
  if (were_cells_true && body < waiting_from_) cells_.remove(bodies_, body);
  bodies_.remove(body);
  are_cells_true_ = were_cells_true;
  phases_.bodies_changed();
  memory_.forget();
}

void Scene::Impl::clear() {
  require_no_judge();
  bodies_.clear();
  phases_.bodies_changed();
  memory_.forget();
  // Cells are cut anew as bodies come, but for those that would be the same again. Were others kept, the order in which
  // pairs are found, and so which of them others spare, would hang on what the scene held before.
  if (are_cells_true_ && are_cells_as_expected_ && !are_some_turned_) {
    cells_.clear();
    waiting_from_ = 0;
    return;
  }
  are_cells_true_ = are_some_turned_ = false;
  n_in_cells_ = 0;
}

void Scene::Impl::expect(std::size_t n_bodies) {
  require_no_judge();
  n_expected_ = n_bodies;
  are_cells_true_ = false;
  n_in_cells_ = 0;
}

void Scene::Impl::move(BodyId body, const Pose& pose) {
  require_no_judge();
  require(body);
  bodies_.set_pose(body, pose);
  const bool were_cells_true = are_cells_true_;
  are_cells_true_ = false;  // also where memory gives out
  phases_.moved(bodies_, body);
  if (!were_cells_true) return;
  if (body >= waiting_from_) {
    are_cells_true_ = true;
    return;
  }
  cells_.remove(bodies_, body);
  keep_in_cells(body);
}

void Scene::Impl::move_all(std::span<const Pose> poses) {
  require_no_judge();
  if (poses.size() != bodies_.end() || bodies_.size() != bodies_.end()) {
    throw UsageError("poses of " + std::to_string(poses.size()) + " bodies are given, and the scene has " +
                     std::to_string(bodies_.size()) + " with numbers below " + std::to_string(bodies_.end()) +
                     " - give one pose for each number, in a scene without gaps");
  }
  phases_.poses_changed();
  bodies_.expect_turns();
  are_cells_true_ = false;
  const int n_threads = settings_.n_threads;
  on_threads(n_threads, [&](int thread) {
    const Part part = part_of(poses.size(), thread, n_threads);
    bodies_.set_poses(static_cast<BodyId>(part.first), poses.subspan(part.first, part.end - part.first));
  });
}

double Scene::Impl::checked_reach(double margin) const {
  const double reach = (2.0 * bodies_.largest_radius() + margin) * (1.0 + 0x1p-18);
  if (bodies_.box()) {
    const Vec3d faces = bodies_.box()->face_distances();
    const double least = std::fmin(faces.x, std::fmin(faces.y, faces.z));
    if (!(margin <= kMostImages * least)) {
      throw InputError("a distance of " + shortest_number(margin) + " reaches over more than " +
                       std::to_string(kMostImages) + " copies of the periodic box, whose faces are " +
                       shortest_number(least) + " apart - give a smaller one");
    }
  }
  return reach;
}

// Made for single queries, and kept up to date from then on; anew where bodies have become many more or larger.
BallCellsOfScene& Scene::Impl::ball_cells(double farthest, bool is_upright) {
  if (are_cells_true_ && cells_.are_upright() && !is_upright) {
    are_cells_true_ = false;
    are_some_turned_ = true;
  }
  // In a box they need not hang on where bodies are.
  const bool as_expected = n_expected_ > 0 && bodies_.box() && bodies_.size() <= 2 * n_expected_ + 64;
  const double radius = as_expected ? bodies_.largest_radius_of_shapes() : bodies_.largest_radius();
  const bool is_small = bodies_.size() > 2 * n_in_cells_ + 64;
  if (!is_small) keep_waiting_in_cells();
  if (!are_cells_true_ || !cells_.takes(radius) || is_small || !cells_.goes_as_far_as(farthest)) {
    are_cells_true_ = false;  // also where an interruption ends it
    are_cells_as_expected_ = as_expected;
    n_in_cells_ = as_expected ? n_expected_ : bodies_.size();
    const double offset = as_expected ? bodies_.largest_offset_of_shapes() : bodies_.largest_offset();
    cells_.build(bodies_, as_expected ? 0.0 : farthest, offset, as_expected ? n_expected_ : 0,
                 is_upright && !are_some_turned_);
    waiting_from_ = bodies_.end();
    are_cells_true_ = true;
  }
  return cells_;
}

std::vector<Clusters>& Scene::Impl::cluster_parts(int n_threads) {
  cluster_parts_.resize(static_cast<std::size_t>(n_threads));
  for (Clusters& part : cluster_parts_) part.reset(bodies_.end());
  return cluster_parts_;
}

std::vector<std::vector<ScenePair>>& Scene::Impl::cluster_news(int n_threads) {
  cluster_news_.resize(static_cast<std::size_t>(n_threads));
  for (std::vector<ScenePair>& pairs : cluster_news_) pairs.clear();
  return cluster_news_;
}

PairQuestion Scene::Impl::question(double margin) {
  const SortedBodies& sorted = phases_.bodies();
  return {&bodies_,
          sorted.poses.data(),
          sorted.id.data(),
          sorted.shape.data(),
          &phases_.shifts(),
          scene_kernel(settings_.instruction_set),
          settings_.instruction_set,
          margin};
}

void Scene::Impl::find_pairs(double margin, const OnBatch& on_batch, const OnBegin& on_begin) {
  require_no_judge();
  if (margin != 0.0 && !(margin >= 1e-300 && margin <= 1e100)) {
    throw UsageError("the distance is " + shortest_number(margin) + " - give 0, or one from 1e-300 to 1e100");
  }
  phases_.prepare(bodies_, settings_, checked_reach(margin), margin);
  const PairQuestion asked = question(margin);
  n_searches_ = std::min(settings_.n_threads, static_cast<int>(std::max<std::size_t>(phases_.n_parts(), 1)));
  std::atomic<std::size_t> next_part = 0;
  std::atomic<bool> is_over = false;
  const auto work = [&](PairSearch& search, int thread) {
    if (on_begin) on_begin(search, thread);
    const auto tell = [&] {
      end_if_interrupted();
      if (on_batch && !on_batch(search)) is_over = true;
      return !is_over;
    };
    const auto take = [&] {
      search.take();
      return tell();
    };
    for (std::size_t part = next_part++; part < phases_.n_parts(); part = next_part++) {
      end_if_interrupted();
      if (is_over || !phases_.find_near(part, asked.kernel, search.near, take)) return;
    }
    search.finish();
    tell();
  };
  on_searches(asked, nullptr, std::ref(work));
}

void Scene::Impl::on_searches(const PairQuestion& asked, PairKeeper* keeper,
                              const std::function<void(PairSearch& search, int thread)>& work) {
  last_had_margin_ = asked.margin > 0.0;
  std::vector<PairSearch>& all = searches(asked.margin);
  if (all.size() < static_cast<std::size_t>(n_searches_)) all.resize(static_cast<std::size_t>(n_searches_));
  on_threads(n_searches_, [&](int thread) {
    PairSearch& search = all[static_cast<std::size_t>(thread)];
    search.begin(asked, keeper);
    work(search, thread);
  });
}

void Scene::Impl::find_remembered_pairs(ScenePairs& out) {
  require_no_judge();
  if (!memory_.holds(bodies_, settings_.skin)) {
    phases_.prepare(bodies_, settings_, checked_reach(settings_.skin), settings_.skin, false);
    memory_.build(bodies_, phases_, scene_kernel(settings_.instruction_set), settings_.skin, settings_.n_threads);
  }
  PairQuestion asked = question(0.0);
  asked.poses = bodies_.poses().data();
  asked.id = nullptr;
  asked.shape = bodies_.shape_of().data();
  asked.shifts = &memory_.shifts();
  n_searches_ = std::min(settings_.n_threads, static_cast<int>(memory_.n_blocks()) + 1);
  std::atomic<std::size_t> next = 0;
  const auto work = [&](PairSearch& search, int) {
    for (std::size_t block = next++; block < memory_.n_blocks(); block = next++) {
      end_if_interrupted();
      memory_.look(block, search);
    }
    search.finish();
  };
  try {
    on_searches(asked, &memory_, std::ref(work));
    collect_rest(out);
    memory_.collect(settings_.n_threads, out.pairs);
  } catch (...) {
    memory_.forget();  // some pairs are told to be apart until they are answered
    throw;
  }
}

std::span<PairSearch> Scene::Impl::last_searches() {
  return {searches_[last_had_margin_ ? 1 : 0].data(), static_cast<std::size_t>(n_searches_)};
}

void Scene::Impl::collect(ScenePairs& out) {
  sort_pairs(last_searches(), &PairSearch::pairs, bodies_.end(), n_searches_, out.pairs);
  collect_rest(out);
}

void Scene::Impl::collect_rest(ScenePairs& out) {
  const std::span<PairSearch> last = last_searches();
  sort_pairs(last, &PairSearch::undecided, bodies_.end(), 1, out.undecided);
  out.counts = {};
  for (const PairSearch& search : last) out.counts += search.counts;
}

}  // namespace vex
