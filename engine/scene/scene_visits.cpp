// Queries of one body.
#include <algorithm>

#include "engine/scene/scene_impl.h"

namespace vex {

// Sends what may be near a body, at a pose that need not be its own, through the stages.
PairSearch& Scene::Impl::find_pairs_of(BodyId body, const Transformd& pose) {
  const ShapeId shape = bodies_.shape_of()[body];
  const ShapeBounds& bounds = bodies_.bounds(shape);
  const Vec3d centre = pose(bounds.centre);
  const BallCells& cells = ball_cells(norm_1(centre) + norm_1(bounds.centre));
  bodies_.set_visitor(shape, pose);
  const std::uint64_t place = bodies_.end();
  PairSearch& search = single_;
  PairQuestion asked = question(0.0);
  asked.poses = bodies_.poses().data();
  asked.id = nullptr;
  asked.shape = bodies_.shape_of().data();
  asked.shifts = &cells.shifts();
  asked.visitor = place;
  asked.visitor_id = body;
  search.begin(asked);
  const double radius = bounds.radius + 0x1p-46 * (norm_1(centre) + norm_1(bounds.centre)) + kTrifle;
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
  cells.near(asked.kernel, place, centre, radius, search.near, [&] {
    leave_out_itself();
    search.take();
  });
  leave_out_itself();
  // Its own copies, where it is longer than the box.
  const ShiftTable& shifts = cells.shifts();
  for (std::uint64_t shift = shifts.home() + std::uint64_t{1}; shift < shifts.size(); ++shift) {
    ++search.near.n_seen;
    if (safe_norm(shifts.shift(shift)) > 2.0 * radius * (1.0 + 0x1p-20)) continue;
    search.near.places[search.near.n] = place | (place << 32);
    search.near.shift[search.near.n] = shift;
    if (++search.near.n >= NearPairs::kMost) search.take();
  }
  search.finish();
  bodies_.set_visitor(kNoShape, pose);
  return search;
}

void Scene::overlaps_of(BodyId body, ScenePairs& out) {
  impl_->require(body);
  PairSearch& search = impl_->find_pairs_of(body, pose(body));
  out.pairs = search.pairs;
  out.undecided = search.undecided;
  out.counts = search.counts;
  std::sort(out.pairs.begin(), out.pairs.end());
  std::sort(out.undecided.begin(), out.undecided.end());
}

Outcome Scene::would_overlap(BodyId body, const Pose& world_from_body) {
  impl_->require(body);
  ImageOffset image;
  const Transformd pose = impl_->bodies().checked(shape_of(body), world_from_body, &image);
  const PairSearch& search = impl_->find_pairs_of(body, pose);
  if (!search.pairs.empty()) return Outcome::overlap;
  return search.undecided.empty() ? Outcome::disjoint : Outcome::undecided;
}

}  // namespace vex
