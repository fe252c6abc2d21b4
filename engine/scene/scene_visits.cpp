// Queries of one body.
#include <algorithm>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/scene/pair_order.h"
#include "engine/scene/scene_impl.h"

namespace vex {
namespace {

void take_sorted(const PairSearch& search, ScenePairs& out) {
  out.pairs.assign(search.pairs.begin(), search.pairs.end());
  out.undecided.assign(search.undecided.begin(), search.undecided.end());
  out.counts = search.counts;
  std::sort(out.pairs.begin(), out.pairs.end());
  std::sort(out.undecided.begin(), out.undecided.end());
}

}  // namespace

PairQuestion Scene::Impl::question_of_cells(const BallCellsOfScene& cells) {
  PairQuestion asked = question(0.0);
  asked.poses = bodies_.poses().data();
  asked.id = nullptr;
  asked.shape = bodies_.shape_of().data();
  asked.shifts = &cells.shifts();
  return asked;
}

// Sends what may be near a body, at a pose that need not be its own, through the stages.
PairSearch& Scene::Impl::find_pairs_of(BodyId body, const Transformd& pose) {
  require_no_judge();
  const ShapeId shape = bodies_.shape_of()[body];
  const ShapeBounds& bounds = bodies_.bounds(shape);
  const Vec3d centre = pose(bounds.centre);
  const BallCellsOfScene& cells = ball_cells(norm_1(centre) + norm_1(bounds.centre), SceneBodies::is_upright(pose));
  bodies_.set_visitor(shape, pose);
  const std::uint64_t place = bodies_.end();
  PairSearch& search = single_;
  PairQuestion asked = question_of_cells(cells);
  asked.visitor = place;
  asked.visitor_id = body;
  search.begin(asked);
  // Where it is in the scene it is not any more.
  const auto leave_out_itself = [&] {
    std::size_t n = 0;
    for (std::size_t k = 0; k < search.near.n; ++k) {
      search.near.places[n] = search.near.places[k];
      search.near.shift[n] = search.near.shift[k];
      if (search.near.places[k] >> 32 != body) ++n;
    }
    search.near.n = n;
  };
  cells.near(asked.kernel, place, centre, bounds, search.near, [&] {
    leave_out_itself();
    search.take();
  });
  leave_out_itself();
  // Its own copies, where it is longer than the box.
  const ShiftTable& shifts = cells.shifts();
  const double reach = 2.0 * (bounds.radius + bounds.rounding_at(centre));
  for (std::uint64_t shift = shifts.home() + std::uint64_t{1}; shift < shifts.size(); ++shift) {
    ++search.near.n_seen;
    if (safe_norm(shifts.shift(shift)) > reach * (1.0 + 0x1p-20)) continue;
    search.near.places[search.near.n] = place | (place << 32);
    search.near.shift[search.near.n] = shift;
    if (++search.near.n >= NearPairs::kMost) search.take();
  }
  search.finish();
  bodies_.set_visitor(kNoShape, pose);
  return search;
}

void Scene::Impl::find_all_pairs(PairSearch& search) {
  const SceneKernel kernel = scene_kernel(settings_.instruction_set);
  const auto take = [&search] {
    end_if_interrupted();
    search.take();
    return true;
  };
  for (std::size_t part = 0; part < phases_.n_parts(); ++part) phases_.find_near(part, kernel, search.near, take);
}

void Scene::Impl::find_pairs_one_by_one(BodyId first, const BallCellsOfScene& cells, PairSearch& search) {
  const SceneKernel kernel = scene_kernel(settings_.instruction_set);
  NearPairs& near = search.near;
  for (BodyId body = first; body < bodies_.end(); ++body) {
    if (!bodies_.has(body)) continue;
    const ShapeBounds& bounds = bodies_.bounds(bodies_.shape_of()[body]);
    const Vec3d& centre = bodies_.centre(body);
    // The cells hold what was added later, and the body itself, too. Of its own copies one of two is kept.
    std::size_t n = near.n;
    const auto keep_earlier = [&] {
      for (std::size_t k = n; k < near.n; ++k) {
        const std::uint64_t other = near.places[k] >> 32;
        near.places[n] = near.places[k];
        near.shift[n] = near.shift[k];
        if (other < body || (other == body && near.shift[k] > cells.shifts().home())) ++n;
      }
      near.n = n;
    };
    cells.near(kernel, body, centre, bounds, near, [&] {
      keep_earlier();
      search.take();
      n = 0;
    });
    keep_earlier();
    if (near.n >= NearPairs::kMost) search.take();
  }
}

PairSearch& Scene::Impl::find_pairs_of_added(BodyId first, Clusters* joined, const PairJudge* judge) {
  require_no_judge();
  // To sort all bodies costs more than to ask for each only where there are few.
  constexpr std::size_t kMany = 256;
  const BallCellsOfScene* cells = nullptr;
  if (first == 0 && bodies_.size() >= kMany) {
    phases_.prepare(bodies_, settings_, checked_reach(0.0), 0.0);
    single_.begin(question(0.0));
  } else {
    cells = &ball_cells(0.0, true);
    single_.begin(question_of_cells(*cells));
  }
  single_.joined = joined;
  single_.judge = judge;
  struct Asking {
    const PairJudge*& judge;
    ~Asking() { judge = nullptr; }
  } const asking{single_.judge};
  if (cells == nullptr) {
    find_all_pairs(single_);
  } else {
    find_pairs_one_by_one(first, *cells, single_);
  }
  single_.finish();
  return single_;
}

void Scene::overlaps_of(BodyId body, ScenePairs& out) {
  impl_->require(body);
  take_sorted(impl_->find_pairs_of(body, pose(body)), out);
}

void Scene::overlaps_of_added(BodyId first, ScenePairs& out, Clusters* joined, const PairJudge* judge) {
  if (joined != nullptr && joined->size() < end()) {
    throw UsageError("clusters know of " + std::to_string(joined->size()) +
                     " bodies, and the scene has numbers up to " + std::to_string(end()) +
                     " - add the missing ones to the clusters first");
  }
  const PairSearch& search = impl_->find_pairs_of_added(first, joined, judge);
  out.counts = search.counts;
  if (joined == nullptr) {
    sort_by_second(search.pairs, first, end(), out.pairs);
    sort_by_second(search.undecided, first, end(), out.undecided);
  } else {
    out.pairs.assign(search.pairs.begin(), search.pairs.end());
    out.undecided.assign(search.undecided.begin(), search.undecided.end());
  }
}

Outcome Scene::would_overlap(BodyId body, const Pose& world_from_body) {
  impl_->require(body);
  ImageOffset image;
  const Transformd pose = impl_->bodies().checked(shape_of(body), world_from_body.a_from_b(), &image);
  const PairSearch& search = impl_->find_pairs_of(body, pose);
  if (!search.pairs.empty()) return Outcome::overlap;
  return search.undecided.empty() ? Outcome::disjoint : Outcome::undecided;
}

}  // namespace vex
