#include "engine/scene/pair_memory.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/scene/threads.h"

namespace vex {
namespace {

// Of lengths, as kStretch of scene_bodies.cpp: what rotations that are ones to within 2e-7 change, twice over.
constexpr double kLess = 1.0 - 0x1p-18;

}  // namespace

void PairMemory::build(SceneBodies& bodies, const BroadPhases& phases, const SceneKernel& kernel, double skin,
                       int n_threads) {
  // Bodies that cross faces of the box between two steps change the image: each by one, and by one for each box that
  // half of the skin reaches over.
  std::array<int, 3> n_images = phases.shifts().n_images();
  if (bodies.box()) {
    const Vec3d faces = bodies.box()->face_distances();
    const double distances[] = {faces.x, faces.y, faces.z};
    for (std::size_t k = 0; k < 3; ++k) n_images[k] += 2 + static_cast<int>(std::ceil(skin / distances[k]));
  }
  shifts_ = ShiftTable(bodies.box(), n_images);
  std::vector<std::vector<Known>> found(phases.n_parts());
  std::atomic<std::size_t> next = 0;
  on_threads(n_threads, [&](int) {
    NearPairs near;
    for (std::size_t part = next++; part < phases.n_parts(); part = next++) {
      near.n = 0;
      phases.find_near(part, kernel, near, [&] {
        for (std::size_t k = 0; k < near.n; ++k) {
          BodyId a = phases.bodies().id[near.places[k] & 0xffffffffu], b = phases.bodies().id[near.places[k] >> 32];
          ImageOffset image = phases.shifts().image(near.shift[k]);
          if (a > b || (a == b && !(image > ImageOffset{}))) {
            std::swap(a, b);
            image = {-image[0], -image[1], -image[2]};
          }
          found[part].push_back({a, b, shifts_.number(image), false, -1.0, -1.0});
        }
        near.n = 0;
        return true;
      });
    }
  });
  known_.clear();
  for (const std::vector<Known>& part : found) known_.insert(known_.end(), part.begin(), part.end());
  skin_ = skin;
  is_there_ = true;
  bodies.track();
}

bool PairMemory::holds(const SceneBodies& bodies, double skin) const {
  return is_there_ && skin == skin_ && 2.0 * bodies.largest_travel() < skin * kLess;
}

void PairMemory::look(const SceneBodies& bodies, std::size_t first, std::size_t end, PairSearch& search) {
  thread_local std::vector<AtRest> at_rest;  // memory that a thread keeps
  at_rest.clear();
  // What other parts of the list have left waiting is answered here too, and found in no pair at rest.
  const std::size_t first_pair = search.pairs.size(), first_undecided = search.undecided.size();
  SceneCounts::Stage& unmoved = search.counts[SceneStage::unmoved];
  SceneCounts::Stage& balls = search.counts[SceneStage::balls];
  unmoved.seen += end - first;
  const auto image_now = [&](const Known& known) {
    const ImageOffset& image = shifts_.image(known.shift);
    const ImageOffset &of_a = bodies.crossed(known.a), &of_b = bodies.crossed(known.b);
    return ImageOffset{image[0] + of_b[0] - of_a[0], image[1] + of_b[1] - of_a[1], image[2] + of_b[2] - of_a[2]};
  };
  for (std::size_t k = first; k < end; ++k) {
    Known& known = known_[k];
    const double travel = bodies.travel(known.a) + bodies.travel(known.b);
    if (travel <= known.until) {
      ++unmoved.settled;
      if (known.overlaps) search.pairs.push_back({known.a, known.b, image_now(known)});
      continue;
    }
    const ImageOffset image = image_now(known);
    const std::uint32_t number = shifts_.number(image);
    const Vec3d& centre_a = bodies.centre(known.a);
    const Vec3d& centre_b = bodies.centre(known.b);
    const Vec3d shift = shifts_.shift(number);
    const double distance = norm((centre_b - centre_a) + shift);
    const double rounding = 0x1p-45 * (norm_1(centre_a) + norm_1(centre_b) + norm_1(shift));
    const ShapeBounds& of_a = bodies.bounds(bodies.shape_of()[known.a]);
    const ShapeBounds& of_b = bodies.bounds(bodies.shape_of()[known.b]);
    const double apart = distance * kLess - (of_a.radius + of_b.radius) - rounding;
    const double inside = (of_a.inner_radius + of_b.inner_radius) - distance / kLess - rounding;
    if (apart > 0.0 || inside > 0.0) {
      ++balls.seen;
      ++balls.settled;
      known.overlaps = inside > 0.0;
      known.until = travel + std::fmax(apart, inside) * kLess;
      if (known.overlaps) search.pairs.push_back({known.a, known.b, image});
      continue;
    }
    if (known.asked == travel) at_rest.push_back({{known.a, known.b, image}, k, travel});
    known.asked = travel;
    search.near.places[search.near.n] = known.a | (std::uint64_t{known.b} << 32);
    search.near.shift[search.near.n] = number;
    ++search.near.n_seen;
    if (++search.near.n == NearPairs::kMost) search.take();
  }
  if (!at_rest.empty()) keep_answers(at_rest, first_pair, first_undecided, search);
}

void PairMemory::keep_answers(std::vector<AtRest>& at_rest, std::size_t first_pair, std::size_t first_undecided,
                              PairSearch& search) {
  search.finish();
  std::sort(at_rest.begin(), at_rest.end(), [](const AtRest& x, const AtRest& y) { return x.pair < y.pair; });
  const auto each_of = [&](const std::vector<ScenePair>& pairs, std::size_t first, const auto& what) {
    for (std::size_t k = first; k < pairs.size(); ++k) {
      const auto at = std::lower_bound(at_rest.begin(), at_rest.end(), pairs[k],
                                       [](const AtRest& x, const ScenePair& pair) { return x.pair < pair; });
      if (at != at_rest.end() && at->pair == pairs[k]) what(known_[at->number]);
    }
  };
  for (const AtRest& rest : at_rest) {
    known_[rest.number].overlaps = false;
    known_[rest.number].until = rest.travel;
  }
  each_of(search.pairs, first_pair, [](Known& known) { known.overlaps = true; });
  // Of what is undecided nothing is known.
  each_of(search.undecided, first_undecided, [](Known& known) { known.until = -1.0; });
}

}  // namespace vex
